// The reference of environment.
#include "engine/effects/environment/environment_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace halfframe::reference {

namespace {

double nine_harmonics(const std::array<double, 3>& toward, const std::array<double, 9>& terms) {
    const auto [x, y, z] = toward;
    const std::array<double, 9> polynomials{1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y};
    return std::inner_product(polynomials.begin(), polynomials.end(), terms.begin(), 0.0);
}

}  // namespace

double irradiance(const std::array<double, 3>& normal, const std::array<double, 9>& terms) {
    return std::max(nine_harmonics(normal, terms), 0.0);
}

double reflection_level(double smoothness, double roughest) {
    double whole = 0.0;
    const double part = std::modf((1.0 - smoothness) * roughest, &whole);
    return whole + 1.4 * part - 0.4 * part * part;
}

double constant_reflection_level(double smoothness, double roughest) {
    return std::floor(8.0 * reflection_level(smoothness, roughest) + 0.5) / 8.0;
}

double rgbm_light(double channel, double alpha, double root_range) {
    return std::pow(channel * alpha * root_range, 2.0);
}

double low_reflection(double diffuse, double rough, double sharp, double smoothness) {
    if (smoothness <= 0.35) return diffuse + (rough - diffuse) * smoothness / 0.35;
    if (smoothness <= 0.75) return rough + (sharp - rough) * (smoothness - 0.35) / 0.4;
    return sharp;
}

double axis_bands(double cosine, double third, double fourth) {
    return third * std::legendre(3, cosine) + fourth * std::legendre(4, cosine);
}

double rough_reflection(const std::array<double, 3>& toward, const RoughTerms& terms) {
    const double cosine =
        std::clamp(std::inner_product(toward.begin(), toward.end(), terms.axis.begin(), 0.0), -1.0, 1.0);
    const double sum = std::max(nine_harmonics(toward, terms.nine) + axis_bands(cosine, terms.third, terms.fourth), 0.0);
    return std::pow(sum, 2.0);
}

namespace {

using Direction = std::array<double, 3>;

/// Mean over half vectors, whose cosine with +Z is cosine_of(u) for even u, of weight(n.h, l.h, n.l) F(l.h)
/// radiance(l).
template <typename CosineOf, typename Weight>
double mean_over_lobe(const std::function<double(const Direction&)>& radiance, const Direction& to_eye, double specular,
                      int steps, CosineOf cosine_of, Weight weight) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = cosine_of((i + 0.5) / steps);
        const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
        for (int k = 0; k < steps; ++k) {
            const double turn = 2.0 * std::numbers::pi * (k + 0.5) / steps;
            const Direction h{sine * std::cos(turn), sine * std::sin(turn), cosine};
            const double along = h[0] * to_eye[0] + h[1] * to_eye[1] + h[2] * to_eye[2];
            if (along <= 0.0) continue;
            const Direction l{2.0 * along * h[0] - to_eye[0], 2.0 * along * h[1] - to_eye[1],
                              2.0 * along * h[2] - to_eye[2]};
            if (l[2] <= 0.0) continue;
            const double fresnel = specular + (1.0 - specular) * std::pow(1.0 - along, 5.0);
            sum += fresnel * weight(cosine, along, l[2]) * radiance(l);
        }
    }
    return sum / (static_cast<double>(steps) * steps);
}

}  // namespace

double reflected_light(const std::function<double(const Direction&)>& radiance, const Direction& to_eye,
                       double specular, double power, int steps) {
    // Half vectors are drawn as the lobe has them, (power + 1) / (2 pi) cos^power, which takes the lobe out of the sum:
    // dl = 4 (l.h) dh turns the integral into the mean of F (power + 2) / (power + 1) (l.h) (n.l) radiance.
    return mean_over_lobe(
        radiance, to_eye, specular, steps, [&](double u) { return std::pow(u, 1.0 / (power + 1.0)); },
        [&](double, double l_h, double n_l) { return (power + 2.0) / (power + 1.0) * l_h * n_l; });
}

double reflected_light_ggx(const std::function<double(const Direction&)>& radiance, const Direction& to_eye,
                           double specular, double alpha_squared, int steps) {
    // Drawn as D (n.h) has them, so that 4 V (n.l) (l.h) / (n.h) stays; V is Smith's over 4 (n.l) (n.v).
    const double n_v = to_eye[2], rest = 1.0 - alpha_squared;
    return mean_over_lobe(
        radiance, to_eye, specular, steps, [&](double u) { return std::sqrt((1.0 - u) / (1.0 - rest * u)); },
        [&](double n_h, double l_h, double n_l) {
            const double view = n_l * std::sqrt(n_v * n_v * rest + alpha_squared);
            const double light = n_v * std::sqrt(n_l * n_l * rest + alpha_squared);
            return 2.0 * n_l * l_h / (n_h * (view + light));
        });
}

}  // namespace halfframe::reference
