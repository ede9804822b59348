// How RGB10_A2 packs scene_color: numbers that shaders and C++ share.

/* The largest linear light that is stored; the tone map is white there (TONE_MAP_RANGE). */
#define SCENE_COLOR_RANGE 8.0
