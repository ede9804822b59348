// What blooms, how it is stored, and how it spreads.
#include "common/maths.glsl"
#include "common/packing.glsl"
#include "tone_map/tone_map.glsl"
#include "bloom/bloom_limits.h"

#ifdef TIER_LOW
#define BLOOM_TAPS 4  // each the mean of four pixels: the sampler filters
#define BLOOM_RADIUS BLOOM_LOW_RADIUS
#define BLOOM_SHARPNESS BLOOM_LOW_SHARPNESS
#define BLOOM_PEAK BLOOM_LOW_PEAK
#endif
#ifdef TIER_CONSOLE
#define BLOOM_TAPS 4
#define BLOOM_RADIUS BLOOM_CONSOLE_RADIUS
#define BLOOM_SHARPNESS BLOOM_CONSOLE_SHARPNESS
#define BLOOM_PEAK BLOOM_CONSOLE_PEAK
#endif
#ifdef TIER_REFERENCE
#define BLOOM_TAPS 2
#define BLOOM_RADIUS BLOOM_REFERENCE_RADIUS
#define BLOOM_SHARPNESS BLOOM_REFERENCE_SHARPNESS
#define BLOOM_PEAK BLOOM_REFERENCE_PEAK
#endif

// Fixed-point targets hold the square root of the glow, as scene_color does in RGB10_A2: most of a glow is faint.
#ifdef SCENE_COLOR_PACKED
#define BLOOM_PACKED
#endif
#ifdef SCENE_COLOR_DISPLAY
#define BLOOM_PACKED
#endif

// The part of `light` above the threshold, in its own hue: the brightest channel gives its excess, the others in
// proportion. It grows from 0, so it needs no soft knee. This is the gate of the whole effect: NaN, inf and negatives
// end here, by comparison, and what leaves is within 0..7.
//@domain light: any
//@promise finite; in 0..7
vec3 light_above_threshold(vec3 light) {
    vec3 bounded = storable(light, BLOOM_LIGHT_LIMIT);
    float brightest = max(max(bounded.r, bounded.g), bounded.b);
    if (brightest > BLOOM_THRESHOLD) return bounded * ((brightest - BLOOM_THRESHOLD) / brightest);
    return vec3(0.0);
}

// Linear light of a texel of scene_color.
//@variant TIER_CONSOLE SCENE_COLOR_PACKED
//@variant TIER_CONSOLE SCENE_COLOR_DISPLAY
//@domain stored: 0..1
//@promise in 0..8; rising stored
vec3 light_of_scene_color(vec3 stored) {
#ifdef SCENE_COLOR_DISPLAY
    // A code stands for the least light that is rounded to it: the light of 1 is 214.76, stored as 215.
    return inverse_tone_map(stored - 0.5 / 255.0);
#else
#ifdef SCENE_COLOR_PACKED
    return unpacked_scene_color(stored);
#else
    return stored;
#endif
#endif
}

// The blur's weight of a tap `texels` away.
//@variant TIER_LOW
//@variant TIER_CONSOLE
//@variant TIER_REFERENCE
//@domain texels: 0..18
//@promise in 0..1; falling texels
float blur_weight(float texels) { return BLOOM_PEAK * exp2(-BLOOM_SHARPNESS * texels * texels); }

// Where between taps `texels` and `texels` + 1 a filtered fetch weighs both as the blur does.
//@domain texels: 0..8; where texels == floor(texels)
//@promise rising texels; result >= texels && result <= texels + 1.0
float blur_pair_at(float texels) {
    float near = blur_weight(texels);
    float far = blur_weight(texels + 1.0);
    return texels + far / (near + far);
}

//@variant TIER_CONSOLE SCENE_COLOR_PACKED
//@domain glow: 0..8
//@promise in 0..1; rising glow
vec3 stored_bloom(vec3 glow) {
#ifdef BLOOM_PACKED
    return packed_scene_color(glow);
#else
    return glow;
#endif
}

//@variant TIER_CONSOLE SCENE_COLOR_PACKED
//@domain stored: 0..1
//@promise in 0..8; rising stored
vec3 bloom_of_stored(vec3 stored) {
#ifdef BLOOM_PACKED
    return unpacked_scene_color(stored);
#else
    return stored;
#endif
}
