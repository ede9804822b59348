// Numbers that surface.vert, surface.frag and surface.cpp share.

/* Local lights of one object: above this the strongest stay. Eight lights of three vec4 are 24 of the 128 vertex (low) or
   224 fragment (console) uniform vectors that the poorest device of the tier has. */
#define SURFACE_LIGHT_LIMIT 8

/* Blinn power at roughness 0 and 1: the talk's range. */
#define SURFACE_POWER_MAX 2048.0
#define SURFACE_POWER_MIN 2.0

/* Reflectance of a dielectric: sRGB 59 (the talk's default), in linear light. */
#define SURFACE_DIELECTRIC_SPECULAR 0.0437

/* Largest value stored in a half target: the largest finite half. */
#define SURFACE_STORE_LIMIT 65504.0
