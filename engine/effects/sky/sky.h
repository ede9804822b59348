// START HERE: sky draws a vertical gradient behind everything.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kSky;

}  // namespace halfframe
