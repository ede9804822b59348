// Fragment stage: how wet the scene is.
#include "wet_surface/wet_surface.glsl"

FRAGMENT_UNIFORM HALF vec4 wet_level;  // x of what darkens, y of what smooths, 0..1
