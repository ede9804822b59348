// Lays a rectangle on the ground under an object: the part of the blob's square that has ground below it.
VERTEX_IN vec3 position;             // x and z 0..1, y 0
uniform highp mat4 clip_from_local;  // from radii of the blob, its centre at 0
uniform highp vec4 span;             // xy least, zw greatest x and z [radii], -1..1
VERTEX_OUT HALF vec2 from_centre;    // [radii]

void main() {
    vec2 place = mix(span.xy, span.zw, position.xz);
    from_centre = place;
    gl_Position = clip_from_local * vec4(place.x, 0.0, place.y, 1.0);
}
