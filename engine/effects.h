// The one explicit list of effects. Nothing registers itself: an effect that is not here does not exist.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kDepthPrepass;
extern const EffectCard kEnvironment;
extern const EffectCard kSurface;
extern const EffectCard kSky;
extern const EffectCard kTransparent;
extern const EffectCard kShadow;
extern const EffectCard kWetSurface;
extern const EffectCard kPuddles;
extern const EffectCard kToneMap;
extern const EffectCard kBloom;
extern const EffectCard kAntiAlias;

}  // namespace halfframe
