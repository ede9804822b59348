// Fragment stage: the textures of a surface, and how a colour is read from one.
#include "common/colour.glsl"
#include "surface/surface_uv.glsl"

#ifdef BASE_COLOR_MAP
uniform HALF sampler2D base_color_map;
#endif
#ifdef EMISSIVE_MAP
uniform HALF sampler2D emissive_map;
#endif
#ifdef SPECULAR_GLOSSINESS
#undef METALLIC_ROUGHNESS_MAP
#undef OWN_SPECULAR
#ifdef SPECULAR_GLOSSINESS_MAP
uniform HALF sampler2D specular_glossiness_map;
#endif
#endif
#ifdef METALLIC_ROUGHNESS_MAP
uniform HALF sampler2D metallic_roughness_map;
#endif
#ifdef OWN_SPECULAR
#ifdef SPECULAR_COLOR_MAP
uniform HALF sampler2D specular_color_map;
#endif
#if defined(SPECULAR_MAP) && !defined(TIER_LOW)
uniform HALF sampler2D specular_map;  // not at low: with it a surface would need nine textures
#endif
#endif
#ifdef OCCLUSION_MAP
uniform HALF sampler2D occlusion_map;
#endif
#ifdef NORMAL_MAP
uniform HALF sampler2D normal_map;
#endif

// FULL: a uv.
//@variant TIER_LOW
//@variant TIER_CONSOLE
//@domain image: 0..1; at: 0..1
//@promise in 0..1
//@jumps step(0.5, at.x)
vec3 color_texel(HALF sampler2D image, FULL vec2 at) {
#ifdef TIER_LOW
    return linear_from_srgb(sample_2d(image, at).rgb);  // ES 2.0 has no sRGB textures
#else
    return sample_2d(image, at).rgb;
#endif
}

#if defined(DISPLAY_COLOR) && defined(TIER_LOW)
// An unlit colour is a display value from the start: the CPU encodes the factor, the texture is read as it is, and only what
// vertices carry is encoded here. The product of encoded values stands for the encoded product: 4 codes too bright at worst.
#define vertex_factor vec4(srgb_from_linear(vertex_color.rgb), vertex_color.a)
#define base_texel(image, at) sample_2d(image, at).rgb
#else
#define vertex_factor vertex_color
#define base_texel(image, at) color_texel(image, at)
#endif
