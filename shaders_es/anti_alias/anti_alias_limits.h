// The edge filter's numbers that shaders and C++ share.

/* Least difference of luma that is an edge, and as a share of the brighter side: below, the eye sees no staircase.
   Ours: 16 codes of 255, an eighth. */
#define ANTI_ALIAS_CONTRAST 0.0627
#define ANTI_ALIAS_RELATIVE_CONTRAST 0.125

/* Pixels walked along an edge each way: edges down to a slope of 1 in 8 are smooth over their whole length. */
#define ANTI_ALIAS_REACH 8
