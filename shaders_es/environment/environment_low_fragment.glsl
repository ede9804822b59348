// Fragment stage, low: ES 2.0 cannot choose a level, so two cubes without levels and the diffuse light are mixed.
#include "environment/environment.glsl"

FRAGMENT_IN HALF vec3 vertex_irradiance;
uniform HALF samplerCube reflection_map;
uniform HALF samplerCube rough_reflection_map;
FRAGMENT_UNIFORM HALF vec4 reflection_scale;  // x: root of the range and exposure

//@not_run it reads textures; what it computes is unpacked_rgbm and mixed_reflection
vec3 environment_reflection(vec3 toward, float smoothness) {
    vec3 sharp = unpacked_rgbm(sample_cube(reflection_map, toward), reflection_scale.x);
    vec3 rough = unpacked_rgbm(sample_cube(rough_reflection_map, toward), reflection_scale.x);
    return mixed_reflection(vertex_irradiance, rough, sharp, smoothness);
}
