// One triangle over the whole target.
VERTEX_IN vec2 position;  // clip
VERTEX_OUT FULL vec2 vertex_at;  // FULL: no two pixels may be alike

void main() {
    vertex_at = position;
    gl_Position = vec4(position, 0.0, 1.0);
}
