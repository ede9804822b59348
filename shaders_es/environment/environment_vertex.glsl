// Vertex stage: diffuse light by vertex, where environment_by_vertex.glsl says so.
#include "environment/environment.glsl"
#include "environment/environment_by_vertex.glsl"

#ifdef IRRADIANCE_BY_VERTEX
uniform highp vec4 irradiance_terms[9];
VERTEX_OUT HALF vec3 vertex_irradiance;

//@stage vertex
//@variant TIER_LOW
//@domain n: unit; highp vec4 irradiance_terms[9]: -64..64
//@writes HALF vec3 vertex_irradiance
//@promise in 0..65504
void place_irradiance(vec3 n) {
    vertex_irradiance =
        irradiance(n, irradiance_terms[0].rgb, irradiance_terms[1].rgb, irradiance_terms[2].rgb,
                   irradiance_terms[3].rgb, irradiance_terms[4].rgb, irradiance_terms[5].rgb,
                   irradiance_terms[6].rgb, irradiance_terms[7].rgb, irradiance_terms[8].rgb);
}
#else
//@not_run it has nothing to do here: the fragment stage adds the light up
void place_irradiance(vec3 n) {}
#endif
