// Depth alone, from the same expression as surface.vert so that both give the same depths.
#include "common/mesh_vertex.glsl"

VERTEX_IN vec3 position;  // local, as stored
uniform highp mat4 clip_from_local;

invariant gl_Position;

void main() {
#ifdef SKINNED
    skin_vertex();
    highp vec3 place = skinned_position(position);
#else
    highp vec3 place = position;
#endif
    gl_Position = clip_from_local * vec4(place, 1.0);
}
