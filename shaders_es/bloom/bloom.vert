// One triangle over the whole target.
VERTEX_IN vec2 position;       // clip
uniform highp vec4 uv_scale;   // xy: a target of whole blocks may reach past the picture it is made from
VERTEX_OUT FULL vec2 vertex_uv;  // FULL: a texel of 1280 pixels is past half's 11 bits

void main() {
    vertex_uv = (position * 0.5 + 0.5) * uv_scale.xy;
    gl_Position = vec4(position, 0.0, 1.0);
}
