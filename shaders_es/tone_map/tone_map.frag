// Linear light to display values.
#include "common/maths.glsl"
#include "common/packing.glsl"
#include "tone_map/tone_map.glsl"

FRAGMENT_IN FULL vec2 vertex_uv;
uniform HALF sampler2D scene_color;

void main() {
    vec3 stored = sample_2d(scene_color, vertex_uv).rgb;
#ifdef SCENE_COLOR_PACKED
    stored = unpacked_scene_color(stored);
#endif
    // A NaN or a negative in scene_color must not reach the curve: it has a pole at -0.22.
    fragment_color = vec4(tone_map(storable(stored, TONE_MAP_RANGE)), 1.0);
}
