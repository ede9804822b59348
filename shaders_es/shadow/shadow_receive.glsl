// Inserted into fragment shaders of surfaces: the share of the sun that reaches a point.
#include "shadow/shadow_limits.h"
#include "shadow/shadow.glsl"

uniform HALF sampler2DShadow shadow_map;  // what a comparison gives is a share; where it looks is FULL
FRAGMENT_IN FULL vec3 shadow_at;          // FULL: see shadow_place.glsl

// FULL: a 1024th is added to shadow_at. `away`: in widths of the map.
//@domain away: -0.003..0.003; FULL vec3 shadow_at: 0..1; HALF sampler2DShadow shadow_map: 0..1
//@promise in 0..1
//@jumps step(0.5, shadow_at.x + away.x)
float shadow_tap(FULL vec2 away) { return sample_compared(shadow_map, shadow_at + vec3(away, 0.0)); }

// At console: four taps about the place.
//@domain FULL vec3 shadow_at: 0..1; HALF sampler2DShadow shadow_map: 0..1
//@promise in 0..1; where shadow_map.x == shadow_map.y: within(result, shadow_map.x, 0.02)
//@jumps floor(4096.0 * shadow_at.x)
float sun_share() {
    FULL float texel = 1.0 / float(SHADOW_MAP_SIZE_CONSOLE);  // FULL: see shadow_tap
    return lit_share(vec4(shadow_tap(vec2(SHADOW_TAP_NEAR, SHADOW_TAP_FAR) * texel),
                          shadow_tap(vec2(-SHADOW_TAP_FAR, SHADOW_TAP_NEAR) * texel),
                          shadow_tap(vec2(-SHADOW_TAP_NEAR, -SHADOW_TAP_FAR) * texel),
                          shadow_tap(vec2(SHADOW_TAP_FAR, -SHADOW_TAP_NEAR) * texel)));
}

// At reference: a square of taps. Which of the two is the tier of the shadow, whatever that of the surface it falls on.
//@domain FULL vec3 shadow_at: 0..1; HALF sampler2DShadow shadow_map: 0..1
//@promise in 0..1; where shadow_map.x == shadow_map.y: within(result, shadow_map.x, 0.02)
//@jumps floor(4096.0 * shadow_at.x)
float sun_share_of_square() {
    FULL float texel = 1.0 / float(SHADOW_MAP_SIZE_REFERENCE);  // FULL: see shadow_tap
    FULL float sum = 0.0;  // FULL: half rounds each of 36 sums, half a code together
    for (int y = 0; y < SHADOW_TAPS_REFERENCE; y++) {
        for (int x = 0; x < SHADOW_TAPS_REFERENCE; x++) {
            FULL vec2 at = vec2(float(x), float(y)) - 0.5 * float(SHADOW_TAPS_REFERENCE - 1);  // FULL: see shadow_tap
            sum += shadow_tap(at * texel);
        }
    }
    return sum * (1.0 / float(SHADOW_TAPS_REFERENCE * SHADOW_TAPS_REFERENCE));
}
