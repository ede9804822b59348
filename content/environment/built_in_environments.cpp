// The list of environments that are drawn by code, and the drawing.
#include "content/environment/built_in_environments.h"

#include <cmath>
#include <numbers>

namespace halfframe::content {

const std::vector<BuiltInEnvironment>& built_in_environments() {
    static const std::vector<BuiltInEnvironment> kEnvironments{
        {"night_sky", "a city at night: blue-grey, a glow at the horizon, a moon, signs in red, purple and blue",
         night_sky_radiance},
        {"studio", "soft boxes where the studio rig has its lights: for metals", studio_radiance},
    };
    return kEnvironments;
}

Equirectangular drawn(const BuiltInEnvironment& environment) {
    constexpr int kHeight = 512;
    constexpr int kSamples = 2;  // a side of a pixel
    constexpr double kPi = std::numbers::pi;
    Equirectangular picture{2 * kHeight, kHeight, {}};
    picture.pixels.reserve(static_cast<std::size_t>(picture.width) * kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            glm::dvec3 sum(0.0);
            for (int sample = 0; sample < kSamples * kSamples; ++sample) {
                const double row = y + (sample / kSamples + 0.5) / kSamples;
                const double column = x + (sample % kSamples + 0.5) / kSamples;
                const double from_zenith = kPi * row / kHeight;
                const double azimuth = 2.0 * kPi * column / picture.width;  // 0 at +Z, a quarter at -X
                sum += environment.radiance({-std::sin(from_zenith) * std::sin(azimuth), std::cos(from_zenith),
                                             std::sin(from_zenith) * std::cos(azimuth)});
            }
            picture.pixels.emplace_back(sum / static_cast<double>(kSamples * kSamples));
        }
    }
    return picture;
}

}  // namespace halfframe::content
