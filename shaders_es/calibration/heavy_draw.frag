// Known, heavy work: a timing method that does not see it measures something else.
FRAGMENT_IN FULL vec2 vertex_at;  // FULL: no two pixels may be alike
uniform HALF vec4 seed;  // from outside, so that no compiler can work it out beforehand

void main() {
    float x = vertex_at.x + seed.x;
    for (int i = 0; i < 200; i++) {
        x = fract(x * 1.5 + vertex_at.y) + seed.y;
    }
    fragment_color = vec4(x);
}
