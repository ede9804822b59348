// The over operator in double, as its source defines it: what the sorted pass is measured against. Shares no code with
// it.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace halfframe::reference {

/// A layer that blends.
struct BlendedLayer {
    glm::dvec3 light{0.0};  ///< its own, not multiplied by alpha
    double alpha = 1.0;     ///< 0..1
    double distance_m = 0.0;
};

/// Light seen through `layers`, in any order, before `behind`. T. Porter and T. Duff, "Compositing Digital Images",
/// SIGGRAPH 1984. Near to far, as a product of what lets through: the pass blends far to near.
[[nodiscard]] glm::dvec3 seen_through(const std::vector<BlendedLayer>& layers, const glm::dvec3& behind);

/// What scene_color holds of light, and blends: light itself, its root (RGB10_A2), or the display value (RGBA8).
enum class Held : std::uint8_t { light, root, display };

/// Display values 0..1 of `layers` before `behind` when each is blended as `held`. Light 0..8.
[[nodiscard]] glm::dvec3 shown_through(const std::vector<BlendedLayer>& layers, const glm::dvec3& behind, Held held);

}  // namespace halfframe::reference
