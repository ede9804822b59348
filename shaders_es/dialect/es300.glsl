// ES 3.00: the only file, with es100.glsl, that knows how this language spells things.
#include "common/precision.glsl"
#ifdef STAGE_VERTEX
#define VERTEX_IN in
#define VERTEX_OUT out
#else
#ifdef UNIFORMS_BY_VERTEX
#define FRAGMENT_UNIFORM flat in  // the vertex stage hands it on: engine/gl/uniforms_by_vertex.h
#else
#define FRAGMENT_UNIFORM uniform
#endif
#define FRAGMENT_IN in
layout(location = 0) out HALF vec4 fragment_color;
#endif
#define sample_2d(image, at) texture(image, at)
#define sample_compared(image, at) texture(image, at)
#define sample_cube(image, toward) texture(image, toward)
#define fetch_texel(image, at) texelFetch(image, at, 0)
#define sample_cube_lod(image, toward, lod) textureLod(image, toward, lod)
