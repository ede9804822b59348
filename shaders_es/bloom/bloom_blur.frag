// One direction of the blur.
#include "bloom/bloom.glsl"

FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: half has 2048 places from 0.5 to 1, fewer than a picture 4096 wide
uniform HALF sampler2D image;
FRAGMENT_UNIFORM FULL vec4 texel;  // xy: one texel in the direction of the blur. FULL: as in bloom_bright.frag

// Both taps at that distance. FULL: a uv is made of it.
//@domain apart: -0.1..0.1; FULL vec2 vertex_uv: 0..1; HALF sampler2D image: 0..8
//@promise in 0..16
//@jumps step(0.5, vertex_uv.x - apart.x); step(0.5, vertex_uv.x + apart.x)
vec3 pair(FULL vec2 apart) {
    return bloom_of_stored(sample_2d(image, vertex_uv - apart).rgb) +
           bloom_of_stored(sample_2d(image, vertex_uv + apart).rgb);
}

void main() {
    vec3 sum = bloom_of_stored(sample_2d(image, vertex_uv).rgb) * blur_weight(0.0);
#if defined(TIER_CONSOLE) && !defined(BLOOM_PACKED)
    // A filtered fetch stands for two taps: 9 fetches for 17. What is packed cannot be filtered.
    for (int i = 1; i < BLOOM_RADIUS; i += 2) {
        float weight = blur_weight(float(i)) + blur_weight(float(i + 1));
        sum += weight * pair(blur_pair_at(float(i)) * texel.xy);
    }
#else
    for (int i = 1; i <= BLOOM_RADIUS; i++) sum += blur_weight(float(i)) * pair(float(i) * texel.xy);
#endif
    fragment_color = vec4(stored_bloom(sum), 1.0);
}
