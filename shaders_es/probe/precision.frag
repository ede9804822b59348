// Shows what this arithmetic really is, as colours that an 8-bit target carries. Two chained operations each: a single
// mediump operation between 32-bit values may be run in 32 bits.
uniform HALF vec4 small;  // 2^-12, 2^-14 (smallest normal half), 2^-5, 2^10
uniform HALF vec4 large;  // 300, 0.001, 1, 0

void main() {
    // 90 in single precision; 300*300 is above 65504, so inf in half, or 65.5 where it clamps.
    HALF float overflow = (large.x * large.x) * large.y;
    // 2^-11 in single precision; both steps are half a step of half at 1, and are lost.
    HALF float step_left = ((large.z + small.x) + small.x) - large.z;
    // 2^-9, or 0 where the half subnormal 2^-19 in between is flushed.
    HALF float subnormal = (small.y * small.z) * small.w;
    fragment_color = vec4(overflow > 100.0 ? 1.0 : (overflow < 80.0 ? 0.5 : 0.0),
                          step_left == 0.0 ? 1.0 : 0.0,
                          subnormal > 0.0 ? 1.0 : 0.0,
                          1.0);
}
