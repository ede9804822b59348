// Fragment stage: what a material says about water at a place.
#ifdef WATER
#ifdef WATER_MAP
#ifdef WATER_UV_B
#define WATER_AT SECOND_UV
#else
#define WATER_AT vertex_uv
#endif
uniform HALF sampler2D water_map;  // r: share of the water that is taken up; g: height
#endif

// x how open to the rain, y how deep a hollow, z how high in the texture, 0..1 each.
//@not_run it reads a texture; what it computes is vertex_water
vec3 water_place() {
    vec3 place = vec3(1.0, 0.0, 1.0);
#if defined(WATER_VERTEX) && defined(VERTEX_COLOR)
    place.xy = vertex_water(vertex_color.a);
#endif
#ifdef WATER_MAP
    vec4 texel = sample_2d(water_map, WATER_AT);
    place.x *= texel.r;
    place.z = texel.g;
#endif
    return place;
}
#endif
