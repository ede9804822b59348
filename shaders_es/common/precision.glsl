// HALF and FULL: the two precisions of every uniform and varying, the same word in both stages so that both sides agree.
// HALF is mediump unless the arithmetic is full. FULL is highp wherever fragments have it; code that says FULL gives its
// reason, and must still hold (with a stated loss) where FULL is mediump: an ES 2.0 device without fragment highp.
#ifdef ARITHMETIC_FULL
#define HALF highp
#else
#define HALF mediump
#endif
#ifdef FRAGMENT_HIGHP
#define FULL highp
#else
#define FULL mediump
#endif
