// What is multiplied into the ground. Where scene_color holds linear light the factor is squared: the tone curve is near a
// square root in the dark, so the ground darkens as much to the eye as where display values are stored.
#include "shadow/shadow.glsl"

FRAGMENT_IN HALF vec2 from_centre;  // [radii]
FRAGMENT_UNIFORM HALF vec4 blob;             // x strength

void main() {
    float shade = blob_shade(from_centre, blob.x);
#ifdef SCENE_COLOR_LINEAR
    shade *= shade;
#endif
    fragment_color = vec4(vec3(shade), 1.0);
}
