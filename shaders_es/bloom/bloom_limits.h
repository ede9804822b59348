// Bloom's numbers that shaders and C++ share.

/* Linear light above which a pixel blooms: display code 214 of the talk's tone curve. S. Lagarde and L. Harduin, GDC
   Europe 2013, "LDR sky". */
#define BLOOM_THRESHOLD 1.0

/* Light above this counts as this: where the tone curve is white, and the largest light of the talk's range. It bounds
   every stored value (a pixel blooms at most 7) and the flicker of a single highlight. */
#define BLOOM_LIGHT_LIMIT 8.0

/* Standard deviation of the glow at every tier [pixels of the frame]; ours. */
#define BLOOM_SIGMA 12.0

/* By tier: pixels of the frame a side of one texel, pixels read a side for one texel, taps each side of the blur, and
   the sharpness k and peak p of its weights p * exp2(-k * i * i), i in texels. k and p are solved numerically so that
   the weights sum to 1 and the variance of everything together (block, cut-off blur, bilinear magnification) is
   BLOOM_SIGMA squared. */
#define BLOOM_LOW_DIVISOR 8
#define BLOOM_LOW_RADIUS 4
#define BLOOM_LOW_SHARPNESS 0.3553224
#define BLOOM_LOW_PEAK 0.2803498
#define BLOOM_CONSOLE_DIVISOR 4
#define BLOOM_CONSOLE_RADIUS 8
#define BLOOM_CONSOLE_SHARPNESS 0.07895558
#define BLOOM_CONSOLE_PEAK 0.1326134
#define BLOOM_REFERENCE_DIVISOR 2
#define BLOOM_REFERENCE_RADIUS 18
#define BLOOM_REFERENCE_SHARPNESS 0.01972231
#define BLOOM_REFERENCE_PEAK 0.06611059
