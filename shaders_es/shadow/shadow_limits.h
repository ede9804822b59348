// Numbers that the shadow's shaders and C++ share.

/* Side of the map [texels]. 1024 at 16 bits is 2 MiB, the console's share; 2048 (8 MiB) is what every
   ES 3.0 device has, and leaves a 1280x720 frame of float targets inside 32 MiB. */
#define SHADOW_MAP_SIZE_CONSOLE 1024
#define SHADOW_MAP_SIZE_REFERENCE 2048

/* Texels at the rim that nothing is drawn into: they stay empty, so what lies outside the map reads as lit without a
   comparison in the shader. 8 leaves 1008 and 2032 texels, both whole multiples of SHADOW_CELLS. */
#define SHADOW_MAP_RIM 8

/* The map moves over the world in steps of 1/16 of its side: between two steps it need not be drawn again. */
#define SHADOW_CELLS 16

/* Console: four taps at (near, far) turned by quarters [texels], each the hardware's bilinear comparison. Of the
   patterns of four tried, the nearest to a box filter over half-planes of random slope and phase: 0.046 rms against a
   box of 3.25 texels (a square of taps at 0.5: 0.053, at 1.0: 0.049; the far pattern 0.5, 1.5: 0.051; one tap: 0.082).
 */
#define SHADOW_TAP_NEAR 0.375
#define SHADOW_TAP_FAR 1.125

/* Reference: 6 x 6 taps one texel apart, on texels of half the size: the same softness in metres, 0.019 rms. */
#define SHADOW_TAPS_REFERENCE 6

/* How far from the looked-up point a compared texel may lie [texels]: the farthest tap and one texel of its filter. */
#define SHADOW_REACH_CONSOLE 2.53
#define SHADOW_REACH_REFERENCE 4.95
