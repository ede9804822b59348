// Fragment stage, console and reference: one fetch from the level that was smoothed for the surface's power.
#include "environment/environment.glsl"
#include "environment/environment_by_vertex.glsl"
#include "environment/environment_one_level.glsl"

#ifdef IRRADIANCE_BY_VERTEX
FRAGMENT_IN HALF vec3 vertex_irradiance;
//@domain n: unit; HALF vec3 vertex_irradiance: 0..1024
//@promise in 0..1024; result == vertex_irradiance
vec3 environment_irradiance(vec3 n) { return vertex_irradiance; }
#else
FRAGMENT_UNIFORM HALF vec4 irradiance_terms[9];
//@variant TIER_REFERENCE
//@domain n: unit; HALF vec4 irradiance_terms[9]: -64..64
//@promise in 0..65504
vec3 environment_irradiance(vec3 n) {
    return irradiance(n, irradiance_terms[0].rgb, irradiance_terms[1].rgb, irradiance_terms[2].rgb,
                      irradiance_terms[3].rgb, irradiance_terms[4].rgb, irradiance_terms[5].rgb,
                      irradiance_terms[6].rgb, irradiance_terms[7].rgb, irradiance_terms[8].rgb);
}
#endif

#ifndef ONE_LEVEL
uniform HALF samplerCube reflection_map;

// Half is enough for a direction here: its 11 bits are a thirtieth of a degree, a texel of the largest cube half a degree.
//@variant TIER_CONSOLE
//@variant TIER_REFERENCE
//@domain toward: unit; smoothness: 0..1; HALF samplerCube reflection_map: 0..1; HALF vec4 reflection_scale: 0..8
//@promise in 0..64; where reflection_scale.x == 0.0: result == vec3(0.0)
//@jumps step(0.5, toward.x)
vec3 environment_reflection(vec3 toward, float smoothness) {
    vec4 stored = sample_cube_lod(reflection_map, toward, reflection_level(smoothness, reflection_scale.y));
#ifdef TIER_REFERENCE
    return stored.rgb * reflection_scale.x;
#else
    return unpacked_rgbm(stored, reflection_scale.x);
#endif
}
#endif
