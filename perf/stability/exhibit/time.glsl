// A texture that scrolls with a clock in half: after a minute it moves in steps, after an hour by whole turns.
#include "common/maths.glsl"

//@domain time_s: 0..86400; rate: 0.01..1
//@promise in 0..1
//@jumps floor(time_s * rate)
float scrolled_as_printed(FULL float time_s, FULL float rate) {
    HALF float half_time = time_s;
    HALF float half_rate = rate;
    return fract(half_time * half_rate);
}

// The same turn, taken before it becomes half: what is left is 0..1.
//@domain time_s: 0..86400; rate: 0.01..1
//@promise in 0..1
//@jumps floor(time_s * rate)
float scrolled(FULL float time_s, FULL float rate) {
    FULL float turns = time_s * rate;
    return turns - floor(turns);
}

// Time goes to the right: a quarter of a minute, beginning after an hour. Stripes should slant evenly.
float stripe(float turn, FULL vec2 at) { return fract(4.0 * at.y + turn) < 0.5 ? 1.0 : 0.1; }
vec3 picture_printed(FULL vec2 at) { return vec3(stripe(scrolled_as_printed(3600.0 + 16.0 * at.x, 0.25), at)); }
vec3 picture_mended(FULL vec2 at) { return vec3(stripe(scrolled(3600.0 + 16.0 * at.x, 0.25), at)); }
