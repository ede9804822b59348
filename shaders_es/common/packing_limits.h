// How RGB10_A2 packs scene_color: numbers that shaders and C++ share.

/* The largest linear light that is stored; the tone map is white there (TONE_MAP_RANGE). */
#define SCENE_COLOR_RANGE 8.0

/* 1 / sqrt(SCENE_COLOR_RANGE), and sqrt(SCENE_COLOR_RANGE). */
#define SCENE_COLOR_PACK 0.353553391
#define SCENE_COLOR_UNPACK 2.82842712
