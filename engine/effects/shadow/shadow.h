// START HERE: shadow darkens the sun where something stands in its way; at the low tier, the ground under what moves.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kShadow;

/// The sun that surfaces are lit by: the first of the scene. Nothing: there is none, it is black, or it has no
/// direction.
[[nodiscard]] const Light* shining_sun(const Scene& scene);

}  // namespace halfframe
