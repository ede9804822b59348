// ES 1.00: the only file, with es300.glsl, that knows how this language spells things.
#include "common/precision.glsl"
#ifdef STAGE_VERTEX
#define VERTEX_IN attribute
#define VERTEX_OUT varying
#else
#ifdef UNIFORMS_BY_VERTEX
#define FRAGMENT_UNIFORM varying  // the vertex stage hands it on: engine/gl/uniforms_by_vertex.h
#else
#define FRAGMENT_UNIFORM uniform
#endif
#define FRAGMENT_IN varying
#define fragment_color gl_FragColor
#endif
#define sample_2d(image, at) texture2D(image, at)
#define sample_cube(image, toward) textureCube(image, toward)
