// How linear light is packed into scene_color where the target is not a float one.
//
// RGB10_A2 holds sqrt(light / 8): 8 is where the tone map reaches 1.0 (255), and the square root spends the ten bits as
// the eye does: the first step above black is 8 / 1023^2 = 7.6e-6, where a linear code would start at 7.8e-3, two display
// codes. The root is scaled, not the light: an eighth of a faint light, or the square of a small code, is subnormal in half
// (without subnormals, all below a code of 8 was black). Blending happens on the packed values, so translucents come out darker than in light: 7 codes on average.
#include "common/packing_limits.h"

//@domain light: 0..8
//@promise in 0..1; rising light; within(unpacked_scene_color(result), light, 0.002 * SCENE_COLOR_RANGE)
vec3 packed_scene_color(vec3 light) { return sqrt(light) * SCENE_COLOR_PACK; }
//@domain stored: 0..1
//@promise in 0..8; rising stored
vec3 unpacked_scene_color(vec3 stored) {
    vec3 root = stored * SCENE_COLOR_UNPACK;
    return root * root;
}
