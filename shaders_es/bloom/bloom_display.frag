// The glow as display values, for a frame that holds no light: the blend lays it over what is there, as
// 1 - (1 - glow) * (1 - picture), because adding display values would bleach what is lit already.
#include "bloom/bloom.glsl"

FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: half has 2048 places from 0.5 to 1, fewer than a picture 4096 wide
uniform HALF sampler2D image;
FRAGMENT_UNIFORM HALF vec4 strength;  // x

void main() { fragment_color = vec4(tone_map(bloom_of_stored(sample_2d(image, vertex_uv).rgb) * strength.x), 0.0); }
