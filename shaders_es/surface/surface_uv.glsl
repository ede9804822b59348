// Fragment stage: which coordinates each texture is read at. One mapping for all textures of a material is made by the vertex
// stage and nothing is left here; a texture with NAME_UV_B has the second one (common/uv_mapping.glsl).
FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: a 2048-texel repeat is past half's 11 bits
#ifdef UV_B
FRAGMENT_IN FULL vec2 vertex_uv_b;  // FULL: as vertex_uv
#define SECOND_UV vertex_uv_b
#else
#define SECOND_UV vertex_uv
#endif

#ifdef BASE_COLOR_UV_B
#define BASE_COLOR_AT SECOND_UV
#else
#define BASE_COLOR_AT vertex_uv
#endif
#ifdef ROUGHNESS_UV_B
#define ROUGHNESS_AT SECOND_UV
#else
#define ROUGHNESS_AT vertex_uv
#endif
#ifdef NORMAL_UV_B
#define NORMAL_AT SECOND_UV
#else
#define NORMAL_AT vertex_uv
#endif
#ifdef EMISSIVE_UV_B
#define EMISSIVE_AT SECOND_UV
#else
#define EMISSIVE_AT vertex_uv
#endif
#ifdef OCCLUSION_UV_B
#define OCCLUSION_AT SECOND_UV
#else
#define OCCLUSION_AT vertex_uv
#endif
#ifdef SPECULAR_UV_B
#define SPECULAR_AT SECOND_UV
#else
#define SPECULAR_AT vertex_uv
#endif
#ifdef SPECULAR_COLOR_UV_B
#define SPECULAR_COLOR_AT SECOND_UV
#else
#define SPECULAR_COLOR_AT vertex_uv
#endif
