// START HERE: puddles lets water stand in hollows: a mirror of 2 % with a flat normal.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kPuddles;

}  // namespace halfframe
