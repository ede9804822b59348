// The tone curve without a limit: 1.0275 x / (x + 0.22) is inf / x, then inf / inf, in half.
#include "tone_map/tone_map.glsl"

//@domain light: 0..65504
//@promise in 0..1.03
vec3 tone_as_printed(vec3 light) { return 1.0275 * light / (light + 0.22); }

vec3 lamp(FULL vec2 at) { return vec3(60.0, 50.0, 40.0) / dot(at - 0.5, at - 0.5) * 0.1; }
vec3 bright(FULL vec2 at) { return lamp(at) * vec3(100.0, 80.0, 60.0); }
vec3 picture_printed(FULL vec2 at) { return tone_as_printed(bright(at)); }
vec3 picture_mended(FULL vec2 at) { return tone_map(bright(at)); }
