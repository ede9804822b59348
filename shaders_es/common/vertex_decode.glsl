// What the CPU stored in fewer bits (engine/frame/vertex_storage.h). Positions need nothing here: their scale and offset
// are in the matrices.

// A direction from its octahedral coordinates -1..1, 0.58 to 1 long: whoever needs it unit normalises it, after its matrix.
//@stage vertex
//@domain stored: -1..1
//@promise in -1..1; where stored == vec2(0.0): result == vec3(0.0, 0.0, 1.0)
//@promise dot(result, result) >= 0.333
vec3 direction_from_octahedral(vec2 stored) {
    vec3 n = vec3(stored, 1.0 - abs(stored.x) - abs(stored.y));
    float fold = max(-n.z, 0.0);
    return n + vec3(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold, 0.0);
}

// The same of a tangent: the sign of y is its handedness, which comes back as w.
//@stage vertex
//@domain stored: -1..1
//@promise in -1..1; result.w == (stored.y < 0.0 ? -1.0 : 1.0)
//@jumps step(0.0, stored.y)
//@exempt float, half, half_flushed, es_minimum: within 2.0 * exp2(-24.0); 2 |y| - 1 and 1 - |x| - |y| are rounded to the 24 bits of numbers near 1
vec4 tangent_from_octahedral(vec2 stored) {
    vec3 t = direction_from_octahedral(vec2(stored.x, abs(stored.y) * 2.0 - 1.0));
    return vec4(t, stored.y < 0.0 ? -1.0 : 1.0);
}

// Coordinates of a texture from steps of the mesh's range: xy scale, zw offset.
//@stage vertex
//@domain stored: 0..1; range: -64..64
//@promise in -128..128; where stored == vec2(0.0): result == range.zw
vec2 uv_from_steps(vec2 stored, vec4 range) { return stored * range.xy + range.zw; }
