// Direct light in double, as its sources define it.
#include "engine/effects/surface/surface_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halfframe::reference {
namespace {

double product(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Reflectance that rises from `normal` to `grazing`.
double schlick(double normal, double grazing, double cosine) {
    return normal + (grazing - normal) * std::pow(1.0 - std::clamp(cosine, 0.0, 1.0), 5.0);
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector normalized(const Vector& a) {
    const double length = std::sqrt(product(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
}

/// Rings of a midpoint sum over the sphere: a third of the lobe's width in light directions, 2 / sqrt(power) where
/// light and view are near the normal, narrower by their cosine elsewhere.
int rings_of(double radius_rad, double power, double cosine) {
    const double width_rad = 2.0 / std::sqrt(power) * std::max(cosine, 0.1);
    return std::max(8, static_cast<int>(std::ceil(3.0 * radius_rad / width_rad)));
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

double area_power(double power, double ratio) {
    const double u = power * ratio * ratio / 8.0;
    return u > 0.0 ? power * -std::expm1(-u) / u : power;
}

double sphere_light(double albedo, double specular, double power, const Vector& n, const Vector& v, const Vector& l,
                    double radiance, double ratio) {
    if (ratio <= 0.0) return direct_light(albedo, specular, power, n, v, l, radiance);
    const double radius_rad = std::asin(std::min(ratio, 1.0));
    const Vector across = normalized(cross(l, std::fabs(l[0]) < 0.6 ? Vector{1.0, 0.0, 0.0} : Vector{0.0, 1.0, 0.0}));
    const Vector third = cross(l, across);
    const Vector h = normalized({l[0] + v[0], l[1] + v[1], l[2] + v[2]});
    const int rings = rings_of(radius_rad, power, product(l, h));
    double sum = 0.0, weights = 0.0;
    for (int ring = 0; ring < rings; ++ring) {
        const double angle_rad = (ring + 0.5) / rings * radius_rad;
        const int spokes = std::max(12, static_cast<int>(std::ceil(2.0 * std::numbers::pi * (ring + 1))));
        const double weight = std::sin(angle_rad) / spokes;  // proportional to the solid angle
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double turn_rad = 2.0 * std::numbers::pi * (spoke + 0.5) / spokes;
            const double a = std::sin(angle_rad) * std::cos(turn_rad), b = std::sin(angle_rad) * std::sin(turn_rad);
            Vector from{};
            for (std::size_t s = 0; s < 3; ++s) from[s] = std::cos(angle_rad) * l[s] + a * across[s] + b * third[s];
            sum += weight * direct_light(albedo, specular, power, n, v, from, 1.0);
            weights += weight * std::cos(angle_rad);
        }
    }
    // A surface that faces the sphere gets pi * radiance, whatever the sphere's size.
    return radiance * sum / weights;
}

}  // namespace halfframe::reference
