// Directions of a cube map's texels.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "engine/frame/cube_face.h"

namespace halfframe::content {

/// Number of the texel that a direction falls into, on faces of `size` texels: face * size^2 + row * size + column.
[[nodiscard]] inline int texel_of(const glm::dvec3& direction, int size) {
    const glm::dvec3 a = glm::abs(direction);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const bool negative = direction[axis] < 0.0;
    const double sign = negative ? -1.0 : 1.0;
    const double u = axis == 0 ? -sign * direction.z : axis == 1 ? direction.x : sign * direction.x;
    const double v = axis == 1 ? sign * direction.z : -direction.y;
    const auto index = [&](double t) {
        return std::clamp(static_cast<int>((t / a[axis] * 0.5 + 0.5) * size), 0, size - 1);
    };
    return (2 * axis + (negative ? 1 : 0)) * size * size + index(v) * size + index(u);
}

/// -1..1: where texel `index` of a row of `size` looks for its light. A cube that filters each face alone shows, on an
/// edge, the outermost texels of both faces. So these must look along the edge itself: u' = a u^3 + u with
/// a = s^2 / (s - 1)^3 takes the outermost centres to exactly -1 and 1, and hardly moves those in the middle
/// (the "warp" of the public CubeMapGen). One texel a side has no edge to look along and is not asked for.
[[nodiscard]] inline double warped_centre(int index, int size) {
    if (index == 0) return -1.0;  // exactly, and not but for rounding
    if (index == size - 1) return 1.0;
    const double s = size;
    const double u = 2.0 * (index + 0.5) / s - 1.0;
    return s * s / ((s - 1.0) * (s - 1.0) * (s - 1.0)) * u * u * u + u;
}

}  // namespace halfframe::content
