// All light of an environment as a hundred thousand small sources: what every level is summed from.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "content/environment/equirectangular.h"

namespace halfframe::content {

/// The light that falls through one texel of a fine cube. `direction` is not the texel's centre but the mean direction
/// of that light, so that a sun in the corner of a texel stays there: without it the narrowest lobe moves by a third of
/// a degree, 14 % on its flank.
struct LightTap {
    glm::dvec3 direction{0.0};  ///< unit
    double solid_angle = 0.0;   ///< [sr]
    glm::dvec3 radiance{0.0};   ///< mean over the texel
};

/// Neighbours on a face, kept together so that whole groups far from a lobe are passed over.
struct TapGroup {
    glm::dvec3 axis{0.0, 0.0, 1.0};  ///< unit
    double radius_rad = 0.0;         ///< no tap is further from `axis`
    std::size_t first = 0;           ///< in LightTaps::taps
    std::size_t count = 0;
};

struct LightTaps {
    std::vector<LightTap> taps;
    std::vector<TapGroup> groups;
};

/// Texels a side of the cube of taps that narrow lobes are summed from: 0.4 to 0.9 degrees, a seventh of the narrowest
/// lobe (6 degrees).
inline constexpr int kFineTaps = 128;
/// For lobes of a power under 50 (19 degrees and wider): a quarter of the work. Measured difference: 5e-4 of the value.
inline constexpr int kCoarseTaps = 64;

/// Every pixel is a piece of the sphere with constant radiance; it is cut into pieces smaller than a texel of the cube,
/// and each is added to the texel it lies in. Nothing is interpolated or lost: the sum of radiance times solid angle is
/// that of the picture.
[[nodiscard]] LightTaps light_taps(const Equirectangular& picture, int side);

/// Mean radiance over all directions.
[[nodiscard]] glm::dvec3 mean_radiance(const LightTaps& light);

}  // namespace halfframe::content
