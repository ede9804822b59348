// Fragment stage at low: as above low, but the material says once for all its texels how porous it is.
#include "wet_surface/wet_surface_receive.glsl"

FRAGMENT_UNIFORM HALF vec4 wet_material;  // x porosity 0..1, made on the CPU
