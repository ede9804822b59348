// Products of every texel, and the factor found again from two of them.
#include "content/environment/environment_strength.h"

#include <cmath>

namespace halfframe::content {
namespace {

bool is_product(const EnvironmentMap& original, const EnvironmentMap& map, float strength) {
    for (std::size_t i = 0; i < original.irradiance.size(); ++i) {
        if (original.irradiance[i] * strength != map.irradiance[i]) return false;
    }
    for (std::size_t level = 0; level < original.levels.size(); ++level) {
        for (std::size_t i = 0; i < original.levels[level].size(); ++i) {
            if (original.levels[level][i] * strength != map.levels[level][i]) return false;
        }
    }
    return true;
}

}  // namespace

void multiply(EnvironmentMap& map, float strength) {
    for (auto& level : map.levels) {
        for (glm::vec3& texel : level) texel *= strength;
    }
    for (glm::vec3& term : map.irradiance) term *= strength;
}

std::optional<float> strength_between(const EnvironmentMap& original, const EnvironmentMap& map) {
    if (original.levels.size() != map.levels.size()) return std::nullopt;
    for (std::size_t level = 0; level < map.levels.size(); ++level) {
        if (original.levels[level].size() != map.levels[level].size()) return std::nullopt;
    }
    const float quotient = map.irradiance[0].g / original.irradiance[0].g;
    if (!(quotient >= 0.0f) || !std::isfinite(quotient)) return std::nullopt;
    // A quotient of two rounded numbers may be a few steps off the factor: a product has a relative error of 2^-24.
    float candidate = quotient;
    for (int i = 0; i < 4; ++i) candidate = std::nextafter(candidate, 0.0f);
    for (int i = 0; i < 9; ++i) {
        if (is_product(original, map, candidate)) return candidate;
        candidate = std::nextafter(candidate, 1e30f);
    }
    return std::nullopt;
}

}  // namespace halfframe::content
