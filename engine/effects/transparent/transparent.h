// START HERE: transparent draws the surfaces that blend with what is behind them, far to near.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kTransparent;

}  // namespace halfframe
