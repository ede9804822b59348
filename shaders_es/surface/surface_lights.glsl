// How many local lights a variant adds up. A loop of a known length is unrolled and has no exit to test: on llvmpipe a
// frame of 35 spheres under two points went from 62 to 54 ms of processor time so, and to 48 without the branch for spots.
// Up to four have a variant of their own; above that the count is a uniform.
#if defined(ONE_LIGHT)
#define LIGHT_SLOTS 1
#elif defined(TWO_LIGHTS)
#define LIGHT_SLOTS 2
#elif defined(THREE_LIGHTS)
#define LIGHT_SLOTS 3
#elif defined(FOUR_LIGHTS)
#define LIGHT_SLOTS 4
#else
#define LIGHT_SLOTS SURFACE_LIGHT_LIMIT
#define COUNTED_LIGHTS
#endif

// What is mirrored leaves with the rest of the light.
#if defined(MIRROR_BY_VERTEX) && !defined(LIT_BY_VERTEX)
#define LIT_BY_VERTEX
#endif
