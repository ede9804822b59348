// The distance of a lamp as length(to_light) in half: beyond 255 its square is past 65504.
#include "common/maths.glsl"
#include "surface/surface_limits.h"
#include "surface/surface.glsl"

//@domain to_light: -1000..1000
//@promise in 0..1733
float distance_as_printed(FULL vec3 to_light) {
    HALF vec3 half_to_light = to_light;
    HALF float far = length(half_to_light);
    return far;
}

// Shown: distance over 600, dark where it is infinite, and the falloff of a lamp that reaches 600.
vec3 picture_printed(FULL vec2 at) {
    float far = distance_as_printed(vec3(800.0 * at.x - 400.0, 30.0, 400.0 * at.y));
    return far <= 65504.0 ? vec3(1.0 - far / 600.0) : vec3(0.0);
}
vec3 picture_mended(FULL vec2 at) {
    FULL vec3 to_light = vec3(800.0 * at.x - 400.0, 30.0, 400.0 * at.y);
    FULL float far = sqrt(dot(to_light, to_light));
    return vec3(1.0 - far / 600.0);
}
