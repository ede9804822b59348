// Direct light in double, as its sources define it.
#include "engine/effects/surface/surface_reference.h"

#include <algorithm>
#include <cmath>

namespace halfframe::reference {
namespace {

double product(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Reflectance that rises from `normal` to `grazing`.
double schlick(double normal, double grazing, double cosine) {
    return normal + (grazing - normal) * std::pow(1.0 - std::clamp(cosine, 0.0, 1.0), 5.0);
}

}  // namespace

double fresnel_schlick(double specular, double cosine) { return schlick(specular, 1.0, cosine); }

double fresnel_glossy(double specular, double smoothness, double cosine) {
    return schlick(specular, std::max(specular, smoothness), cosine);
}

double power_from_roughness(double roughness) {
    // A roughness of 0 gives infinity, which the clamp takes to 2048.
    return std::clamp(2.0 / std::pow(roughness, 4.0) - 2.0, 2.0, 2048.0);
}

double smoothness_from_power(double power) { return (std::log2(power) - 1.0) / 10.0; }

double blinn_lobe(const Vector& n, const Vector& h, double power) {
    const double cosine = product(n, h);
    return cosine > 0.0 ? std::pow(cosine, power) : 0.0;
}

double distance_falloff(double distance_m, double range_m) {
    if (distance_m >= range_m) return 0.0;
    const double window = 1.0 - std::pow(distance_m / range_m, 4.0);
    const double nearest_m = range_m / std::sqrt(1e5);
    return std::pow(window / std::max(distance_m, nearest_m), 2.0);
}

double cone_falloff(double cosine, double cos_outer, double cos_inner) {
    if (cosine <= cos_outer) return 0.0;
    if (cosine >= cos_inner) return 1.0;
    const double inside = (cosine - cos_outer) / (cos_inner - cos_outer);
    return 3.0 * std::pow(inside, 2.0) - 2.0 * std::pow(inside, 3.0);
}

double direct_light(double albedo, double specular, double power, const Vector& n, const Vector& v, const Vector& l,
                    double radiance) {
    const double cosine = product(n, l);
    if (cosine <= 0.0) return 0.0;
    Vector h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
    const double length = std::sqrt(product(h, h));
    for (double& part : h) part /= length;
    const double highlight = (power + 2.0) / 8.0 * blinn_lobe(n, h, power);
    return (albedo + fresnel_schlick(specular, product(l, h)) * highlight) * cosine * radiance;
}

}  // namespace halfframe::reference
