// One triangle over the target.
VERTEX_IN vec2 position;  // clip

void main() {
    gl_Position = vec4(position, 0.0, 1.0);
}
