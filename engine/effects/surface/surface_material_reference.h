// What glTF's material extensions define, in double: what surface_material.glsl and the picture are measured against.
// Shares no code with the shaders. Colours are handled one channel at a time.
#pragma once

#include <array>

namespace halfframe::reference {

/// Reflectance of a dielectric at normal incidence: KHR_materials_ior (`ior` >= 1, or 0 for a reflectance of 1) times
/// KHR_materials_specular, min(F0 colour, 1) share; `color` is factor times texel, `share` likewise, 0..1.
[[nodiscard]] double dielectric_specular(double ior, double color, double share);

/// One channel of the albedo of KHR_materials_pbrSpecularGlossiness, all 0..1.
[[nodiscard]] double albedo_beside(double diffuse, const std::array<double, 3>& specular);

/// Share of the light from everywhere that arrives: glTF 2.0, occlusionTexture; both 0..1.
[[nodiscard]] double occlusion_share(double texel, double strength);

/// IEC 61966-2-1; 0..1.
[[nodiscard]] double srgb_from_linear(double linear);

/// KHR_texture_transform: scaled, then turned counter-clockwise in the picture, whose v grows downwards, then moved.
[[nodiscard]] std::array<double, 2> transformed_uv(const std::array<double, 2>& uv, const std::array<double, 2>& offset,
                                                   const std::array<double, 2>& scale, double rotation_rad);

}  // namespace halfframe::reference
