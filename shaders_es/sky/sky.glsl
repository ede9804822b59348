// A vertical gradient of display values, and what the talk does with an LDR sky: it goes back through the tone curve, so
// that it reads the same after the frame's own tone map.

// height: sine of the elevation, -1..1. Each colour is a display value 0..1. FULL: 1 - up^3 has steps of 2^-11 in half.
//@domain height: -1..1; zenith, horizon, ground: 0..1
//@exempt half_flushed, es_minimum: within (1.0 + exp2(-8.0)) * exp2(-14.0); a mean just above 2^-14 of colours just below is 0
//@promise in 0..1; where zenith == horizon && height >= 0.0: result == zenith
vec3 sky_gradient(FULL float height, vec3 zenith, vec3 horizon, vec3 ground) {
    FULL float up = 1.0 - clamp(height, 0.0, 1.0);
    FULL float above = 1.0 - up * up * up;                // most of the change near the horizon
    FULL float below = clamp(-height * 8.0, 0.0, 1.0);    // the ground colour from 7 degrees under the horizon
    return mix(mix(horizon, zenith, above), ground, below * below * (3.0 - 2.0 * below));
}
