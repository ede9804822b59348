// Linear light to display values. Insertion point:
//   tone_map.light  light >= 0, at most TONE_MAP_RANGE, may be changed
#include "common/maths.glsl"
#include "common/packing.glsl"
#include "tone_map/tone_map.glsl"

FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: half has 2048 places from 0.5 to 1, fewer than a picture 4096 wide
uniform HALF sampler2D scene_color;

//@insert_functions

void main() {
    vec3 stored = sample_2d(scene_color, vertex_uv).rgb;
#ifdef SCENE_COLOR_PACKED
    stored = unpacked_scene_color(stored);
#endif
    // A NaN or a negative in scene_color must not reach the curve: it has a pole at -0.22.
    vec3 light = storable(stored, TONE_MAP_RANGE);
    //@insert tone_map.light
    fragment_color = vec4(tone_map(light), 1.0);
}
