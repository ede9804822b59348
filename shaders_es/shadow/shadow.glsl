// Plain functions of the shadow: they sample nothing, so tests can call each one alone.
#include "common/maths.glsl"

// How far a point moves off its surface before it is looked up [m], along the normal n: with `reach_m`, the radius of the
// filter in metres, a plane never shadows itself whatever its slope (its depth over the filter changes by
// reach * tan(angle); the step gains reach * sin(angle) / cos(angle)). FULL: metres, and 1 - cosine^2 near 0.
//@domain n, toward_sun: unit; reach_m: 0..1000
//@promise in -1000..1000; where reach_m == 0.0: length(result) == 0.0; within(shadow_lift(n.yzx, toward_sun.yzx, reach_m), result.yzx, 2.0 * slack)
FULL vec3 shadow_lift(FULL vec3 n, FULL vec3 toward_sun, FULL float reach_m) {
    FULL vec3 sine = cross(n, toward_sun);  // not the root of 1 - cosine^2, which cancels where the light is straight above
    return n * (reach_m * length(sine));
}

// Share of the sun's light that four comparisons let through, each 0..1.
//@domain lit: 0..1
//@promise in 0..1; rising lit
float lit_share(vec4 lit) { return dot(lit, vec4(1.0)) * 0.25; }  // quartered last: a quarter below 2^-14 may be 0

// What the ground under a dynamic object keeps of its colour: 1 - strength in the middle, 1 from one radius on, smooth at
// both. `from_centre` in radii; strength 0..1.
//@domain from_centre: -1..1; strength: 0..1
//@promise in 0..1; falling strength; where strength == 0.0: result == 1.0; where dot(from_centre, from_centre) >= 1.0: result == 1.0
float blob_shade(vec2 from_centre, float strength) {
    float inside = saturate(1.0 - dot(from_centre, from_centre));
    return 1.0 - strength * inside * inside;
}
