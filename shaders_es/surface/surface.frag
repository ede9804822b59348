// Shades a surface: material, direct light, constant ambient. Insertion points for material effects, in order:
//   surface.material  albedo, specular, smoothness, power, n, v may be changed (all set, nothing lit yet)
//   surface.ambient   diffuse_light and mirrored_light, what falls in from everywhere, may be changed
//   surface.sun       sun_light may be dimmed
//   surface.lighting  light holds all reflected light
//   surface.color     color holds what will be stored
#include "surface/surface_limits.h"
#include "surface/surface_lights.glsl"
#include "common/maths.glsl"
#include "common/colour.glsl"
#include "common/packing.glsl"
#include "surface/surface.glsl"

FRAGMENT_IN FULL vec3 vertex_to_eye;
FRAGMENT_IN FULL vec2 vertex_uv;
#ifndef UNLIT
FRAGMENT_IN HALF vec3 vertex_normal;
#endif
#ifdef NORMAL_MAP
FRAGMENT_IN HALF vec4 vertex_tangent;
#endif
#ifdef VERTEX_COLOR
FRAGMENT_IN HALF vec4 vertex_color;
#endif

// The CPU multiplies every light, the ambient and the emission by the exposure: no uniform and no operation for it here.
uniform HALF vec4 base_color;
uniform HALF vec4 emissive;  // rgb; w alpha cutoff
#ifdef BASE_COLOR_MAP
uniform HALF sampler2D base_color_map;
#endif
#ifdef EMISSIVE_MAP
uniform HALF sampler2D emissive_map;
#endif
#ifndef UNLIT
// x metallic, y roughness, z normal scale; without a map y is the smoothness and w the power, made on the CPU.
uniform HALF vec4 factors;
uniform HALF vec4 ambient;  // rgb
uniform HALF vec4 parallel_eye;  // orthographic: xyz direction to the eye, w 0; else 0, 0, 0, 1
#ifdef METALLIC_ROUGHNESS_MAP
uniform HALF sampler2D metallic_roughness_map;
#endif
#ifdef NORMAL_MAP
uniform HALF sampler2D normal_map;
#endif
#ifdef SUN
uniform HALF vec4 sun_direction;  // xyz unit, towards the sun
uniform HALF vec4 sun_color;      // rgb
#endif
#ifdef LOCAL_LIGHTS
#ifdef TIER_LOW
FRAGMENT_IN HALF vec3 vertex_light;
#else
uniform FULL vec4 light_position[LIGHT_SLOTS];   // FULL: metres; xyz from the eye, w = 1 / range^2
uniform HALF vec4 light_color[LIGHT_SLOTS];      // rgb, w = spot cos_scale (0: point)
uniform HALF vec4 light_direction[LIGHT_SLOTS];  // xyz unit, w = cos outer
uniform HALF vec4 light_count;                           // x
#ifdef AREA_LIGHTS
uniform FULL vec4 light_size[LIGHT_SLOTS];  // FULL: metres squared; x radius [m], y radius^2; 0: a point
#endif
#endif
#endif
#endif

//@insert_functions

//@not_run it reads a texture; what it computes is linear_from_srgb
vec3 color_texel(HALF sampler2D image) {
#ifdef TIER_LOW
    return linear_from_srgb(sample_2d(image, vertex_uv).rgb);  // ES 2.0 has no sRGB textures
#else
    return sample_2d(image, vertex_uv).rgb;
#endif
}

void main() {
    vec4 base = base_color;
#ifdef VERTEX_COLOR
    base *= vertex_color;
#endif
#ifdef BASE_COLOR_MAP
    base.rgb *= color_texel(base_color_map);
    base.a *= sample_2d(base_color_map, vertex_uv).a;
#endif
#ifdef ALPHA_MASK
    if (base.a < emissive.w) discard;
#endif
    vec3 emission = emissive.rgb;
#ifdef EMISSIVE_MAP
    emission *= color_texel(emissive_map);
#endif

#ifdef UNLIT
    vec3 light = base.rgb + emission;
#else
    float metallic = factors.x;
#ifdef METALLIC_ROUGHNESS_MAP
    vec2 packed_factors = sample_2d(metallic_roughness_map, vertex_uv).bg;
    metallic *= packed_factors.x;
    float power = power_from_roughness(factors.y * packed_factors.y);
    float smoothness = smoothness_from_power(power);
#else
    float power = factors.w;
    float smoothness = factors.y;
#endif
    vec3 albedo = base.rgb * (1.0 - metallic);
    vec3 specular = mix(vec3(SURFACE_DIELECTRIC_SPECULAR), base.rgb, metallic);

    // FULL: the highlight is the difference of n and h (see blinn_lobe).
    FULL vec3 n = normalize(vertex_normal);
#ifdef NORMAL_MAP
    FULL vec3 t = normalize(vertex_tangent.xyz - n * dot(n, vertex_tangent.xyz) + vec3(0.0, 0.0, 1e-4));
    FULL vec3 b = cross(n, t) * vertex_tangent.w;
    FULL vec3 bump = sample_2d(normal_map, vertex_uv).xyz * 2.0 - 1.0;
    bump.xy *= factors.z;
    n = normalize(t * bump.x + b * bump.y + n * max(bump.z, 0.01));
#endif
#ifdef DOUBLE_SIDED
    n = gl_FrontFacing ? n : -n;
#endif
    FULL vec3 v = normalize(vertex_to_eye * parallel_eye.w + parallel_eye.xyz);

    //@insert surface.material

    float n_dot_v = saturate(dot(n, v));
    vec3 diffuse_light = ambient.rgb;
    vec3 mirrored_light = ambient.rgb;
    //@insert surface.ambient
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
        FULL vec3 to_light = light_position[i].xyz + vertex_to_eye;
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
#ifdef SCENE_COLOR_PACKED
    color = packed_scene_color(min(color, vec3(SCENE_COLOR_RANGE)));
#endif
#ifdef ALPHA_BLEND
    fragment_color = vec4(color, saturate(base.a));
#else
    fragment_color = vec4(color, 1.0);
#endif
}
