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
#if defined(LIT_BY_VERTEX) && !defined(MIRROR_BY_VERTEX)
uniform highp vec4 mirror_scale;  // x: as reflection_scale.x of environment_one_level.glsl
#endif
#ifdef MIRROR_BY_VERTEX
uniform highp vec4 mirror_terms[12];  // 9: an axis, unit; 10 and 11: bands 3 and 4 about it

// What a very rough surface mirrors of the unit ray `toward`: the cube that its fragments would read, as nine spherical
// harmonics of the root of its light and what two bands more have of the brightest lamp (reflection_harmonics.h).
//@stage vertex
//@variant TIER_LOW CONSTANT_SMOOTHNESS LIT_BY_VERTEX MIRROR_BY_VERTEX
//@domain toward: unit; highp vec4 mirror_terms[12]: -64..64; where dot(mirror_terms[9].xyz, mirror_terms[9].xyz) <= 1.0
//@promise in 0..65504
vec3 rough_reflection(vec3 toward) {
    float x = toward.x, y = toward.y, z = toward.z;
    vec3 sum = mirror_terms[0].rgb + mirror_terms[1].rgb * y + mirror_terms[2].rgb * z + mirror_terms[3].rgb * x;
    sum += mirror_terms[4].rgb * (x * y) + mirror_terms[5].rgb * (y * z) + mirror_terms[6].rgb * (3.0 * z * z - 1.0);
    sum += mirror_terms[7].rgb * (x * z) + mirror_terms[8].rgb * (x * x - y * y);
    sum += bands_about_axis(dot(toward, mirror_terms[9].xyz), mirror_terms[10].rgb, mirror_terms[11].rgb);
    sum = clamp(sum, 0.0, 250.0);  // its square is in half's range
    return sum * sum;
}
#endif
#else
//@not_run it has nothing to do here: the fragment stage adds the light up
void place_irradiance(vec3 n) {}
#endif
