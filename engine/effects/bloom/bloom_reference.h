// What bloom is measured against, in double: what a light gives, and where it goes. Shares no code with the shaders.
#pragma once

#include <array>
#include <vector>

namespace halfframe::reference {

/// What a pixel of linear light, any size and sign, gives to the glow: S. Lagarde and L. Harduin, GDC Europe 2013, let
/// values above display code 214 bloom, a light of 1. Ours: the excess of the brightest channel, in the pixel's hue, of
/// light up to 8.
[[nodiscard]] std::array<double, 3> blooming_light(const std::array<double, 3>& light);

/// Share of the glow of one pixel that lands on the pixel `right` and `up` of it: a Gaussian of 12 pixels, integrated
/// over the pixel.
[[nodiscard]] double glow_share(int right, int up);

/// Weight of tap `tap` of a blur with `radius` taps each side whose weights follow a Gaussian of `sigma` taps and sum
/// to 1.
[[nodiscard]] double tap_weight(double tap, int radius, double sigma);

/// Of a row of weights round its middle: the mean square distance, in taps.
[[nodiscard]] double spread(const std::vector<double>& weights);

}  // namespace halfframe::reference
