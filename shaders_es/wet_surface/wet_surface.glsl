// What water does to a material: the talk's ProcessWetSurfaces in three steps. Every lerp is written as a sum, so that a
// wetness of 0 changes no bit.
#include "common/maths.glsl"

// Share of a material that takes up water: rough dielectrics do, metals and smooth ones do not. The talk tells metals by
// saturate(1000 * specular - 500), a step 0.001 wide; half steps by 0.25 at 500. This one is smoothstep over 0.4..0.6, counted
// from its metallic end, where it is small and half has its finest steps.
//@domain specular, smoothness: 0..1
//@exempt half, half_flushed, es_minimum: within 0.0015; a mean of three is off by 2^-12, times 5 for the ramp; 0.3 codes of albedo
//@promise in 0..1; falling smoothness; where smoothness >= 0.5: result == 0.0
//@promise where min(min(specular.r, specular.g), specular.b) > 0.61: result == 0.0
//@promise where max(max(specular.r, specular.g), specular.b) < 0.39 && smoothness < 0.099: result == 1.0
float porosity(vec3 specular, float smoothness) {
    float t = saturate((0.6 - dot(specular, vec3(0.3333))) * 5.0);
    return t * t * (3.0 - 2.0 * t) * saturate((0.5 - smoothness) * 2.5);
}

// A porous albedo falls to a fifth: light that enters the water film is thrown back into the pores.
//@domain albedo, pores, wetness: 0..1
//@promise in 0..1; falling wetness; falling pores; where wetness == 0.0: result == albedo; where pores == 0.0: result == albedo
vec3 wet_albedo(vec3 albedo, float pores, float wetness) { return albedo * (1.0 - 0.8 * (pores * wetness)); }

// Water fills the roughness: two fifths of the way to a mirror where all is porous; 0.5 of the 0.8 is empirical (the talk).
//@domain smoothness, pores, wetness: 0..1
//@exempt half_flushed, es_minimum: within 0.0002; what is added is 0 below 2^-14: a 20th of a step of 8 bits
//@promise in 0..1; rising wetness; rising pores; where wetness == 0.0: result == smoothness; where pores == 0.0: result == smoothness
float wet_smoothness(float smoothness, float pores, float wetness) {
    return smoothness + (1.0 - smoothness) * (0.4 * (pores * wetness));
}

// Power of the lobe of a surface that has become smoother by `gain`: it grows by 2^10 over the whole range.
//@domain power: 2..2048; gain: 0..1; where power * exp2(10.0 * gain) < 2060.0
//@promise in 2..2048; rising gain; where gain == 0.0: result == power
float smoother_power(float power, float gain) { return min(power * exp2(10.0 * gain), 2048.0); }
