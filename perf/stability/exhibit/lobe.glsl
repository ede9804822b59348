// A highlight from a cosine: pow(dot(n, h), power), every value in half.
#include "common/maths.glsl"
#include "surface/surface_limits.h"
#include "surface/surface.glsl"

// Half has three numbers between the cosines 1 and 0.9985, where a power of 2048 falls from 1 to 0.05.
//@domain n, h: unit; power: 2..2048
//@promise in 0..1.001; where n == h: within(result, 1.0, 0.01)
float lobe_as_printed(FULL vec3 n, FULL vec3 h, float power) {
    HALF vec3 half_n = n;
    HALF vec3 half_h = h;
    HALF float cosine = max(dot(half_n, half_h), 0.0);
    return pow(cosine, power);
}

FULL vec3 ball_normal(FULL vec2 at) {
    FULL vec2 disc = 0.15 * (at - 0.5) + vec2(0.30, 0.20);  // a closer look at where the highlight is
    return vec3(disc, sqrt(max(1.0 - dot(disc, disc), 0.0)));
}

vec3 picture_printed(FULL vec2 at) { return vec3(lobe_as_printed(ball_normal(at), ball_normal(vec2(0.5)), 1024.0)); }
vec3 picture_mended(FULL vec2 at) { return vec3(blinn_lobe(ball_normal(at), ball_normal(vec2(0.5)), 1024.0)); }
