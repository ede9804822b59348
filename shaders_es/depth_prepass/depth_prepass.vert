// Depth alone, from the same expression as surface.vert so that both give the same depths.
VERTEX_IN vec3 position;  // local, as stored
uniform highp mat4 clip_from_local;

invariant gl_Position;

void main() { gl_Position = clip_from_local * vec4(position, 1.0); }
