// Vertex stage: texture coordinates made of the mesh's, uv' = (matrix) uv + offset (KHR_texture_transform). Here and not by
// fragment: the mapping is linear, so interpolating it is the same and costs nothing there.
//   UV_MAPPED      the coordinates are mapped; else they are the mesh's
//   UV_FROM_1      they are made of the mesh's second set
//   UV_B           some textures have other coordinates, always mapped; UV_B_FROM_1 as above
#include "common/vertex_decode.glsl"

VERTEX_IN vec2 uv;  // steps of uv_range
uniform highp vec4 uv_range;
#if defined(UV_FROM_1) || (defined(UV_B) && defined(UV_B_FROM_1))
VERTEX_IN vec2 uv1;  // steps of uv1_range
uniform highp vec4 uv1_range;
#endif
#ifdef UV_MAPPED
uniform highp vec4 uv_mapping[2];  // rows of the matrix; xy the offset
#endif
#ifdef UV_B
uniform highp vec4 uv_b_mapping[2];
#endif

//@stage vertex
//@domain at, rows, offset: -64..64
//@promise in -8256..8256; where rows == vec4(1.0, 0.0, 0.0, 1.0) && offset == vec2(0.0): result == at
vec2 mapped_uv(vec2 at, vec4 rows, vec2 offset) { return vec2(dot(rows.xy, at), dot(rows.zw, at)) + offset; }

//@stage vertex
//@variant TIER_CONSOLE UV_MAPPED UV_FROM_1
//@domain vec2 uv: 0..1; highp vec4 uv_range: -64..64; vec2 uv1: 0..1; highp vec4 uv1_range: -64..64; highp vec4 uv_mapping[2]: -8..8
//@promise in -2056..2056
vec2 first_uv() {
#ifdef UV_FROM_1
    vec2 at = uv_from_steps(uv1, uv1_range);
#else
    vec2 at = uv_from_steps(uv, uv_range);
#endif
#ifdef UV_MAPPED
    at = mapped_uv(at, uv_mapping[0], uv_mapping[1].xy);
#endif
    return at;
}

#ifdef UV_B
//@stage vertex
//@variant TIER_CONSOLE UV_B UV_B_FROM_1
//@domain vec2 uv: 0..1; highp vec4 uv_range: -64..64; vec2 uv1: 0..1; highp vec4 uv1_range: -64..64; highp vec4 uv_b_mapping[2]: -8..8
//@promise in -2056..2056
vec2 second_uv() {
#ifdef UV_B_FROM_1
    vec2 at = uv_from_steps(uv1, uv1_range);
#else
    vec2 at = uv_from_steps(uv, uv_range);
#endif
    return mapped_uv(at, uv_b_mapping[0], uv_b_mapping[1].xy);
}
#endif
