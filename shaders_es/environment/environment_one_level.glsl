// Fragment stage, low and console: what a surface reflects that is equally smooth everywhere. The CPU binds the cube of its
// smoothness, which has no levels: one fetch where a chain takes two.
#include "environment/environment.glsl"

FRAGMENT_UNIFORM HALF vec4 reflection_scale;  // x: root of the range and exposure (RGBM8) or the exposure (float); y: roughest level

#if defined(CONSTANT_SMOOTHNESS) && !defined(WATER)  // water smooths place by place
#define ONE_LEVEL
uniform HALF samplerCube one_level_map;

//@variant TIER_LOW CONSTANT_SMOOTHNESS
//@variant TIER_CONSOLE CONSTANT_SMOOTHNESS
//@domain toward: unit; smoothness: 0..1; HALF samplerCube one_level_map: 0..1; HALF vec4 reflection_scale: 0..8
//@promise in 0..64; where reflection_scale.x == 0.0: result == vec3(0.0)
//@jumps step(0.5, toward.x)
vec3 environment_reflection(vec3 toward, float smoothness) {
    return unpacked_rgbm(sample_cube(one_level_map, toward), reflection_scale.x);
}

// The root of that, but for reflection_scale: where vertices carry the scale.
//@variant TIER_LOW CONSTANT_SMOOTHNESS
//@domain toward: unit; HALF samplerCube one_level_map: 0..1
//@promise in 0..1
//@jumps step(0.5, toward.x)
vec3 environment_root(vec3 toward) {
    vec4 stored = sample_cube(one_level_map, toward);
    return stored.rgb * stored.a;
}
#endif
