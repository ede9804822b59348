// What bloom adds to the light that tone_map maps.
#include "bloom/bloom.glsl"

uniform HALF sampler2D bloom;
FRAGMENT_UNIFORM FULL vec4 bloom_scale;  // xy: from the frame's uv to the glow's. FULL: it multiplies a uv. z strength

//@not_run it reads a texture; what it computes is bloom_of_stored
vec3 bloom_light(FULL vec2 uv) { return bloom_of_stored(sample_2d(bloom, uv * bloom_scale.xy).rgb) * bloom_scale.z; }
