// The talk's tone curve, y = B x / (x + A): numbers that shaders and C++ share. S. Lagarde and L. Harduin, GDC Europe 2013.

#define TONE_MAP_A 0.22

/* Linear light that becomes 1.0 (255). */
#define TONE_MAP_RANGE 8.0

/* (TONE_MAP_RANGE + A) / TONE_MAP_RANGE, so that the curve reaches exactly 1 there. */
#define TONE_MAP_B 1.0275
