// The floor under every surface shader: the same draws in one colour, or with their fetches alone.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe::peers {

/// Draws every surface of a scene in one colour: rasterising, depth and storing, with nothing computed.
extern const EffectCard kConstantFloor;
/// As above, and samples the textures that surface would sample (not an environment), and adds them up.
extern const EffectCard kFetchFloor;

}  // namespace halfframe::peers
