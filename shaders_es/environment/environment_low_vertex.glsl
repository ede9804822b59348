// Vertex stage, low: diffuse light by vertex, so that the fragment stage stays inside 16 uniform vectors.
#include "environment/environment.glsl"

uniform highp vec4 irradiance_terms[9];
VERTEX_OUT HALF vec3 vertex_irradiance;

vec3 environment_irradiance(vec3 n) {
    return irradiance(n, irradiance_terms[0].rgb, irradiance_terms[1].rgb, irradiance_terms[2].rgb,
                      irradiance_terms[3].rgb, irradiance_terms[4].rgb, irradiance_terms[5].rgb,
                      irradiance_terms[6].rgb, irradiance_terms[7].rgb, irradiance_terms[8].rgb);
}
