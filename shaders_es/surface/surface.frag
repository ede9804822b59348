// Shades a surface: material, direct light, constant ambient. Insertion points for material effects, in order:
//   surface.water     wetness and puddle may be set; surface.water_normal: water_normal may be moved;
//                     surface.water_material: what follows from them (all three only in programs with WATER)
//   surface.material  albedo, specular, smoothness, power, n, v may be changed (all set, nothing lit yet)
//   surface.ambient   diffuse_light and mirrored_light, what falls in from everywhere, may be changed
//   surface.sun       sun_light may be dimmed
//   surface.mirrored  light_root, the root of what the ray `mirrored` sees, may be changed (only in programs with LIT_BY_VERTEX, which have none
//                     of the points above, and not in those with MIRROR_BY_VERTEX)
//   surface.lighting  light holds all reflected light
//   surface.color     color holds what will be stored
//
// A material is metallic-roughness (with OWN_SPECULAR where its dielectric is not the default), or SPECULAR_GLOSSINESS, or
// its colour alone: DISPLAY_COLOR. It is one file because all insertion points lie in one main(), in the order of light.
#include "surface/surface_limits.h"
#include "surface/surface_lights.glsl"
#include "common/maths.glsl"
#include "common/colour.glsl"
#include "common/packing.glsl"
#include "surface/surface.glsl"
#include "surface/surface_textures.glsl"
#include "surface/surface_material.glsl"
#include "tone_map/tone_map.glsl"

#ifndef LIT_BY_VERTEX
FRAGMENT_IN FULL vec3 vertex_to_eye;  // FULL: metres, see surface.vert
#ifndef UNLIT
FRAGMENT_IN HALF vec3 vertex_normal;
#endif
#else
FRAGMENT_IN HALF vec3 vertex_light;     // all that is diffuse, and the emission; with MIRROR_BY_VERTEX all
#ifndef MIRROR_BY_VERTEX
FRAGMENT_IN FULL vec3 vertex_mirrored;  // FULL: metres
FRAGMENT_IN HALF vec3 vertex_mirror;  // root of Fresnel: what multiplies the root of the mirrored ray's light
#ifdef SUN
FRAGMENT_IN HALF vec4 vertex_highlight;  // rgb in its middle, w power
#endif
#endif
#endif
#ifdef NORMAL_MAP
FRAGMENT_IN HALF vec4 vertex_tangent;
#endif
#ifdef VERTEX_COLOR
FRAGMENT_IN HALF vec4 vertex_color;
#endif

// The CPU multiplies every light, the ambient and the emission by the exposure: no uniform and no operation for it here.
FRAGMENT_UNIFORM HALF vec4 base_color;
FRAGMENT_UNIFORM HALF vec4 emissive;  // rgb; w alpha cutoff
#if !defined(UNLIT) && !defined(LIT_BY_VERTEX)
// x metallic, y roughness, z normal scale; without a map y is the smoothness and w the power, made on the CPU.
FRAGMENT_UNIFORM HALF vec4 factors;
FRAGMENT_UNIFORM HALF vec4 ambient;  // rgb
FRAGMENT_UNIFORM HALF vec4 specular_factors;  // rgb specular of a dielectric (or of the material); w occlusion strength
#ifndef TIER_LOW
FRAGMENT_UNIFORM HALF vec4 parallel_eye;  // orthographic: xyz direction to the eye, w 0; else 0, 0, 0, 1
#endif
#if defined(PACKED_MAPS) && defined(NORMAL_MAP) && !defined(SPECULAR_GLOSSINESS)
#define ONE_FETCH  // normal_map: rg normal x and y, b metallic, a roughness; texture_storage.h packs it
#endif
#ifdef SUN
FRAGMENT_UNIFORM HALF vec4 sun_color;  // rgb
#endif
#ifdef LOCAL_LIGHTS
#ifdef TIER_LOW
FRAGMENT_IN HALF vec3 vertex_light;
#else
#ifdef COUNTED_LIGHTS  // a loop that ends at a uniform indexes arrays: those stay where they are
uniform FULL vec4 light_position[LIGHT_SLOTS];   // FULL: metres; xyz from the eye, w = 1 / range^2
uniform HALF vec4 light_color[LIGHT_SLOTS];      // rgb, w = spot cos_scale (0: point)
uniform HALF vec4 light_direction[LIGHT_SLOTS];  // xyz unit, w = cos outer
uniform HALF vec4 light_count;                   // x
#else
FRAGMENT_UNIFORM FULL vec4 light_position[LIGHT_SLOTS];
FRAGMENT_UNIFORM HALF vec4 light_color[LIGHT_SLOTS];
#ifdef SPOT_LIGHTS
FRAGMENT_UNIFORM HALF vec4 light_direction[LIGHT_SLOTS];
#endif
#endif
#ifdef AREA_LIGHTS
uniform FULL vec4 light_size[LIGHT_SLOTS];  // FULL: metres squared; x radius [m], y radius^2; 0: a point
#endif
#endif
#endif
#endif

#if defined(SUN) && !defined(UNLIT) && !defined(MIRROR_BY_VERTEX)
FRAGMENT_UNIFORM HALF vec4 sun_direction;  // xyz unit, towards the sun
#endif

#include "surface/surface_water.glsl"

//@insert_functions

void main() {
    vec4 base = base_color;
#ifdef VERTEX_COLOR
    base *= vertex_factor;
#endif
#ifdef BASE_COLOR_MAP
    base.rgb *= base_texel(base_color_map, BASE_COLOR_AT);
#if defined(OCCLUSION_IN_BASE)
    float base_occlusion = sample_2d(base_color_map, BASE_COLOR_AT).a;  // opaque: alpha means nothing
#elif defined(EMISSION_IN_BASE)
    float base_emission = sample_2d(base_color_map, BASE_COLOR_AT).a;  // the same, a share of the emission
#else
    base.a *= sample_2d(base_color_map, BASE_COLOR_AT).a;
#endif
#endif
#ifdef ALPHA_MASK
    if (base.a < emissive.w) discard;
#endif
    vec3 emission = emissive.rgb;
#if defined(EMISSION_IN_BASE) && !defined(OCCLUSION_IN_BASE) && defined(BASE_COLOR_MAP)
    emission *= base_emission;
#elif defined(EMISSIVE_MAP)
    emission *= color_texel(emissive_map, EMISSIVE_AT);
#endif

#if defined(DISPLAY_COLOR)
#ifdef TIER_LOW
    vec3 shown = clamp(base.rgb, 0.0, 1.0);
#else
    vec3 shown = srgb_from_linear(clamp(base.rgb, 0.0, 1.0));
#endif
    vec3 light = inverse_tone_map(shown);
#elif defined(UNLIT)
    vec3 light = base.rgb + emission;
#elif defined(MIRROR_BY_VERTEX)
    vec3 light = vertex_light;
#elif defined(LIT_BY_VERTEX)
    // FULL: the highlight is its distance to the sun.
    FULL vec3 mirrored = vertex_mirrored * inversesqrt(max(dot(vertex_mirrored, vertex_mirrored), 6.2e-5));
    float smoothness = 0.0;  // one for the whole surface: its cube is chosen already
    vec3 light_root = vec3(0.0);
    //@insert surface.mirrored
    light_root *= vertex_mirror;
    vec3 light = vertex_light + light_root * light_root;
#ifdef SUN
    float root = mirrored_root(mirrored, sun_direction.xyz, vertex_highlight.w);
    light += vertex_highlight.rgb * root * root;
#endif
#else
    float metallic = factors.x;
#ifdef ONE_FETCH
    vec4 packed_map = sample_2d(normal_map, NORMAL_AT);
    metallic *= packed_map.b;
    float power = power_from_roughness(factors.y * packed_map.a);
    float smoothness = smoothness_from_power(power);
#elif defined(SPECULAR_GLOSSINESS) && defined(SPECULAR_GLOSSINESS_MAP)
    float power = power_from_roughness(1.0 - factors.y * sample_2d(specular_glossiness_map, ROUGHNESS_AT).a);
    float smoothness = smoothness_from_power(power);
#elif defined(METALLIC_ROUGHNESS_MAP)
    vec4 packed_factors = sample_2d(metallic_roughness_map, ROUGHNESS_AT);
    metallic *= packed_factors.b;
    float power = power_from_roughness(factors.y * packed_factors.g);
    float smoothness = smoothness_from_power(power);
#else
    float power = factors.w;
    float smoothness = factors.y;
#endif
#ifdef SPECULAR_GLOSSINESS
    vec3 specular = specular_factors.rgb;
#ifdef SPECULAR_GLOSSINESS_MAP
    specular *= color_texel(specular_glossiness_map, ROUGHNESS_AT);
#endif
    vec3 albedo = albedo_beside(base.rgb, specular);
#else
    vec3 albedo = base.rgb * (1.0 - metallic);
#ifdef OWN_SPECULAR
    vec3 tint = vec3(1.0);
    float share = 1.0;
#ifdef SPECULAR_COLOR_MAP
    tint = color_texel(specular_color_map, SPECULAR_COLOR_AT);
#endif
#if defined(SPECULAR_MAP) && !defined(TIER_LOW)
    share = sample_2d(specular_map, SPECULAR_AT).a;
#endif
    vec3 specular = mix(dielectric_specular(specular_factors.rgb, tint, share), base.rgb, metallic);
#else
    vec3 specular = mix(vec3(SURFACE_DIELECTRIC_SPECULAR), base.rgb, metallic);
#endif
#endif

    // FULL: the highlight is the difference of n and h (see blinn_lobe).
#ifndef NORMAL_MAP
    FULL vec3 n = normalize(vertex_normal);
#else
    // Neither is normalised nor made upright, so that a map shows what it was baked for (M. Mikkelsen, MikkTSpace, 2011).
    FULL vec3 n = vertex_normal;
    FULL vec3 t = vertex_tangent.xyz;
    FULL vec3 b = cross(n, t) * vertex_tangent.w;
#ifdef ONE_FETCH
    FULL vec3 bump = vec3(packed_map.xy * 2.0 - 1.0, 0.0);
    bump.z = sqrt(max(1.0 - dot(bump.xy, bump.xy), 0.0));
#else
    FULL vec3 bump = sample_2d(normal_map, NORMAL_AT).xyz * 2.0 - 1.0;
#endif
    bump.xy *= factors.z;
    n = normalize(t * bump.x + b * bump.y + n * max(bump.z, 0.01));
#endif
#ifdef DOUBLE_SIDED
    n = gl_FrontFacing ? n : -n;
#endif
#ifdef TIER_LOW
    FULL vec3 v = normalize(vertex_to_eye);  // FULL: h is made of it
#else
    FULL vec3 v = normalize(vertex_to_eye * parallel_eye.w + parallel_eye.xyz);
#endif

#ifdef WATER
    vec3 water = water_place();
    vec2 wetness = vec2(0.0);  // 0..1: of what darkens, of what smooths
    float puddle = 0.0;        // 0..1: share of open water
    FULL vec3 water_normal = vec3(0.0, 1.0, 0.0);  // FULL: it becomes n
    //@insert surface.water
    //@insert surface.water_normal
    //@insert surface.water_material
#endif
    //@insert surface.material

    float n_dot_v = saturate(dot(n, v));
    vec3 diffuse_light = ambient.rgb;
    vec3 mirrored_light = ambient.rgb;
    //@insert surface.ambient
#if defined(OCCLUSION_MAP)
    float arriving = occlusion_share(sample_2d(occlusion_map, OCCLUSION_AT).r, specular_factors.w);
    diffuse_light *= arriving;
    mirrored_light *= arriving;
#elif defined(OCCLUSION_IN_BASE) && defined(BASE_COLOR_MAP)
    float arriving = occlusion_share(base_occlusion, specular_factors.w);
    diffuse_light *= arriving;
    mirrored_light *= arriving;
#elif defined(OCCLUSION_PACKED) && defined(METALLIC_ROUGHNESS_MAP)
    float arriving = occlusion_share(packed_factors.r, specular_factors.w);  // one picture, one fetch
    diffuse_light *= arriving;
    mirrored_light *= arriving;
#endif
    vec3 light = albedo * diffuse_light + fresnel_glossy(specular, smoothness, n_dot_v) * mirrored_light + emission;
#ifdef SUN
    vec3 sun_light = sun_color.rgb;
    //@insert surface.sun
    light += direct_light(albedo, specular, power, n, v, sun_direction.xyz, sun_light);
#endif
#ifdef LOCAL_LIGHTS
#ifdef TIER_LOW
    light += albedo * vertex_light;
#else
    for (int i = 0; i < LIGHT_SLOTS; i++) {
#ifdef COUNTED_LIGHTS
        if (float(i) >= light_count.x) break;
#endif
        FULL vec3 to_light = light_position[i].xyz + vertex_to_eye;  // FULL: metres; then their squares, and l for h
        FULL float distance_squared = dot(to_light, to_light);
        FULL vec3 l = to_light * inversesqrt(max(distance_squared, 1e-8));
#ifdef AREA_LIGHTS
        distance_squared = max(distance_squared, light_size[i].y);  // inside the sphere it is as bright as on it
#endif
        float falloff = distance_falloff(distance_squared, light_position[i].w);
#ifdef SPOT_LIGHTS
        if (light_color[i].w > 0.0) {
            falloff *= cone_falloff(dot(-l, light_direction[i].xyz), light_direction[i].w, light_color[i].w);
        }
#endif
#ifdef AREA_LIGHTS
        light += sphere_light(albedo, specular, power, n, v, l, light_color[i].rgb * falloff,
                              light_size[i].x * inversesqrt(max(distance_squared, 1e-8)));
#else
        light += direct_light(albedo, specular, power, n, v, l, light_color[i].rgb * falloff);
#endif
    }
#endif
#endif
#endif

    //@insert surface.lighting

    vec3 color = storable(light, SURFACE_STORE_LIMIT);
    //@insert surface.color
#if defined(DISPLAY_COLOR) && defined(SCENE_COLOR_DISPLAY)
    color = shown;  // stored as it is shown: there and back again would only lose bits
#endif
#ifdef SCENE_COLOR_PACKED
    color = packed_scene_color(min(color, vec3(SCENE_COLOR_RANGE)));
#endif
#ifdef ALPHA_BLEND
    fragment_color = vec4(color, saturate(base.a));
#else
    fragment_color = vec4(color, 1.0);
#endif
}
