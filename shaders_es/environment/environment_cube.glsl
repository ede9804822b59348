// Fragment stage, console and reference: one fetch from the level that was smoothed for the surface's power.
#include "environment/environment.glsl"
#include "environment/environment_by_vertex.glsl"

uniform HALF samplerCube reflection_map;
FRAGMENT_UNIFORM HALF vec4 reflection_scale;  // x: root of the range and exposure (RGBM8) or the exposure (float); y: roughest level

#ifdef IRRADIANCE_BY_VERTEX
FRAGMENT_IN HALF vec3 vertex_irradiance;
//@not_run it returns a varying
vec3 environment_irradiance(vec3 n) { return vertex_irradiance; }
#else
FRAGMENT_UNIFORM HALF vec4 irradiance_terms[9];
//@not_run it hands nine uniforms to irradiance()
vec3 environment_irradiance(vec3 n) {
    return irradiance(n, irradiance_terms[0].rgb, irradiance_terms[1].rgb, irradiance_terms[2].rgb,
                      irradiance_terms[3].rgb, irradiance_terms[4].rgb, irradiance_terms[5].rgb,
                      irradiance_terms[6].rgb, irradiance_terms[7].rgb, irradiance_terms[8].rgb);
}
#endif

// Half is enough for a direction here: its 11 bits are a thirtieth of a degree, a texel of the largest cube half a degree.
//@not_run it reads a texture; what it computes is reflection_level and unpacked_rgbm
vec3 environment_reflection(vec3 toward, float smoothness) {
    vec4 stored = sample_cube_lod(reflection_map, toward, reflection_level(smoothness, reflection_scale.y));
#ifdef TIER_REFERENCE
    return stored.rgb * reflection_scale.x;
#else
    return unpacked_rgbm(stored, reflection_scale.x);
#endif
}
