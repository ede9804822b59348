// The reference of environment.
#include "engine/effects/environment/environment_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halfframe::reference {

double irradiance(const std::array<double, 3>& normal, const std::array<double, 9>& terms) {
    const auto [x, y, z] = normal;
    const std::array<double, 9> polynomials{1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y};
    double sum = 0.0;
    for (std::size_t i = 0; i < polynomials.size(); ++i) sum += terms[i] * polynomials[i];
    return std::max(sum, 0.0);
}

double reflection_level(double smoothness, double roughest) {
    double whole = 0.0;
    const double part = std::modf((1.0 - smoothness) * roughest, &whole);
    return whole + 1.82 * part - 0.82 * part * part;
}

double rgbm_light(double channel, double alpha, double root_range) {
    return std::pow(channel * alpha * root_range, 2.0);
}

double low_reflection(double diffuse, double rough, double sharp, double smoothness) {
    if (smoothness <= 0.35) return diffuse + (rough - diffuse) * smoothness / 0.35;
    if (smoothness <= 0.75) return rough + (sharp - rough) * (smoothness - 0.35) / 0.4;
    return sharp;
}

double reflected_light(const std::function<double(const std::array<double, 3>&)>& radiance,
                       const std::array<double, 3>& to_eye, double specular, double power, int steps) {
    // Half vectors are drawn as the lobe has them, (power + 1) / (2 pi) cos^power, which takes the lobe out of the sum:
    // dl = 4 (l.h) dh turns the integral into the mean of F (power + 2) / (power + 1) (l.h) (n.l) radiance.
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = std::pow((i + 0.5) / steps, 1.0 / (power + 1.0));
        const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
        for (int k = 0; k < steps; ++k) {
            const double turn = 2.0 * std::numbers::pi * (k + 0.5) / steps;
            const std::array<double, 3> h{sine * std::cos(turn), sine * std::sin(turn), cosine};
            const double along = h[0] * to_eye[0] + h[1] * to_eye[1] + h[2] * to_eye[2];
            if (along <= 0.0) continue;
            const std::array<double, 3> l{2.0 * along * h[0] - to_eye[0], 2.0 * along * h[1] - to_eye[1],
                                          2.0 * along * h[2] - to_eye[2]};
            if (l[2] <= 0.0) continue;
            const double fresnel = specular + (1.0 - specular) * std::pow(1.0 - along, 5.0);
            sum += fresnel * along * l[2] * radiance(l);
        }
    }
    return sum * (power + 2.0) / (power + 1.0) / (static_cast<double>(steps) * steps);
}

}  // namespace halfframe::reference
