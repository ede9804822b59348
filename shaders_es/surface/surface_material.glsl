// What the extensions of glTF's material say, as plain functions of values: they sample nothing, so tests can call each one
// alone.

// Reflectance of a dielectric at normal incidence with KHR_materials_specular: `specular` is ((ior - 1) / (ior + 1))^2 times
// the factors, 0..1; `tint` and `share` are what the two textures say, 0..1. The extension limits the reflectance to 1 before
// it is multiplied with `share`.
//@domain specular, tint, share: 0..1
//@promise in 0..1
vec3 dielectric_specular(vec3 specular, vec3 tint, float share) { return min(specular * tint, vec3(1.0)) * share; }

// Albedo of KHR_materials_pbrSpecularGlossiness: what the strongest channel of the specular leaves.
//@domain diffuse, specular: 0..1
//@promise in 0..1
vec3 albedo_beside(vec3 diffuse, vec3 specular) {
    return diffuse * (1.0 - saturate(max(max(specular.r, specular.g), specular.b)));
}

// Share of the light from everywhere that arrives, 0..1: `texel` of the occlusion texture, faded by `strength` 0..1.
//@domain texel, strength: 0..1
//@promise in 0..1
float occlusion_share(float texel, float strength) { return 1.0 + strength * (texel - 1.0); }

// What the alpha of an opaque surface's vertices says about water: x how open to the rain, y how deep a hollow. Codes 0 to
// 127 of 255 lead from shelter to open ground, from there to 255 the hollow gets deeper. Both factors are a little large, so
// that code 127 is open and level in half too.
//@domain alpha: 0..1
//@promise in 0..1; rising alpha; where alpha == 0.0: result == vec2(0.0); where alpha == 1.0: result == vec2(1.0)
vec2 vertex_water(float alpha) { return clamp(vec2(alpha * 2.01, (alpha - 0.4982) * 1.9935), 0.0, 1.0); }
