// Light from a prefiltered environment: S. Lagarde and L. Harduin, GDC Europe 2013, image based lighting. Plain functions
// of values: they sample nothing, so tests can call each one alone.
#include "environment/environment_limits.h"

// What a white Lambert surface of normal n shows: nine spherical harmonics as polynomials of n, constants folded in on the
// CPU (R. Ramamoorthi and P. Hanrahan, SIGGRAPH 2001). The CPU has windowed them; the comparison with 0 is for what rounding
// leaves where they only just touch it. FULL: terms cancel there, and in half each keeps a rounding of the largest.
//@domain n: unit; c0, c1, c2, c3, c4, c5, c6, c7, c8: -64..64
//@promise in 0..65504
vec3 irradiance(FULL vec3 n, vec3 c0, vec3 c1, vec3 c2, vec3 c3, vec3 c4, vec3 c5, vec3 c6, vec3 c7, vec3 c8) {
    FULL vec3 sum = c0 + c1 * n.y + c2 * n.z + c3 * n.x;
    sum += c4 * (n.x * n.y) + c5 * (n.y * n.z) + c6 * (3.0 * n.z * n.z - 1.0);
    sum += c7 * (n.x * n.z) + c8 * (n.x * n.x - n.y * n.y);
    return max(sum, vec3(0.0));
}

// What bands 3 and 4 add about one axis, as Legendre's polynomials of the cosine with it. FULL: as above.
//@domain along: -1..1; third, fourth: -64..64
//@promise in -128.5..128.5
vec3 bands_about_axis(FULL float along, vec3 third, vec3 fourth) {
    FULL float square = along * along;
    return third * (along * (2.5 * square - 1.5)) + fourth * (square * (4.375 * square - 3.75) + 0.375);
}

// Which level to read for a smoothness 0..1; roughest is the level of smoothness 0. Powers grow by a factor of 5.6 from one
// level to the next and a blend of two lobes is no lobe of a power between: bending the fraction evens out what is too
// bright in the blend's peak and too dark on its flanks (`halfframe accuracy environment`, "between levels").
//@domain smoothness: 0..1; roughest: 0..8; where roughest == floor(roughest)
//@promise in 0..8.25; falling smoothness; where smoothness == 1.0: result == 0.0
float reflection_level(float smoothness, float roughest) {
    float level = (1.0 - smoothness) * roughest;
    float part = fract(level);
    return level + 0.4 * part * (1.0 - part);
}

// RGBM8 holds the root of the light, rgb = root / (alpha root_range): the square spends the eight bits as the eye does, and
// black is alpha = 1/255, never 0. root_range: square root of the largest light, exposure included.
//@domain stored: 0..1; root_range: 0..128
//@promise in 0..16384; rising root_range; where stored.a == 0.0: result == vec3(0.0)
vec3 unpacked_rgbm(vec4 stored, float root_range) {
    vec3 root = stored.rgb * (stored.a * root_range);
    return root * root;
}

// Low tier: what lies between the diffuse light and two cubes of smoothness ENVIRONMENT_ROUGH and ENVIRONMENT_SHARP. Not
// mix(), which is a + s (b - a): in half, 256 beside a dark 0.016 left nothing of the dark one. The
// max() keeps compilers from making a mix() of it. FULL: 1 / 0.35 in half moves the kink by 2^-11.
//@domain diffuse, rough, sharp: 0..1024; smoothness: 0..1
//@promise in 0..1024; where smoothness == 0.0: result == diffuse; where smoothness == 1.0: within(result, sharp, slack)
vec3 mixed_reflection(vec3 diffuse, vec3 rough, vec3 sharp, FULL float smoothness) {
    FULL float r = clamp(smoothness * (1.0 / ENVIRONMENT_ROUGH), 0.0, 1.0);
    FULL float s = clamp((smoothness - ENVIRONMENT_ROUGH) * (1.0 / (ENVIRONMENT_SHARP - ENVIRONMENT_ROUGH)), 0.0, 1.0);
    return (diffuse * max(1.0 - r, 0.0) + rough * r) * max(1.0 - s, 0.0) + sharp * s;
}
