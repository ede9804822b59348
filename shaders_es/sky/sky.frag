// The sky's colour along a ray.
#include "common/maths.glsl"
#include "common/packing.glsl"
#include "tone_map/tone_map.glsl"
#include "sky/sky.glsl"

FRAGMENT_IN HALF vec3 vertex_ray;
FRAGMENT_UNIFORM HALF vec4 zenith;   // display values
FRAGMENT_UNIFORM HALF vec4 horizon;
FRAGMENT_UNIFORM HALF vec4 ground;

void main() {
    vec3 display = sky_gradient(normalize(vertex_ray).y, zenith.rgb, horizon.rgb, ground.rgb);
#ifdef SCENE_COLOR_DISPLAY
    fragment_color = vec4(display, 1.0);
#else
    vec3 light = inverse_tone_map(display);
#ifdef SCENE_COLOR_PACKED
    light = packed_scene_color(light);
#endif
    fragment_color = vec4(light, 1.0);
#endif
}
