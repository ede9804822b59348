// Poses and skinning in double, as glTF 2.0 words them, sharing no function with the engine: quaternions turn vectors
// by multiplication, slerp is a power of a quaternion, the cubic is evaluated as a Bezier curve, weights are plain
// sums.
#pragma once

#include <array>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe::tests {

using Triple = std::array<double, 3>;
using Quadruple = std::array<double, 4>;  ///< a quaternion is x y z w

/// An affine transform: images of the three axes, and of the origin.
struct Frame {
    std::array<Triple, 3> axes{Triple{1, 0, 0}, Triple{0, 1, 0}, Triple{0, 0, 1}};
    Triple origin{};
};
[[nodiscard]] Triple applied(const Frame& frame, const Triple& at);
[[nodiscard]] Frame after(const Frame& outer, const Frame& inner);

/// Value of a channel at a time, all components.
[[nodiscard]] std::vector<double> reference_sample(const AnimationChannel& channel, double time_s);

/// World frames of all nodes with an animation of the scene at a time; -1: as they stand.
[[nodiscard]] std::vector<Frame> reference_nodes(const Scene& scene, int animation, double time_s);

/// World position of a vertex of a skinned surface. `weights` sum to 1.
[[nodiscard]] Triple reference_skinned(const Scene& scene, const Surface& surface, const std::vector<Frame>& nodes,
                                       const Triple& at, const std::array<int, 4>& joints, const Quadruple& weights);

}  // namespace halfframe::tests
