// Numbers that the shaders of environment and its C++ share.

/* Largest light, after the exposure, that an RGBM8 texel holds. Eight times what the tone map shows as white: a mirror of 0.04 still
   reflects 0.3 of it. Brighter texels (a bare sun) are cut; a notice says how many. */
#define ENVIRONMENT_RANGE 64.0

/* Low tier: smoothness of the two cubes that stand in for a chain of levels. 0.75 is a power of 362, 0.35 of 23. */
#define ENVIRONMENT_SHARP 0.75
#define ENVIRONMENT_ROUGH 0.35

/* Surfaces of one smoothness read a cube that is made for it, in this many steps from one level to the next. */
#define ENVIRONMENT_STEPS 8
