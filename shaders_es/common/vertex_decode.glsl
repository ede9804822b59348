// What the CPU stored in fewer bits (engine/frame/vertex_storage.h). Positions need nothing here: their scale and offset
// are in the matrices.

// A direction from its octahedral coordinates -1..1, 0.58 to 1 long: whoever needs it unit normalises it, after its matrix.
//@not_run vertex stage, highp; tests/frame holds it to a double
vec3 direction_from_octahedral(vec2 stored) {
    vec3 n = vec3(stored, 1.0 - abs(stored.x) - abs(stored.y));
    float fold = max(-n.z, 0.0);
    return n + vec3(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold, 0.0);
}

// The same of a tangent: the sign of y is its handedness, which comes back as w.
//@not_run vertex stage, highp; tests/frame holds it to a double
vec4 tangent_from_octahedral(vec2 stored) {
    vec3 t = direction_from_octahedral(vec2(stored.x, abs(stored.y) * 2.0 - 1.0));
    return vec4(t, stored.y < 0.0 ? -1.0 : 1.0);
}

// Coordinates of a texture from steps of the mesh's range: xy scale, zw offset.
//@not_run vertex stage, highp; tests/frame holds it to a double
vec2 uv_from_steps(vec2 stored, vec4 range) { return stored * range.xy + range.zw; }
