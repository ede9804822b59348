// Inserted into fragment shaders of surfaces: the share of the sun that reaches a point.
#include "shadow/shadow_limits.h"
#include "shadow/shadow.glsl"

uniform HALF sampler2DShadow shadow_map;  // what a comparison gives is a share; where it looks is FULL
FRAGMENT_IN FULL vec3 shadow_at;          // FULL: see shadow_place.glsl

// FULL: a 1024th is added to shadow_at.
//@domain texels: -3..3; FULL vec3 shadow_at: 0..1; HALF sampler2DShadow shadow_map: 0..1
//@promise in 0..1
//@jumps step(0.5, shadow_at.x + texels.x / 1024.0)
float shadow_tap(FULL vec2 texels) {
#ifdef TIER_REFERENCE
    FULL vec2 away = texels * (1.0 / float(SHADOW_MAP_SIZE_REFERENCE));
#else
    FULL vec2 away = texels * (1.0 / float(SHADOW_MAP_SIZE_CONSOLE));
#endif
    return sample_compared(shadow_map, shadow_at + vec3(away, 0.0));
}

//@variant TIER_CONSOLE
//@variant TIER_REFERENCE
//@domain FULL vec3 shadow_at: 0..1; HALF sampler2DShadow shadow_map: 0..1
//@promise in 0..1; where shadow_map.x == shadow_map.y: within(result, shadow_map.x, 0.02)
//@jumps floor(4096.0 * shadow_at.x)
float sun_share() {
#ifdef TIER_REFERENCE
    FULL float sum = 0.0;  // FULL: half rounds each of 36 sums, half a code together
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
