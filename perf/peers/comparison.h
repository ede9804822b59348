// The arithmetic of a comparison: what is drawn when, which driver counts, what the samples say. No process, no GL.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "engine/frame/image.h"

namespace halfframe::peers {

/// Median and quartiles.
struct Spread {
    double median = 0.0;
    double low = 0.0;   ///< 25th percentile
    double high = 0.0;  ///< 75th percentile
};
/// Quantiles between the two nearest values are interpolated. No values: Mistake.
[[nodiscard]] Spread spread(std::vector<double> values);
/// Spread of a[i] / b[i]: both were measured in round i, so what slows a whole round down cancels.
[[nodiscard]] Spread ratio(const std::vector<double>& a, const std::vector<double>& b);

/// Who draws first, second, ... in `round`: everybody once; every round turns the order of the one before round, and
/// every second one starts one later, so that nobody always follows the same neighbour.
[[nodiscard]] std::vector<int> order_of_round(int count, int round);

/// Frames that fill `batch_ms` at `frame_ms` each; 2 to 400.
[[nodiscard]] int frames_for(double frame_ms, double batch_ms);

/// Why times of this driver cannot be compared, as a sentence; nothing when it is llvmpipe with this many vector bits.
[[nodiscard]] std::optional<std::string> refused_driver(std::string_view peer, std::string_view driver);

/// Which pixels show something else than `background` (display value), by more than 8-bit rounding.
[[nodiscard]] std::vector<bool> cover(const Picture& picture, const glm::vec3& background);
[[nodiscard]] double fraction(const std::vector<bool>& mask);
/// Pixels of both over pixels of either, 0..1; 0 when both are empty.
[[nodiscard]] double overlap(const std::vector<bool>& a, const std::vector<bool>& b);
/// Mean of the three channels over the covered pixels, display value 0..1.
[[nodiscard]] double mean_brightness(const Picture& picture, const std::vector<bool>& mask);

/// What halfframe is to reach [ms]: `share` of the peer's time, or one and a half floors where that is more.
struct Target {
    double ms = 0.0;
    bool by_floor = false;
};
[[nodiscard]] Target target(double peer_ms, double share, double floor_ms);

/// Linear light to sRGB, for a peer that leaves its encoding to post-processing; alpha stays.
void encode_srgb(Picture& picture);
/// Row 0 becomes the last.
void flip(Picture& picture);

}  // namespace halfframe::peers
