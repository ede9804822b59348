// ES 1.00: the only file, with es300.glsl, that knows how this language spells things.
#include "common/precision.glsl"
#ifdef STAGE_VERTEX
#define VERTEX_IN attribute
#define VERTEX_OUT varying
#else
#define FRAGMENT_IN varying
#define fragment_color gl_FragColor
#endif
#define sample_2d(image, at) texture2D(image, at)
#define sample_cube(image, toward) textureCube(image, toward)
