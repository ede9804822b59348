// A reflection bent to the walls of a box, with the wall of each axis chosen by R > 0 ? max : min.
#include "common/maths.glsl"

// Where a component of R is exactly +0 the wall behind is chosen, and -inf wins the min().
//@domain r: unit; place: -0.9..0.9
//@promise in -16..16
vec3 box_as_printed(FULL vec3 r, vec3 place) {
    HALF vec3 half_r = r;
    vec3 to_high = (vec3(1.0) - place) / half_r;
    vec3 to_low = (vec3(-1.0) - place) / half_r;
    vec3 far = vec3(half_r.x > 0.0 ? to_high.x : to_low.x, half_r.y > 0.0 ? to_high.y : to_low.y,
                    half_r.z > 0.0 ? to_high.z : to_low.z);
    return place + half_r * min(min(far.x, far.y), far.z);
}

// No component is nearer to 0 than 2^-9: at most a wall of 1000 box sides away, which never is the nearest.
//@domain r: unit; place: -0.9..0.9
//@promise in -1.02..1.02
vec3 box_guarded(FULL vec3 r, vec3 place) {
    FULL vec3 side = vec3(r.x < 0.0 ? -1.0 : 1.0, r.y < 0.0 ? -1.0 : 1.0, r.z < 0.0 ? -1.0 : 1.0);
    FULL vec3 guarded = side * max(abs(r), vec3(0.002));
    FULL vec3 far = (side - place) / guarded;
    return place + guarded * min(min(far.x, far.y), far.z);
}

FULL vec3 looked_along(FULL vec2 at) {
    // The middle column and the middle row look along an axis to the bit.
    FULL vec2 turned = floor(at * 33.0) / 16.0 - 1.0;
    return normalize(vec3(turned, 0.5));
}
vec3 picture_printed(FULL vec2 at) { return box_as_printed(looked_along(at), vec3(0.3, -0.2, 0.0)) * 0.5 + 0.5; }
vec3 picture_mended(FULL vec2 at) { return box_guarded(looked_along(at), vec3(0.3, -0.2, 0.0)) * 0.5 + 0.5; }
