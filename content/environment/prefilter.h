// Radiance smoothed by lobes of a cosine's power: the levels of an EnvironmentMap.
#pragma once

#include <functional>
#include <vector>

#include "content/environment/light_taps.h"
#include "engine/frame/scene.h"

namespace halfframe::content {

/// Radiance about `axis` (unit), weighted by max(axis.l, 0)^power. Weights under a millionth of the largest count as
/// none.
class Lobe {
public:
    explicit Lobe(double power);
    [[nodiscard]] double power() const { return power_; }
    /// The groups that reach into any lobe whose axis is within `spread_rad` of `axis`.
    [[nodiscard]] std::vector<TapGroup> groups_near(const std::vector<TapGroup>& groups, const glm::dvec3& axis,
                                                    double spread_rad) const;
    [[nodiscard]] glm::dvec3 radiance(const LightTaps& light, const std::vector<TapGroup>& groups,
                                      const glm::dvec3& axis) const;

private:
    double power_;
    double lowest_cosine_;
    double cone_rad_;
    double steps_per_cosine_;
    std::vector<double> weights_;  ///< of cosines from lowest_cosine_ to 1, in equal steps
};

/// The same light in two finenesses.
struct Light {
    LightTaps fine;    ///< kFineTaps
    LightTaps coarse;  ///< kCoarseTaps
};

/// Levels and powers of `map`, whose size is set. The same numbers whatever the count of threads.
void prefilter(const Light& light, int threads, const std::function<void(double)>& progress, EnvironmentMap& map);

}  // namespace halfframe::content
