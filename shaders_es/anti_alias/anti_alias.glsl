// How an edge is told from a surface, and how much of a pixel lies beyond it.
#include "anti_alias/anti_alias_limits.h"

// Rec. 601 weights on display values: they are made for values that a display shows.
float edge_luma(vec3 display) { return dot(display, vec3(0.299, 0.587, 0.114)); }

// Least difference from the neighbours that counts, for the brightest luma among them.
float edge_contrast(float brightest) { return max(brightest * ANTI_ALIAS_RELATIVE_CONTRAST, ANTI_ALIAS_CONTRAST); }

// The staircase of a straight line has steps of one pixel, and the line crosses each step in the middle of its run. So
// a pixel whose centre is `near_end` pixels from one end of its run and `far_end` from the other lies beyond the line by
// this share: 1/2 at the end, 0 from the middle on.
float edge_share(float near_end, float far_end) { return max(0.5 - near_end / (near_end + far_end), 0.0); }
