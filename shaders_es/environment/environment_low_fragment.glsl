// Fragment stage, low: ES 2.0 cannot choose a level, so where smoothness varies two cubes and the diffuse light are mixed.
#include "environment/environment.glsl"
#include "environment/environment_one_level.glsl"

FRAGMENT_IN HALF vec3 vertex_irradiance;

#ifndef ONE_LEVEL
uniform HALF samplerCube reflection_map;
uniform HALF samplerCube rough_reflection_map;

//@variant TIER_LOW
//@domain toward: unit; smoothness: 0..1; HALF vec3 vertex_irradiance: 0..64; HALF samplerCube reflection_map: 0..1; HALF samplerCube rough_reflection_map: 0..1; HALF vec4 reflection_scale: 0..8
//@promise in 0..64; where smoothness == 0.0: result == vertex_irradiance
//@jumps step(0.5, toward.x)
//@exempt half_flushed, es_minimum: within 2.0 * exp2(-14.0); each of two lights read is 0 below 2^-14 before they are mixed
vec3 environment_reflection(vec3 toward, float smoothness) {
    vec3 sharp = unpacked_rgbm(sample_cube(reflection_map, toward), reflection_scale.x);
    vec3 rough = unpacked_rgbm(sample_cube(rough_reflection_map, toward), reflection_scale.x);
    return mixed_reflection(vertex_irradiance, rough, sharp, smoothness);
}
#endif
