// Vertex stage, inserted into surfaces: where a vertex is in the sun's map.
#include "shadow/shadow.glsl"

uniform highp mat4 shadow_from_eye;  // from metres (world axes, origin at the eye) to the map, 0..1 in all three
uniform highp vec4 shadow_toward;    // xyz unit, towards the sun; w radius of the filter [m]
VERTEX_OUT FULL vec3 shadow_at;      // FULL: a 1024th is past half's 11 bits as soon as it is filtered

//@stage vertex
//@domain at: -1000..1000; n: unit; highp mat4 shadow_from_eye: -1..1; highp vec4 shadow_toward: -1..1
//@exempt float, half, half_flushed, es_minimum: within exp2(-60.0); the square of a sine below 2^-63 is 0 in fp32
//@promise in -6000..6000
vec3 placed_in_shadow(vec3 at, vec3 n) {
#ifdef DOUBLE_SIDED
    n = dot(n, shadow_toward.xyz) < 0.0 ? -n : n;  // the side that the sun lights is the side to step off to
#endif
    return (shadow_from_eye * vec4(at + shadow_lift(n, shadow_toward.xyz, shadow_toward.w), 1.0)).xyz;
}
