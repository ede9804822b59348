// What bloom adds to the light that tone_map maps.
#include "bloom/bloom.glsl"

uniform HALF sampler2D bloom;
FRAGMENT_UNIFORM FULL vec4 bloom_scale;  // xy: from the frame's uv to the glow's. FULL: it multiplies a uv. z strength

// FULL: a uv.
//@domain uv: 0..1; HALF sampler2D bloom: 0..8; FULL vec4 bloom_scale: 0..1
//@promise in 0..8; where bloom_scale.z == 0.0: result == vec3(0.0)
//@jumps step(0.5, uv.x * bloom_scale.x)
vec3 bloom_light(FULL vec2 uv) { return bloom_of_stored(sample_2d(bloom, uv * bloom_scale.xy).rgb) * bloom_scale.z; }
