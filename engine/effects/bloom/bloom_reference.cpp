// What blooms and where it goes, in double.
#include "engine/effects/bloom/bloom_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halfframe::reference {
namespace {

constexpr double kThreshold = 1.0;
constexpr double kWhite = 8.0;
constexpr double kSigma = 12.0;  // pixels

/// Part of a Gaussian that lies in the pixel `distance` pixels from its centre.
double line_share(int distance) {
    const double scale = 1.0 / (kSigma * std::numbers::sqrt2);
    return 0.5 * (std::erf((distance + 0.5) * scale) - std::erf((distance - 0.5) * scale));
}

}  // namespace

std::array<double, 3> blooming_light(const std::array<double, 3>& light) {
    std::array<double, 3> result{};
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        result[i] = std::isnan(light[i]) ? 0.0 : std::clamp(light[i], 0.0, kWhite);
        most = std::max(most, result[i]);
    }
    // Of a light m times its hue, m - 1 is left: the hue's own share of it stays.
    const double kept = most > kThreshold ? 1.0 - kThreshold / most : 0.0;
    for (double& channel : result) channel *= kept;
    return result;
}

double glow_share(int right, int up) { return line_share(right) * line_share(up); }

double tap_weight(double tap, int radius, double sigma) {
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
    return std::exp(-0.5 * tap * tap / (sigma * sigma)) / sum;
}

double spread(const std::vector<double>& weights) {
    const double middle = 0.5 * static_cast<double>(weights.size() - 1);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double distance = static_cast<double>(i) - middle;
        sum += weights[i];
        squares += weights[i] * distance * distance;
    }
    return squares / sum;
}

}  // namespace halfframe::reference
