// The over operator in double, as its source defines it: what the sorted pass is measured against. Shares no code with
// it.
#pragma once

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

}  // namespace halfframe::reference
