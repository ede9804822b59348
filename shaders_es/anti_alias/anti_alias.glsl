// How an edge is told from a surface, and how much of a pixel lies beyond it.
#include "anti_alias/anti_alias_limits.h"

// Rec. 601 weights on display values: they are made for values that a display shows.
//@domain display: 0..1
//@promise in 0..1; rising display
//@exempt half_flushed, es_minimum: within 3.0 * exp2(-14.0); each of three products is 0 below 2^-14: a twentieth of a code
float edge_luma(vec3 display) { return dot(display, vec3(0.299, 0.587, 0.114)); }

// Least difference from the neighbours that counts, for the brightest luma among them.
//@domain brightest: 0..1
//@promise in 0.0626..0.126; rising brightest
float edge_contrast(float brightest) { return max(brightest * ANTI_ALIAS_RELATIVE_CONTRAST, ANTI_ALIAS_CONTRAST); }

// The staircase of a straight line has steps of one pixel, and the line crosses each step in the middle of its run. So
// a pixel whose centre is `near_end` pixels from one end of its run and `far_end` from the other lies beyond the line by
// this share: 1/2 at the end, 0 from the middle on.
//@domain near_end, far_end: 0.5..8.5; where near_end <= far_end
//@promise in 0..0.5; falling near_end; rising far_end; where near_end == far_end: result == 0.0
float edge_share(float near_end, float far_end) { return max(0.5 - near_end / (near_end + far_end), 0.0); }
