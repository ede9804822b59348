// sRGB to linear, for devices whose textures do not decode themselves, and back, for colours that no light changes.

#ifdef TIER_REFERENCE
// IEC 61966-2-1, exact. FULL: half's log2 is rounded before 2.4 times of it are raised.
//@variant TIER_REFERENCE
//@domain s: 0..1
//@promise in 0..1; rising s; where s == 0.0: result == 0.0; where s == 1.0: within(result, 1.0, slack)
float linear_from_srgb(FULL float s) { return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4); }
//@variant TIER_REFERENCE
//@domain s: 0..1
//@promise in 0..1; rising s
vec3 linear_from_srgb(vec3 s) { return vec3(linear_from_srgb(s.r), linear_from_srgb(s.g), linear_from_srgb(s.b)); }
#else
// A cubic through 0 and 1 fitted to the curve (coefficients: I. Taylor, "sRGB approximations for HLSL", 2012): three
// multiply-adds, no pow; worst error 0.0017 linear at 0.08, at most 1.9 display codes after the tone map.
//@variant TIER_LOW
//@domain s: 0..1
//@promise in 0..1; rising s
vec3 linear_from_srgb(vec3 s) { return s * (s * (s * 0.305306011 + 0.682171111) + 0.012522878); }
#endif

// IEC 61966-2-1, exact. linear 0..1; the max() keeps pow from 0. FULL: 0.055 is taken from 0.1 near black.
//@domain x: 0..1
//@promise in 0..1; rising x; where x == 0.0: result == 0.0
float srgb_from_linear(FULL float x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * pow(max(x, 1e-4), 1.0 / 2.4) - 0.055; }
//@domain x: 0..1
//@promise in 0..1; rising x
vec3 srgb_from_linear(vec3 x) { return vec3(srgb_from_linear(x.r), srgb_from_linear(x.g), srgb_from_linear(x.b)); }
