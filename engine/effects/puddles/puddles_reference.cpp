// Lagarde's accumulation, and mirrors of 2 %, in double.
#include "engine/effects/puddles/puddles_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halfframe::reference {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

}  // namespace

double water_accumulation(double painted, double height, double level, double slope_rad) {
    const double in_hollows = std::clamp((level - painted) / 0.4, 0.0, 1.0);
    const double in_cracks = std::min(level, 1.0 - height);
    const double steepest = std::cos(radians(25.0)), gentlest = std::cos(radians(10.0));
    const double stays = std::clamp((std::cos(slope_rad) - steepest) / (gentlest - steepest), 0.0, 1.0);
    return std::max(in_cracks, in_hollows) * stays;
}

double specular_under_water(double specular, double share) { return specular * (1.0 - share) + 0.02 * share; }

double smoothness_under_water(double smoothness, double share) { return 1.0 - (1.0 - smoothness) * (1.0 - share); }

std::array<double, 3> normal_under_water(const std::array<double, 3>& ground, const std::array<double, 3>& water,
                                         double share) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < 3; ++i) sum[i] = ground[i] * (1.0 - share) + water[i] * share;
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    for (double& component : sum) component /= length;
    return sum;
}

}  // namespace halfframe::reference
