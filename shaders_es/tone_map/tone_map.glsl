// The talk's tone curve and its inverse: y = 1.0275 x / (x + 0.22), so that a light of 8 gives exactly 1. The result is
// already in display (gamma) space. S. Lagarde and L. Harduin, GDC Europe 2013, "LDR sky".
#include "tone_map/tone_map_limits.h"

// light >= 0, any size: above 8 it is 8 (white). Clamping first keeps half from inf / inf. Multiplied last: a product just
// under the divisor and the divisor would each lose up to a step of a result just under 1, the quotient here half of one.
//@domain light: 0..65504
//@promise in 0..1; rising light; where light == vec3(8.0): within(result, vec3(1.0), slack)
vec3 tone_map(vec3 light) {
    vec3 x = min(light, vec3(TONE_MAP_RANGE));
    return x / (x + TONE_MAP_A) * TONE_MAP_B;
}

// display 0..1 to light 0..8. The slope reaches 299 at 1, so one 8-bit step at the top is one whole unit of light.
// 1.0275 - y loses bits in half; 0.0275 + (1 - y) is exact there, and max() keeps compilers from folding it back.
//@domain display: 0..1
//@promise in 0..8; rising display; within(tone_map(result), display, 1.0 / 255.0)
vec3 inverse_tone_map(vec3 display) {
    vec3 y = clamp(display, 0.0, 1.0);
    return TONE_MAP_A * y / (0.0275 + max(1.0 - y, 0.0));
}
