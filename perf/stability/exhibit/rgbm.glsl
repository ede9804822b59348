// RGBM with a guard of 1e-6 against black (B. Karis, "RGBM color encoding", 2009): 0 / 0 where 1e-6 is 0.
#include "common/maths.glsl"

//@domain color: 0..1
//@promise in 0..1
//@jumps ceil(max(max(color.r, color.g), color.b) * 255.0)
vec4 rgbm_as_printed(vec3 color) {
    float range = clamp(max(max(color.r, color.g), max(color.b, 1e-6)), 0.0, 1.0);
    range = ceil(range * 255.0) / 255.0;
    return vec4(color / range, range);
}

// As content/environment packs it on the CPU: black has the least range that eight bits hold, never 0.
//@domain color: 0..1
//@promise in 0..1.001; where color == vec3(0.0): result.rgb == vec3(0.0)
//@jumps ceil(max(max(color.r, color.g), color.b) * 255.0)
vec4 rgbm_guarded(vec3 color) {
    float range = max(ceil(max(max(color.r, color.g), color.b) * 255.0), 1.0) / 255.0;
    return vec4(min(color / range, vec3(1.0)), range);
}

// Read back as a reflection and added to the light of a wall: where the reflection is black, at the left, the wall is lost.
vec3 picture_printed(FULL vec2 at) {
    vec4 stored = rgbm_as_printed(vec3(max(at.x - 0.3, 0.0)));
    return 0.25 + stored.rgb * stored.a;
}
vec3 picture_mended(FULL vec2 at) {
    vec4 stored = rgbm_guarded(vec3(max(at.x - 0.3, 0.0)));
    return 0.25 + stored.rgb * stored.a;
}
