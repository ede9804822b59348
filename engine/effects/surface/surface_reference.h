// Direct light as its sources define it, in double: what surface.glsl is measured against. Shares no code with it.
// Colours are handled one channel at a time.
#pragma once

#include <array>

namespace halfframe::reference {

using Vector = std::array<double, 3>;

/// Fresnel reflectance 0..1 at the cosine 0..1 between light and half vector; `specular` 0..1 at normal incidence.
/// C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
[[nodiscard]] double fresnel_schlick(double specular, double cosine);

/// Fresnel of a prefiltered environment: rises to the larger of `smoothness` 0..1 and `specular`, not to 1.
/// S. Lagarde and L. Harduin, GDC Europe 2013, "Glossy Fresnel". `cosine` 0..1 between normal and view.
[[nodiscard]] double fresnel_glossy(double specular, double smoothness, double cosine);

/// Blinn power 2..2048 of perceptual roughness 0..1: 2 / roughness^4 - 2, clamped. B. Karis, SIGGRAPH 2013 (GGX's width
/// at the peak, alpha = roughness^2); the range is the talk's.
[[nodiscard]] double power_from_roughness(double roughness);

/// The talk's smoothness 0..1 of a power 2..2048: power = 2^(10 smoothness + 1).
[[nodiscard]] double smoothness_from_power(double power);

/// (n.h)^power, 0 where n.h is negative. Unit vectors; power 2..2048. J. Blinn, 1977.
[[nodiscard]] double blinn_lobe(const Vector& n, const Vector& h, double power);

/// Share of a light's intensity at `distance_m` > 0 [1/m^2]: inverse square times (1 - (d / range)^4)^2, 0 from the
/// range on. Window: B. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013; his +1 under the square is left out.
/// Nearer than range / sqrt(1e5) (1 m where the range is 316 m) the share grows no more: our own limit.
[[nodiscard]] double distance_falloff(double distance_m, double range_m);

/// Share of a spot's light 0..1: 0 from the outer cone on, 1 inside the inner, a smooth step of the cosine between.
/// cos_inner > cos_outer.
[[nodiscard]] double cone_falloff(double cosine, double cos_outer, double cos_inner);

/// One channel of the light that leaves towards `v` for light from `l`:
/// (albedo + F(l.h) (power + 2) / 8 (n.h)^power) n.l radiance, h the normalised l + v. Unit vectors, l not opposite to
/// v; `radiance` is irradiance / pi. N. Hoffman, "Crafting Physically Motivated Shading Models for Game Development",
/// SIGGRAPH 2010.
[[nodiscard]] double direct_light(double albedo, double specular, double power, const Vector& n, const Vector& v,
                                  const Vector& l, double radiance);

/// The power whose lobe peaks as high as the lobe of `power` smeared over a sphere light: the mean of exp(-power a^2 /
/// 2) over half angles a up to ratio / 2 is (1 - exp(-u)) / u of the peak, u = power ratio^2 / 8. `ratio` 0..1 is the
/// sphere's radius over its distance. Derived for light and view near the normal.
[[nodiscard]] double area_power(double power, double ratio);

/// direct_light() of a sphere of even radiance, summed over the sphere itself: what a widened power only imitates. `l`
/// leads to its centre; `radiance` is irradiance / pi of a surface that faces it; `ratio` 0..1 is radius over distance,
/// the sine of its angular radius. Parts below the horizon give nothing. Midpoint sum, steps of a third of the lobe's
/// width.
[[nodiscard]] double sphere_light(double albedo, double specular, double power, const Vector& n, const Vector& v,
                                  const Vector& l, double radiance, double ratio);

}  // namespace halfframe::reference
