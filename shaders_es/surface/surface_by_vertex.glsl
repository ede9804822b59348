// Vertex stage, low: where nothing of a material varies from place to place and triangles are small, vertices carry all of its
// light but two things that fragments have to find: what they mirror, and how far the sun is from that. The mirrored ray itself
// changes linearly over a flat face; where two normals are 30 degrees apart, what lies between them errs by 1.4 degrees.
// With MIRROR_BY_VERTEX the material is so rough that both turn as slowly as diffuse light, and vertices carry them too.
#include "common/maths.glsl"
#include "surface/surface.glsl"

// Names of their own: the fragment stage has uniforms of the same meaning in another precision.
uniform highp vec4 lit_albedo;    // rgb; w smoothness
uniform highp vec4 lit_specular;  // rgb: of the specular colour what the vertices' own does not tint; w power
uniform highp vec4 lit_metal;     // rgb: what it does
uniform highp vec4 lit_emission;  // rgb
uniform highp vec4 lit_ambient;   // rgb
#ifdef SUN
uniform highp vec4 lit_sun_direction;  // xyz unit, towards the sun
uniform highp vec4 lit_sun_color;      // rgb
#ifndef MIRROR_BY_VERTEX
VERTEX_OUT HALF vec4 vertex_highlight;
#endif
#endif
VERTEX_OUT HALF vec3 vertex_light;
#ifndef MIRROR_BY_VERTEX
VERTEX_OUT FULL vec3 vertex_mirrored;  // FULL: as long as the way to the eye
VERTEX_OUT HALF vec3 vertex_mirror;  // root of Fresnel, and of what scales the mirrored light
#endif

// Past half's range a 0 in the fragment stage would make it NaN.
//@stage vertex
//@variant TIER_LOW
//@domain x: 0..1e9
//@promise in 0..60000
vec3 carried(vec3 x) { return min(x, vec3(60000.0)); }

// Where the ray from the eye goes on; as long as `to_eye`.
//@stage vertex
//@variant TIER_LOW
//@domain n, to_eye: unit
//@promise in -1.001..1.001
vec3 mirrored_ray(vec3 n, vec3 to_eye) { return n * (2.0 * dot(n, to_eye)) - to_eye; }

// Fresnel of the sun: l.h is n.l in the middle of the highlight, and n.l is what vertices between vary smoothly.
//@stage vertex
//@variant TIER_LOW SUN
//@variant TIER_LOW SUN CONSTANT_SMOOTHNESS MIRROR_BY_VERTEX
//@domain n, to_eye: unit; color: 0..1; diffuse_light, mirrored_light: 0..60000; highp vec4 lit_albedo: 0..1; highp vec4 lit_specular: 0..1; where lit_specular.w >= 0.001; highp vec4 lit_metal: 0..1; highp vec4 lit_emission: 0..60000; highp vec4 lit_sun_direction: -1..1; highp vec4 lit_sun_color: 0..60000
//@writes HALF vec3 vertex_light
//@promise in 0..60000
void light_vertex(vec3 n, vec3 to_eye, vec3 color, vec3 diffuse_light, vec3 mirrored_light) {
    vec3 albedo = lit_albedo.rgb * color;
    vec3 specular = min(lit_specular.rgb + lit_metal.rgb * color, vec3(1.0));
    vec3 v = normalize(to_eye);
    vec3 mirror = fresnel_glossy(specular, lit_albedo.w, saturate(dot(n, v)));
#ifndef MIRROR_BY_VERTEX
    vertex_mirrored = mirrored_ray(n, to_eye);
    vertex_mirror = sqrt(mirror);
#endif
    vec3 light = lit_emission.rgb + albedo * diffuse_light + mirror * mirrored_light;
#ifdef SUN
    float n_dot_l = saturate(dot(n, lit_sun_direction.xyz));
    vec3 sun_light = lit_sun_color.rgb * n_dot_l;
    light += albedo * sun_light;
    vec3 highlight = fresnel_schlick(specular, n_dot_l) * sun_light * ((lit_specular.w + 2.0) * 0.125);
#ifdef MIRROR_BY_VERTEX
    float root = mirrored_root(mirrored_ray(n, v), lit_sun_direction.xyz, lit_specular.w);
    light += highlight * root * root;
#else
    vertex_highlight = vec4(carried(highlight), lit_specular.w);
#endif
#endif
    vertex_light = carried(light);
}
