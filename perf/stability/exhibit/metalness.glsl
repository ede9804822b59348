// Metal or not, from the brightness of specular: saturate(1000 x - 500). Half's numbers near 500 are 0.25 apart.
#include "common/maths.glsl"

//@domain specular: 0..1
//@promise in 0..1; error 0.05
float metalness_as_printed(vec3 specular) { return saturate(dot(specular, vec3(0.33)) * 1000.0 - 500.0); }

// A ramp that half can walk: 0.2 wide, 400 steps. FULL: five times the rounding of a sum of three shows.
//@domain specular: 0..1
//@promise in 0..1; error 0.05
float metalness_ramp(vec3 specular) {
    FULL vec3 from = specular;
    FULL float t = clamp((dot(from, vec3(0.33)) - 0.4) * 5.0, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Each ramp from its black end to its white one.
vec3 grey(FULL float brightness) { return vec3(brightness / 0.99); }
vec3 picture_printed(FULL vec2 at) { return vec3(metalness_as_printed(grey(0.5 + 0.001 * at.x))); }
vec3 picture_mended(FULL vec2 at) { return vec3(metalness_ramp(grey(0.4 + 0.2 * at.x))); }
