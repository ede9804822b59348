// The least that draws a mesh: places a vertex. Belongs to perf/peers, which times what no shading can go below.
#include "common/mesh_vertex.glsl"
#include "common/vertex_decode.glsl"

VERTEX_IN vec3 position;  // local, as stored
VERTEX_IN vec2 uv;        // steps of uv_range

uniform highp mat4 clip_from_local;
uniform highp vec4 uv_range;

VERTEX_OUT FULL vec2 vertex_uv;  // FULL: as in surface.vert, which it is compared with

void main() {
#ifdef SKINNED
    skin_vertex();
    highp vec3 place = skinned_position(position);
#else
    highp vec3 place = position;
#endif
    gl_Position = clip_from_local * vec4(place, 1.0);
    vertex_uv = uv_from_steps(uv, uv_range);
}
