// Light from an environment as its sources define it, in double: what environment.glsl is measured against. Shares no
// code with it. Colours are handled one channel at a time.
#pragma once

#include <array>
#include <functional>

namespace halfframe::reference {

/// Light that a white Lambert surface shows whose unit normal is (x, y, z): irradiance / pi. `terms` are the nine
/// factors of EnvironmentMap::irradiance. Never below 0. R. Ramamoorthi and P. Hanrahan, SIGGRAPH 2001.
[[nodiscard]] double irradiance(const std::array<double, 3>& normal, const std::array<double, 9>& terms);

/// Level of a chain for `smoothness` 0..1, where smoothness 0 reads level `roughest`: (1 - smoothness) roughest, with
/// its fraction f bent to f + 0.4 f (1 - f). The bend is ours: of 0, 0.2, 0.4, 0.6, 0.8 the least mean
/// error in display codes for lamps of 2 to 20 degrees, and next to the least up to 80 (least largest error: 0).
[[nodiscard]] double reflection_level(double smoothness, double roughest);

/// The level whose cube a surface of one smoothness everywhere has: that level to the nearest eighth.
[[nodiscard]] double constant_reflection_level(double smoothness, double roughest);

/// Light that an RGBM8 texel of 0..1 stands for: the square of channel * alpha * root_range.
[[nodiscard]] double rgbm_light(double channel, double alpha, double root_range);

/// What the low tier reflects at `smoothness` 0..1: linear from `diffuse` at 0 to `rough` at 0.35 to `sharp` at 0.75,
/// which stays. Our own choice of places: see the README.
[[nodiscard]] double low_reflection(double diffuse, double rough, double sharp, double smoothness);

/// One channel of what vertices know of a rough reflection: the factors of the nine polynomials of irradiance(), and those of
/// Legendre's polynomials of band 3 and 4 about a unit axis. They add up to the root of the light.
struct RoughTerms {
    std::array<double, 9> nine{};
    std::array<double, 3> axis{};
    double third = 0.0, fourth = 0.0;
};

/// third P3(cosine) + fourth P4(cosine), Legendre's polynomials.
[[nodiscard]] double axis_bands(double cosine, double third, double fourth);

/// The light that a rough surface mirrors of the unit ray `toward`; never below 0.
[[nodiscard]] double rough_reflection(const std::array<double, 3>& toward, const RoughTerms& terms);

/// One channel of the light that leaves towards the unit vector `to_eye` when a surface of normal (0, 0, 1) reflects
/// `radiance(direction)` by the Blinn microfacet model, without the albedo: the integral over the hemisphere of
/// F(l.h) (power + 2) / (8 pi) (n.h)^power radiance(l) (n.l). `steps` a side of the grid of half vectors; 256 are
/// within 1e-4 for radiance that is smooth over a degree. N. Hoffman, SIGGRAPH 2010.
[[nodiscard]] double reflected_light(const std::function<double(const std::array<double, 3>&)>& radiance,
                                     const std::array<double, 3>& to_eye, double specular, double power, int steps);

/// The same with the specular lobe of glTF 2.0, appendix B (Trowbridge-Reitz, height-correlated Smith), whose alpha
/// squared is `alpha_squared`. This is what fresnel_glossy() times a prefiltered level stands for.
[[nodiscard]] double reflected_light_ggx(const std::function<double(const std::array<double, 3>&)>& radiance,
                                         const std::array<double, 3>& to_eye, double specular, double alpha_squared,
                                         int steps);

}  // namespace halfframe::reference
