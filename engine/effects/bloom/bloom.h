// START HERE: bloom lets what is brighter than white paper glow.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kBloom;

}  // namespace halfframe
