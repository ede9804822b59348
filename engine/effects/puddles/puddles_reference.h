// Standing water as its source defines it, in double: what puddles.glsl is measured against. Shares no code with it.
#pragma once

#include <array>

namespace halfframe::reference {

/// Share of open water 0..1 (S. Lagarde, Water drop 3b, 2013): the greater of what fills cracks of the height map and
/// of what fills painted hollows, where `painted` is 1 on level ground and 0 in the deepest hollow and water rises over
/// 0.4 of that range; times a ramp in the cosine of the slope, 1 up to 10 degrees and 0 from 25 on (ours).
[[nodiscard]] double water_accumulation(double painted, double height, double level, double slope_rad);

/// Towards water's reflectance of 0.02 by `share`; and a smoothness towards 1.
[[nodiscard]] double specular_under_water(double specular, double share);
[[nodiscard]] double smoothness_under_water(double smoothness, double share);

/// The unit vector along ground (1 - share) + water share.
[[nodiscard]] std::array<double, 3> normal_under_water(const std::array<double, 3>& ground,
                                                       const std::array<double, 3>& water, double share);

}  // namespace halfframe::reference
