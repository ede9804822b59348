// Plain functions of the shadow: they sample nothing, so tests can call each one alone.
#include "common/maths.glsl"

// How far a point moves off its surface before it is looked up [m], along the normal n: with `reach_m`, the radius of the
// filter in metres, a plane never shadows itself whatever its slope (its depth over the filter changes by
// reach * tan(angle); the step gains reach * sin(angle) / cos(angle)). FULL: metres, and 1 - cosine^2 near 0.
FULL vec3 shadow_lift(FULL vec3 n, FULL vec3 toward_sun, FULL float reach_m) {
    FULL float cosine = dot(n, toward_sun);
    return n * (reach_m * sqrt(max(1.0 - cosine * cosine, 0.0)));
}

// Share of the sun's light that four comparisons let through, each 0..1.
float lit_share(vec4 lit) { return dot(lit, vec4(0.25)); }

// What the ground under a dynamic object keeps of its colour: 1 - strength in the middle, 1 from one radius on, smooth at
// both. `from_centre` in radii; strength 0..1.
float blob_shade(vec2 from_centre, float strength) {
    float inside = saturate(1.0 - dot(from_centre, from_centre));
    return 1.0 - strength * inside * inside;
}
