// The list itself, in the order the plan asks. Only this file names the effects: a build without one of them (see
// tests/effects/off_is_free) compiles this file with HALFFRAME_WITHOUT_<EFFECT> and links nothing of it.
#include "engine/effects.h"

#include <array>

namespace halfframe {

namespace {

constexpr auto kEffects = std::to_array<const EffectCard*>({
#ifndef HALFFRAME_WITHOUT_SURFACE
    &kSurface,
#endif
#ifndef HALFFRAME_WITHOUT_DEPTH_PREPASS
    &kDepthPrepass,  // after surface: it serves nothing without it
#endif
#ifndef HALFFRAME_WITHOUT_ENVIRONMENT
    &kEnvironment,
#endif
#ifndef HALFFRAME_WITHOUT_SKY
    &kSky,
#endif
#ifndef HALFFRAME_WITHOUT_TRANSPARENT
    &kTransparent,
#endif
#ifndef HALFFRAME_WITHOUT_SHADOW
    &kShadow,  // after surface and transparent: it marks that their passes read its map
#endif
#ifndef HALFFRAME_WITHOUT_WET_SURFACE
    &kWetSurface,
#endif
#ifndef HALFFRAME_WITHOUT_PUDDLES
    &kPuddles,  // after wet_surface: it soaks what stands under water first
#endif
#ifndef HALFFRAME_WITHOUT_TONE_MAP
    &kToneMap,
#endif
#ifndef HALFFRAME_WITHOUT_BLOOM
    &kBloom,  // after tone_map, whose pass reads the glow
#endif
#ifndef HALFFRAME_WITHOUT_ANTI_ALIAS
    &kAntiAlias,  // last: it gives others' passes another target
#endif
});

}  // namespace

std::span<const EffectCard* const> all_effects() { return kEffects; }

}  // namespace halfframe
