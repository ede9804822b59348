// One triangle over the whole target.
VERTEX_IN vec2 position;  // clip
VERTEX_OUT FULL vec2 vertex_uv;  // FULL: 1280 pixels are past half's 11 bits

void main() {
    vertex_uv = position * 0.5 + 0.5;
    gl_Position = vec4(position, 0.0, 1.0);
}
