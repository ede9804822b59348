// One triangle at the far plane: only pixels that no surface covers are shaded.
VERTEX_IN vec2 position;  // clip
uniform highp vec4 ray_right;    // xyz: world direction that one unit of clip x adds
uniform highp vec4 ray_up;       // xyz: the same for clip y
uniform highp vec4 ray_forward;  // xyz: world direction at the centre of the picture
VERTEX_OUT HALF vec3 vertex_ray;

void main() {
    vertex_ray = ray_forward.xyz + ray_right.xyz * position.x + ray_up.xyz * position.y;
    gl_Position = vec4(position, 1.0, 1.0);
}
