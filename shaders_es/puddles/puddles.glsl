// Water that stands on a surface: how much of it, and what it looks like. A share of 0 changes no bit of a material.
#include "common/maths.glsl"

// Share of open water. `hollow` is how deep the ground lies there, `height` how high the texel in its texture, `level` how
// far all is filled, 0..1 each; `up` is the cosine of the ground's slope. A hollow fills from its deepest place, over 0.4 of
// its depth; cracks of the texture fill to the level; nothing stands on slopes above 25 degrees, everything below 10.
// S. Lagarde, Water drop 3b, 2013; slope after J. Lux.
//@domain hollow, height, level: 0..1; up: -1..1
//@promise in 0..1; rising hollow; rising level; falling height; where level == 0.0: result == 0.0; where up <= 0.9: result == 0.0
float puddle_share(float hollow, float height, float level, float up) {
    float deep = saturate((hollow - (1.0 - level)) * 2.5);
    float cracks = min(level, 1.0 - height);
    return max(deep, cracks) * saturate((up - 0.906) * 12.7);
}

// Water reflects 2 % where it is looked at straight.
//@domain specular, share: 0..1
//@exempt half_flushed, es_minimum: within 0.0002; what is added is 0 below 2^-14: a 20th of a step of 8 bits
//@promise in 0..1; where share == 0.0: result == specular
vec3 water_specular(vec3 specular, float share) { return specular + (0.02 - specular) * share; }

// Standing water is a mirror.
//@domain smoothness, share: 0..1
//@exempt half_flushed, es_minimum: within 0.0002; what is added is 0 below 2^-14: a 20th of a step of 8 bits
//@promise in 0..1; rising share; where share == 0.0: result == smoothness
float water_smoothness(float smoothness, float share) { return smoothness + (1.0 - smoothness) * share; }

// The ground's normal under the water's. Water stands where the ground is level: they never oppose each other. FULL: as normals
//@domain ground, water: unit; share: 0..1; where dot(ground, water) > -0.5
//@promise in -1.001..1.001
FULL vec3 over_water(FULL vec3 ground, FULL vec3 water, float share) {
    FULL vec3 between = ground + (water - ground) * share;
    return between * inversesqrt(dot(between, between));
}
