// A direction guarded with 1e-6, which half cannot hold where subnormals are flushed, and hardly where they are kept.
#include "common/maths.glsl"

//@domain v: -1..1
//@promise in -1.001..1.001
vec3 direction_as_printed(vec3 v) { return v / max(length(v), 1e-6); }

// 6.2e-5 is just above half's smallest normal number, 2^-14; shorter than its root, a vector has no direction and fades.
// The square is taken in highp: half loses it below 0.008.
//@domain v: -1..1
//@promise in -1.001..1.001; where v == vec3(0.0): result == vec3(0.0)
vec3 direction_guarded(vec3 v) {
    FULL vec3 full = v;
    return full * inversesqrt(max(dot(full, full), 6.2e-5));
}

vec3 picture_printed(FULL vec2 at) { return direction_as_printed(vec3((at - 0.5) * 0.002, 0.0)) * 0.5 + 0.5; }
vec3 picture_mended(FULL vec2 at) { return direction_guarded(vec3((at - 0.5) * 0.002, 0.0)) * 0.5 + 0.5; }
