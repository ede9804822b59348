// Fragment stage: how far hollows are filled, and what standing water makes of a smoother surface.
#include "puddles/puddles.glsl"
#include "wet_surface/wet_surface.glsl"

FRAGMENT_UNIFORM HALF vec4 puddle_level;  // x 0..1
