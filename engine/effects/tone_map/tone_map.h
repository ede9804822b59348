// START HERE: tone_map turns linear light into what the display shows.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kToneMap;

}  // namespace halfframe
