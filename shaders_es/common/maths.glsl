// Small functions that several effects share.

//@domain x: -65504..65504
//@promise in 0..1; rising x; where x >= 0.0 && x <= 1.0: result == x
float saturate(float x) { return clamp(x, 0.0, 1.0); }

// x^5 in three multiplications: exact, and cheaper than pow (Schlick 1994). FULL: it is taken of 1 - cosine, whose steps of
// 2^-11 in half would come out five times, and the fifth power of 0.14 is subnormal there.
//@domain x: 0..1
//@promise in 0..1; rising x; where x == 1.0: result == 1.0
FULL float pow5(FULL float x) {
    FULL float x2 = x * x;
    return x2 * x2 * x;
}

// What may be stored: NaN and negatives become 0, everything else at most `limit`. Written as a comparison, because
// min, max and clamp of a NaN may return either argument; NaN > 0.0 is false everywhere.
//@domain x: any; limit: 0..65504
//@promise finite; in 0..65504; where x >= 0.0 && x <= limit: result == x
float storable(float x, float limit) { return x > 0.0 ? min(x, limit) : 0.0; }

//@domain color: any; limit: 0..65504
//@promise finite; in 0..65504
vec3 storable(vec3 color, float limit) {
    return vec3(storable(color.r, limit), storable(color.g, limit), storable(color.b, limit));
}
