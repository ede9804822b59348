// Inserted into fragment shaders of surfaces: the share of the sun that reaches a point.
#include "shadow/shadow_limits.h"
#include "shadow/shadow.glsl"

uniform HALF sampler2DShadow shadow_map;  // what a comparison gives is a share; where it looks is FULL
FRAGMENT_IN FULL vec3 shadow_at;          // FULL: see shadow_place.glsl

//@not_run it reads a texture
float shadow_tap(FULL vec2 texels) {
#ifdef TIER_REFERENCE
    FULL vec2 away = texels * (1.0 / float(SHADOW_MAP_SIZE_REFERENCE));
#else
    FULL vec2 away = texels * (1.0 / float(SHADOW_MAP_SIZE_CONSOLE));
#endif
    return sample_compared(shadow_map, shadow_at + vec3(away, 0.0));
}

//@not_run it reads a texture; what it computes is lit_share, or a mean
float sun_share() {
#ifdef TIER_REFERENCE
    float sum = 0.0;
    for (int y = 0; y < SHADOW_TAPS_REFERENCE; y++) {
        for (int x = 0; x < SHADOW_TAPS_REFERENCE; x++) {
            sum += shadow_tap(vec2(float(x), float(y)) - 0.5 * float(SHADOW_TAPS_REFERENCE - 1));
        }
    }
    return sum * (1.0 / float(SHADOW_TAPS_REFERENCE * SHADOW_TAPS_REFERENCE));
#else
    return lit_share(vec4(shadow_tap(vec2(SHADOW_TAP_NEAR, SHADOW_TAP_FAR)),
                          shadow_tap(vec2(-SHADOW_TAP_FAR, SHADOW_TAP_NEAR)),
                          shadow_tap(vec2(-SHADOW_TAP_NEAR, -SHADOW_TAP_FAR)),
                          shadow_tap(vec2(SHADOW_TAP_FAR, -SHADOW_TAP_NEAR))));
#endif
}
