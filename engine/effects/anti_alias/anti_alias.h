// START HERE: anti_alias smooths the staircases of edges: four samples a pixel, or a filter over the finished picture.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kAntiAlias;

}  // namespace halfframe
