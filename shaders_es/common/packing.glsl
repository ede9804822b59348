// How linear light is packed into scene_color where the target is not a float one.
//
// RGB10_A2 holds sqrt(light / 8): 8 is where the tone map reaches 1.0 (255), and the square root spends the ten bits as
// the eye does: the first step above black is 8 / 1023^2 = 7.6e-6, where a linear code would start at 7.8e-3, two display
// codes. Blending happens on the packed values, so overlapping translucents come out slightly darker than in light.
#include "common/packing_limits.h"

vec3 packed_scene_color(vec3 light) { return sqrt(light * (1.0 / SCENE_COLOR_RANGE)); }
vec3 unpacked_scene_color(vec3 stored) { return stored * stored * SCENE_COLOR_RANGE; }
