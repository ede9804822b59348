// Draws a caster into the sun's map.
#include "common/mesh_vertex.glsl"
#include "common/vertex_decode.glsl"

VERTEX_IN vec3 position;  // local, as stored
uniform highp mat4 clip_from_local;
#ifdef ALPHA_MASK
#ifdef BASE_COLOR_MAP
#include "common/uv_mapping.glsl"
VERTEX_OUT FULL vec2 vertex_uv;  // FULL: as in surface.vert
#endif
#ifdef VERTEX_COLOR
VERTEX_IN vec4 color;
VERTEX_OUT HALF float vertex_alpha;
#endif
#endif

void main() {
#ifdef SKINNED
    skin_vertex();
    highp vec3 place = skinned_position(position);
#else
    highp vec3 place = position;
#endif
    gl_Position = clip_from_local * vec4(place, 1.0);
#ifdef ALPHA_MASK
#ifdef BASE_COLOR_MAP
    vertex_uv = first_uv();
#endif
#ifdef VERTEX_COLOR
    vertex_alpha = color.a;
#endif
#endif
}
