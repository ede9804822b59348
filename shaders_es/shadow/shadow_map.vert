// Draws a caster into the sun's map.
#include "common/vertex_decode.glsl"

VERTEX_IN vec3 position;  // local, as stored
uniform highp mat4 clip_from_local;
#ifdef ALPHA_MASK
#ifdef BASE_COLOR_MAP
VERTEX_IN vec2 uv;  // steps of uv_range
uniform highp vec4 uv_range;
VERTEX_OUT FULL vec2 vertex_uv;  // FULL: as in surface.vert
#endif
#ifdef VERTEX_COLOR
VERTEX_IN vec4 color;
VERTEX_OUT HALF float vertex_alpha;
#endif
#endif

void main() {
    gl_Position = clip_from_local * vec4(position, 1.0);
#ifdef ALPHA_MASK
#ifdef BASE_COLOR_MAP
    vertex_uv = uv_from_steps(uv, uv_range);
#endif
#ifdef VERTEX_COLOR
    vertex_alpha = color.a;
#endif
#endif
}
