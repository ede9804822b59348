// What the shading model leaves out of the material it is given, in double: metallic-roughness as glTF 2.0 defines it,
// and what both send back of light that comes from everywhere alike. Colours are handled one channel at a time.
#pragma once

namespace halfframe::reference {

/// The cosines a reflection is made of, each 0..1: of normal n, light l, view v and half vector h.
struct Cosines {
    double n_l, n_v, n_h, l_h;
};

/// BRDF [1/sr] of a metallic-roughness material: glTF 2.0, appendix B: Trowbridge-Reitz D, the height-correlated Smith
/// visibility, Schlick's F, 0.04 at normal incidence of a dielectric, whose diffuse part gets 1 - F. alpha is
/// roughness squared; roughness 0..1, above 0 (at 0 the highlight is a point).
[[nodiscard]] double gltf_brdf(double base, double metallic, double roughness, const Cosines& at);

/// BRDF [1/sr] of the talk's model, Hoffman's (albedo + F (power + 2) / 8 (n.h)^power) / pi, for the albedo, specular
/// and power that the material is mapped to.
[[nodiscard]] double talk_brdf(double albedo, double specular, double power, const Cosines& at);

/// What a material is mapped to. Dielectrics reflect sRGB 59 at normal incidence: the talk's default.
[[nodiscard]] double mapped_albedo(double base, double metallic);
[[nodiscard]] double mapped_specular(double base, double metallic);

/// Share of white light from everywhere that a lobe sends towards a view: specular * scale + bias (B. Karis, "Real
/// Shading in Unreal Engine 4", SIGGRAPH 2013: split sum). Midpoint sums of 256 x 64 half vectors, drawn as the lobe
/// is dense, so that the narrowest needs no more of them than the widest; 1e-3 where the horizon cuts the lobe.
struct SplitSum {
    double scale, bias;
    [[nodiscard]] double of(double specular) const { return specular * scale + bias; }
};

/// Of gltf_brdf()'s specular lobe; alpha 0..1, `n_v` above 0.
[[nodiscard]] SplitSum split_sum_ggx(double alpha, double n_v);
/// Of talk_brdf()'s lobe: Blinn, with nothing that hides (V = 1).
[[nodiscard]] SplitSum split_sum_blinn(double power, double n_v);

/// Of n.l / pi: the share of diffuse light that gltf_brdf() counts as reflected before.
[[nodiscard]] SplitSum split_sum_lambert(double n_v);

/// Share of white light from everywhere that the whole material sends back; `ggx` and `lambert` are the sums of its
/// roughness and of the view.
[[nodiscard]] double gltf_reflectance(double base, double metallic, const SplitSum& ggx, const SplitSum& lambert);

}  // namespace halfframe::reference
