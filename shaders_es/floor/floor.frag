// One colour, plus every texture of the material that a define names: what the fetches cost when nothing is lit.
FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: as in surface.vert, which it is compared with
FRAGMENT_UNIFORM HALF vec4 base_color;
#ifdef BASE_COLOR_MAP
uniform HALF sampler2D base_color_map;
#endif
#ifdef METALLIC_ROUGHNESS_MAP
uniform HALF sampler2D metallic_roughness_map;
#endif
#ifdef NORMAL_MAP
uniform HALF sampler2D normal_map;
#endif
#ifdef EMISSIVE_MAP
uniform HALF sampler2D emissive_map;
#endif

void main() {
    vec4 sum = base_color;
#ifdef BASE_COLOR_MAP
    sum += sample_2d(base_color_map, vertex_uv);
#endif
#ifdef METALLIC_ROUGHNESS_MAP
    sum += sample_2d(metallic_roughness_map, vertex_uv);
#endif
#ifdef NORMAL_MAP
    sum += sample_2d(normal_map, vertex_uv);
#endif
#ifdef EMISSIVE_MAP
    sum += sample_2d(emissive_map, vertex_uv);
#endif
    fragment_color = vec4(sum.rgb * 0.2, 1.0);  // five summands: the picture stays readable
}
