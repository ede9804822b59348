// Places a vertex, and hands on what the fragment stage interpolates. All positions are relative to the eye (the CPU
// subtracts in double), so a scene 10 km from the origin shades as it does at the origin. Insertion point:
//   surface.vertex        at [m] from the eye, n (the side that is seen where vertices are lit); lit surfaces only
//   surface.vertex_light  diffuse_light and mirrored_light, what falls in from everywhere, may be changed; with LIT_BY_VERTEX only
//   surface.vertex_mirror  vertex_mirror, which multiplies the root at surface.mirrored, may be; with LIT_BY_VERTEX, not MIRROR_BY_VERTEX
//   surface.vertex_mirrored  mirrored_light, that of the unit ray `mirrored`, may be changed; with MIRROR_BY_VERTEX only
#include "surface/surface_limits.h"
#include "surface/surface_lights.glsl"
#include "common/maths.glsl"
#include "common/mesh_vertex.glsl"
#include "common/uv_mapping.glsl"
#include "common/vertex_decode.glsl"

VERTEX_IN vec3 position;  // local, as stored
VERTEX_IN vec2 normal;    // octahedral
VERTEX_IN vec2 tangent;   // octahedral, with its handedness
VERTEX_IN vec4 color;     // linear

uniform highp mat4 clip_from_local;
uniform highp mat4 eye_from_local;     // world axes, origin at the eye
uniform highp mat4 normal_from_local;  // inverse transpose, world axes
#ifdef NORMAL_MAP
uniform highp vec4 direction_scale;    // xyz: undoes the scale of stored positions, which is in eye_from_local
#endif
uniform highp vec4 toward_eye;         // xyz: direction to the eye if orthographic; w: scale of lengths, see surface_work.cpp

#ifdef LIT_BY_VERTEX
highp vec3 vertex_to_eye;
highp vec3 vertex_normal;
#else
VERTEX_OUT FULL vec3 vertex_to_eye;  // FULL: positions in metres need more than 11 bits
#endif
VERTEX_OUT FULL vec2 vertex_uv;      // FULL: a 2048-texel repeat is past half's 11 bits
#ifdef UV_B
VERTEX_OUT FULL vec2 vertex_uv_b;
#endif
#if !defined(UNLIT) && !defined(LIT_BY_VERTEX)
VERTEX_OUT HALF vec3 vertex_normal;
#endif
#ifdef NORMAL_MAP
VERTEX_OUT HALF vec4 vertex_tangent;
#endif
#ifdef VERTEX_COLOR
VERTEX_OUT HALF vec4 vertex_color;
#endif

#if (defined(LOCAL_LIGHTS) && defined(TIER_LOW)) || defined(LIT_BY_VERTEX)
#include "surface/surface.glsl"
#endif
#ifdef LIT_BY_VERTEX
#include "surface/surface_by_vertex.glsl"
#endif

#if defined(LOCAL_LIGHTS) && defined(TIER_LOW)
// Low tier: local lights are diffuse and per vertex, so that the fragment stage stays inside 16 uniform vectors.
uniform highp vec4 light_position[LIGHT_SLOTS];   // xyz [m] from the eye, w = 1 / range^2
uniform highp vec4 light_color[LIGHT_SLOTS];      // rgb, w = spot cos_scale (0: point)
uniform highp vec4 light_direction[LIGHT_SLOTS];  // xyz unit, w = cos outer
uniform highp vec4 light_count;                           // x
#ifndef LIT_BY_VERTEX
VERTEX_OUT HALF vec3 vertex_light;
#endif

//@stage vertex
//@variant TIER_LOW LOCAL_LIGHTS ONE_LIGHT SPOT_LIGHTS
//@domain at: -100..100; n: unit; highp vec4 light_position[1]: -100..100; where light_position[0].w >= 1e-6 && light_color[0].w >= 0.5; highp vec4 light_color[1]: 0..250; highp vec4 light_direction[1]: -1..1
//@promise in 0..1.5e7
vec3 local_light(vec3 at, vec3 n) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LIGHT_SLOTS; i++) {
#ifdef COUNTED_LIGHTS
        if (float(i) >= light_count.x) break;
#endif
        vec3 to_light = light_position[i].xyz - at;
        float distance_squared = dot(to_light, to_light);
        vec3 l = to_light * inversesqrt(max(distance_squared, 1e-8));
        float falloff = distance_falloff(distance_squared, light_position[i].w);
#ifdef SPOT_LIGHTS
        if (light_color[i].w > 0.0) {
            falloff *= cone_falloff(dot(-l, light_direction[i].xyz), light_direction[i].w, light_color[i].w);
        }
#endif
        sum += light_color[i].rgb * (falloff * max(dot(n, l), 0.0));
    }
    return sum;
}
#endif

//@insert_functions

invariant gl_Position;  // the depth prepass writes the same depths

void main() {
#ifdef SKINNED
    skin_vertex();
    highp vec3 place = skinned_position(position);
#else
    highp vec3 place = position;
#endif
    gl_Position = clip_from_local * vec4(place, 1.0);
#ifdef POINTS
    gl_PointSize = 4.0;
#endif
    vec3 at = (eye_from_local * vec4(place, 1.0)).xyz;
#ifdef TIER_LOW
    // Fragments need no more of it than its direction: that of an orthographic view comes from here.
    vertex_to_eye = dot(toward_eye.xyz, toward_eye.xyz) > 0.5 ? toward_eye.xyz : -at * toward_eye.w;
#else
    vertex_to_eye = -at * toward_eye.w;
#endif
    vertex_uv = first_uv();
#ifdef UV_B
    vertex_uv_b = second_uv();
#endif
#ifndef UNLIT
#ifdef SKINNED
    highp vec3 upright = normalize(skinned_normal(direction_from_octahedral(normal)));
#else
    highp vec3 upright = direction_from_octahedral(normal);
#endif
    vec3 n = normalize((normal_from_local * vec4(upright, 0.0)).xyz);
    vertex_normal = n;
#if defined(DOUBLE_SIDED) && defined(TIER_LOW)
    vec3 to_eye = dot(toward_eye.xyz, toward_eye.xyz) > 0.5 ? toward_eye.xyz : -at;
    n = dot(n, to_eye) < 0.0 ? -n : n;  // a vertex has no front: it is lit on the side that is seen
#endif
#if defined(LOCAL_LIGHTS) && defined(TIER_LOW)
    vec3 local = min(local_light(at, n), vec3(60000.0));  // past half's range a metal's albedo of 0 would make it NaN
#ifndef LIT_BY_VERTEX
    vertex_light = local;
#endif
#endif
    //@insert surface.vertex
#ifdef LIT_BY_VERTEX
    vec3 diffuse_light = lit_ambient.rgb;
    vec3 mirrored_light = lit_ambient.rgb;
    //@insert surface.vertex_light
#ifdef MIRROR_BY_VERTEX
    vec3 mirrored = mirrored_ray(n, normalize(vertex_to_eye));
    //@insert surface.vertex_mirrored
#endif
#ifdef LOCAL_LIGHTS
    diffuse_light += local;
#endif
#ifdef VERTEX_COLOR
    light_vertex(n, vertex_to_eye, color.rgb, diffuse_light, mirrored_light);
#else
    light_vertex(n, vertex_to_eye, vec3(1.0), diffuse_light, mirrored_light);
#endif
#ifndef MIRROR_BY_VERTEX
    //@insert surface.vertex_mirror
#endif
#endif
#endif
#ifdef NORMAL_MAP
    vec4 t = tangent_from_octahedral(tangent);
#ifdef SKINNED
    t.xyz = normalize(skinned_tangent(t.xyz));
#endif
    vertex_tangent = vec4(normalize((eye_from_local * vec4(t.xyz * direction_scale.xyz, 0.0)).xyz), t.w);
#endif
#ifdef VERTEX_COLOR
    vertex_color = color;
#endif
}
