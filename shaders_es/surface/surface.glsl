// The talk's direct light (T1): Lambert plus Blinn microfacets with energy conservation, N. Hoffman, "Crafting Physically
// Motivated Shading Models for Game Development", SIGGRAPH 2010, as used by S. Lagarde and L. Harduin, GDC Europe 2013.
// Plain functions of values: they sample nothing, so tests can call each one alone.

// Fresnel reflectance (Schlick 1994). specular 0..1, l_dot_h 0..1. FULL: 1 - l.h cancels near 1.
//@domain specular, l_dot_h: 0..1
//@exempt half_flushed, es_minimum: within exp2(-14.0); the fifth power, or what it is multiplied with, is 0 below 2^-14
//@promise in 0..1; falling l_dot_h; where l_dot_h == 1.0: result == specular; where l_dot_h == 0.0: within(result, vec3(1.0), slack)
vec3 fresnel_schlick(vec3 specular, FULL float l_dot_h) {
    float share = pow5(clamp(1.0 - l_dot_h, 0.0, 1.0));
    return specular + (1.0 - specular) * share;
}

// Fresnel of a prefiltered environment: rough surfaces brighten less at grazing angles (the talk, "Glossy Fresnel").
// FULL: as fresnel_schlick.
//@domain specular, smoothness, n_dot_v: 0..1
//@exempt half_flushed, es_minimum: within exp2(-14.0); the fifth power, or what it is multiplied with, is 0 below 2^-14
//@promise in 0..1; falling n_dot_v; where n_dot_v == 1.0: result == specular
vec3 fresnel_glossy(vec3 specular, float smoothness, FULL float n_dot_v) {
    float share = pow5(clamp(1.0 - n_dot_v, 0.0, 1.0));
    return specular + (max(vec3(smoothness), specular) - specular) * share;
}

// Blinn power from glTF's perceptual roughness 0..1: 2 / alpha^2 - 2 with alpha = roughness^2 gives the lobe the width of
// GGX's at its peak (B. Karis, SIGGRAPH 2013). The max() is the 2048 end of the talk's range: roughness below 0.177 looks
// the same, and the division can never overflow half.
//@domain roughness: 0..1
//@promise in 2..2048; falling roughness
float power_from_roughness(float roughness) {
    float alpha_squared = roughness * roughness * roughness * roughness;
    return max(2.0 / max(alpha_squared, 2.0 / (SURFACE_POWER_MAX + 2.0)) - 2.0, SURFACE_POWER_MIN);
}

// The talk's smoothness 0..1 of that power: power = 2^(10 smoothness + 1).
//@domain power: 2..2048
//@promise in 0..1; rising power; where power == 2.0: result == 0.0; where power == 2048.0: within(result, 1.0, slack)
float smoothness_from_power(float power) { return saturate((log2(power) - 1.0) * 0.1); }

// (n.h)^power is given as its square root too: direct_light multiplies by the root twice, so that nothing is subnormal in half
// before the highlight itself is below 2^-14. As one factor the lobe ended there, and (power + 2) / 8 made 0.016 of it.
#ifdef TIER_REFERENCE
// As written. FULL: n.h of half has three values inside a highlight.
//@variant TIER_REFERENCE
//@domain n, h: unit; power: 1.75..2048
//@promise in 0..1.002; falling power; where n == h: within(result, 1.0, 0.002)
float blinn_lobe(FULL vec3 n, FULL vec3 h, float power) { return pow(max(dot(n, h), 1e-8), power); }
//@variant TIER_REFERENCE
//@domain n, h: unit; power: 1.75..2048
//@promise in 0..1.001; falling power; where n == h: within(result, 1.0, 0.001)
float blinn_root(FULL vec3 n, FULL vec3 h, float power) { return pow(max(dot(n, h), 1e-8), 0.5 * power); }
#else
// From the chord n - h. With x = |n - h|^2 / 2 = 1 - n.h, ln(1 - x) = -x (1 + x/2 + x^2/3 + x^3/4 ...): at a
// power of 2048 half's n.h has three values inside the highlight, the chord has hundreds. FULL: up to the exponent; the
// difference is what counts, and the series would add four roundings where a wide lobe is dark. The series stops at x^3: at a
// power of 2 and n.h = 0.15 the lobe is 0.023 too bright, above a power of 8 under 0.001. Where FULL is mediump (0.06 % of the
// peak), 16 keeps the square of a one-texel highlight (1e-5) above half's smallest normal number. `halfframe accuracy surface`
// prints both errors.
//@domain n, h: unit; power: 1.75..2048
//@promise in 0..1; falling power; where n == h: result == 1.0; within(blinn_root(h, n, power), result, slack)
//@promise within(blinn_root(n.yzx, h.yzx, power), result, slack)
float blinn_root(FULL vec3 n, FULL vec3 h, float power) {
    FULL vec3 chord = 16.0 * (n - h);
    FULL float square = dot(chord, chord);  // 512 x, 0..1024
    FULL float x = square * (1.0 / 512.0);
    // Past the end of half the exponent is inf and the lobe 0, as it should be.
    // 0.00140888 is log2(e) / 2 / 512: of the root, in bits.
    float exponent = square * power * (0.00140888 + x * (0.00070444 + x * (0.00046916 + x * 0.00035222)));
    return exp2(-exponent);
}
//@domain n, h: unit; power: 1.75..2048
//@promise in 0..1; falling power; where n == h: result == 1.0; within(blinn_lobe(h, n, power), result, slack)
//@promise within(blinn_lobe(n.yzx, h.yzx, power), result, slack)
float blinn_lobe(FULL vec3 n, FULL vec3 h, float power) {
    float root = blinn_root(n, h, power);
    return root * root;
}
#endif

// blinn_root without a half vector: (n.h)^2 = (1 + r.l) / 2 where the mirrored ray r, n and l lie in one plane. Out of it the lobe
// is round, where Blinn's gets longer at grazing angles. With x = |r - l|^2 / 4 = 1 - (n.h)^2 the root is (1 - x)^(power / 4); the
// series stops at x^2. FULL: see blinn_root.
//@domain mirrored, l: unit; power: 2..2048
//@promise in 0..1; falling power; where mirrored == l: result == 1.0; within(mirrored_root(l, mirrored, power), result, slack)
float mirrored_root(FULL vec3 mirrored, FULL vec3 l, float power) {
    FULL vec3 chord = 16.0 * (mirrored - l);
    FULL float square = dot(chord, chord);  // 1024 x
    FULL float x = square * (1.0 / 1024.0);
    float exponent = square * power * (0.00035222 + x * (0.00017611 + x * 0.00011741));  // log2(e) / 4 / 1024
    return exp2(-exponent);
}

// Smooth fall to 0 at the light's range; 1 at 1 m. distance_squared [m^2], inverse_range_squared [1/m^2].
// Window: B. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013. FULL: a distance of 256 m squared overflows half.
// Nearer than 1/316 of the range it grows no more, and never past 60000, so that a lamp inside a surface stays finite in any
// unit of length, in half too.
//@domain distance_squared: 0..1e8; inverse_range_squared: 1e-6..1e4
//@promise in 0..60000; falling distance_squared; where distance_squared * inverse_range_squared >= 1.0: result == 0.0
//@promise where result < 6e4: within(distance_falloff(4.0 * distance_squared, 0.25 * inverse_range_squared), 0.25 * result, slack)
float distance_falloff(FULL float distance_squared, FULL float inverse_range_squared) {
    FULL float ratio = distance_squared * inverse_range_squared;
    FULL float window = clamp(1.0 - ratio * ratio, 0.0, 1.0);
    return min(window * window * inverse_range_squared / max(ratio, 1e-5), 60000.0);
}

// Spot cone: 0 outside, 1 inside, smooth between. cos_scale = 1 / (cos inner - cos outer). FULL: cosine less cos_outer cancels on
// a narrow edge.
//@domain cosine, cos_outer: -1..1; cos_scale: 0.5..2048
//@promise in 0..1; rising cosine; where cosine <= cos_outer: result == 0.0
float cone_falloff(FULL float cosine, float cos_outer, float cos_scale) {
    FULL float t = clamp((cosine - cos_outer) * cos_scale, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// The power whose lobe is as wide as the lobe of `power` smeared over a shining sphere; 1 / ratio times the sphere's radius
// is its distance, ratio 0..1. `smear` is the square of the sphere's angular radius over that of the lobe (half angles, hence
// the 8). The smeared peak is (1 - exp(-smear)) / smear of the sharp one; this is that within 8 %, without its 0/0, and 1 to
// the bit for a point. The result lies in 1.75..power, so that nothing is ever raised to 0.
//@domain power: 2..2048; ratio: 0..1
//@promise in 1.75..2048; falling ratio; where ratio == 0.0: result == power
float area_power(float power, float ratio) {
    float smear = ratio * (ratio * (power * 0.125));  // in this order nothing is subnormal in half before it is negligible
    return power / (smear + 1.0 / (1.0 + 0.5 * smear));
}

// Light leaving towards v for one direction of light. `radiance` is its color (irradiance / pi) there. FULL: see blinn_root.
//@domain albedo, specular: 0..1; power: 1.75..2048; n, v, l: unit; radiance: 0..400; where (power + 2.0) * max(max(radiance.r, radiance.g), radiance.b) <= 512500.0
//@exempt half_flushed, es_minimum: within exp2(-14.0) * (1.0 + max(max(radiance.r, radiance.g), radiance.b) * (3.0 + (power + 2.0) * 0.125)); the result and three sums and products are 0 below 2^-14, and Fresnel is before it is multiplied by the peak of the lobe
//@promise in 0..65504; where dot(n, l) <= 0.0: result == vec3(0.0)
vec3 direct_light(vec3 albedo, vec3 specular, float power, FULL vec3 n, FULL vec3 v, FULL vec3 l, vec3 radiance) {
    FULL vec3 h = l + v;
    h *= inversesqrt(max(dot(h, h), 6.2e-5));  // l = -v has no half vector; 6.2e-5 is just above half's smallest normal
    FULL float n_dot_l = clamp(dot(n, l), 0.0, 1.0);
    vec3 reflected = fresnel_schlick(specular, dot(l, h));
    float root = blinn_root(n, h, power);
    reflected *= (power + 2.0) * 0.125 * root * root;
    return (albedo + reflected) * (radiance * n_dot_l);
}

// As direct_light, for a sphere instead of a point: the lobe gets lower and wider and keeps its energy, because the power
// that widens it normalises it too. FULL: see blinn_root.
//@domain albedo, specular, ratio: 0..1; power: 2..2048; n, v, l: unit; radiance: 0..400; where (power + 2.0) * max(max(radiance.r, radiance.g), radiance.b) <= 512500.0
//@exempt half_flushed, es_minimum: within exp2(-14.0) * (1.0 + max(max(radiance.r, radiance.g), radiance.b) * (3.0 + (power + 2.0) * 0.125)); the result and three sums and products are 0 below 2^-14, and Fresnel is before it is multiplied by the peak of the lobe
//@promise in 0..65504; where dot(n, l) <= 0.0: result == vec3(0.0)
vec3 sphere_light(vec3 albedo, vec3 specular, float power, FULL vec3 n, FULL vec3 v, FULL vec3 l, vec3 radiance,
                  float ratio) {
    return direct_light(albedo, specular, area_power(power, ratio), n, v, l, radiance);
}
