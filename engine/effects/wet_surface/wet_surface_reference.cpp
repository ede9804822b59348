// The talk's wet surfaces, and how they dry, in double.
#include "engine/effects/wet_surface/wet_surface_reference.h"

#include <algorithm>
#include <cmath>

namespace halfframe::reference {
namespace {

double lerp(double from, double to, double share) { return (1.0 - share) * from + share * to; }

/// How metallic a mean specular is: 0 up to 0.4, 1 from 0.6 on, Hermite's cubic between.
double metalness(const std::array<double, 3>& specular) {
    const double mean = (specular[0] + specular[1] + specular[2]) / 3.0;
    if (mean <= 0.4) return 0.0;
    if (mean >= 0.6) return 1.0;
    const double t = (mean - 0.4) / 0.2;
    return 3.0 * std::pow(t, 2.0) - 2.0 * std::pow(t, 3.0);
}

/// A logistic curve of slope `steepness` about `middle`, scaled so that it runs from 1 at x = 0 to 0 at x = 1.
double falling_logistic(double x, double middle, double steepness) {
    if (x <= 0.0) return 1.0;
    if (x >= 1.0) return 0.0;
    const auto logistic = [&](double at) { return 1.0 / (1.0 + std::exp(steepness * (at - middle))); };
    return (logistic(x) - logistic(1.0)) / (logistic(0.0) - logistic(1.0));
}

}  // namespace

double porosity(const std::array<double, 3>& specular, double smoothness) {
    const double rough = std::clamp(((1.0 - smoothness) - 0.5) / 0.4, 0.0, 1.0);
    return (1.0 - metalness(specular)) * rough;
}

WetMaterial wet_material(const DryMaterial& dry, double wetness) { return wet_material(dry, wetness, wetness); }

WetMaterial wet_material(const DryMaterial& dry, double diffuse_wetness, double specular_wetness) {
    const double factor = lerp(1.0, 0.2, porosity(dry.specular, dry.smoothness));
    WetMaterial wet = dry;
    for (double& channel : wet.albedo) channel *= lerp(1.0, factor, diffuse_wetness);
    wet.smoothness = lerp(1.0, dry.smoothness, lerp(1.0, factor, 0.5 * specular_wetness));
    return wet;
}

double diffuse_water_left(double since_s, double dry_s) { return falling_logistic(since_s / dry_s, 0.5, 10.0); }

double specular_water_left(double since_s, double dry_s) { return falling_logistic(since_s / dry_s, 0.25, 10.0); }

}  // namespace halfframe::reference
