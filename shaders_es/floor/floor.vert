// The least that draws a mesh: places a vertex. Belongs to perf/peers, which times what no shading can go below.
#include "common/vertex_decode.glsl"

VERTEX_IN vec3 position;  // local, as stored
VERTEX_IN vec2 uv;        // steps of uv_range

uniform highp mat4 clip_from_local;
uniform highp vec4 uv_range;

VERTEX_OUT FULL vec2 vertex_uv;

void main() {
    gl_Position = clip_from_local * vec4(position, 1.0);
    vertex_uv = uv_from_steps(uv, uv_range);
}
