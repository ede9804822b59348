// Which lobe each level of the cube is smoothed with.
//
// Smoothness s means the Blinn power 2^(10 s + 1), 2..2048 (the talk). The first N = log2(size) - 2 levels have
// s = 1, ..., 0 in equal steps, so that a shader finds its level as lod = (1 - s) (N - 1). With the default of 128
// texels a side N is 5: 2048, 362, 64, 11.3 and 2 on 128, 64, 32, 16 and 8 texels. As many texels lie across the half
// height of the first lobe (6 degrees, 7 to 9 texels) as of the last (104 degrees, 8 to 9 texels). One level more would
// put the power 2 on 4 x 4 texels, and the edges of the cube then show as creases on rough metal; two would put it on
// the 2 x 2 corners. Three levels follow that only hardware which chooses levels by itself can reach: 4 x 4 and 2 x 2
// with power 2 again, and one texel, the mean over all directions.
#pragma once

#include <vector>

namespace halfframe::content {

/// Of Blinn's (n.h)^power, by level; 0 for the last one, the mean.
[[nodiscard]] std::vector<double> blinn_powers(int size);

/// N - 1: the level of smoothness 0, for cubes of 16 texels a side or more.
[[nodiscard]] int roughest_level(int size);

/// Power q of the lobe (r.l)^q about the mirror direction r that a Blinn highlight (n.h)^power makes of a small light,
/// the factor n.l of the light's irradiance included. Direct light has both, and the same lamp in the environment must
/// give the same highlight. The angle r to l is twice n to h, hence power / 4 for narrow lobes; the fit for wide ones
/// is that of the public CubeMapGen; and n.l is one power more, because on prefiltering n = r.
[[nodiscard]] double phong_power(double blinn_power);

}  // namespace halfframe::content
