// How shaders are told to make texture coordinates (shaders_es/common/uv_mapping.glsl).
#pragma once

#include <array>
#include <cmath>

#include "engine/frame/scene.h"

namespace halfframe {

/// The rows of a 2 x 2 matrix, and an offset in xy: uv' = matrix uv + offset.
using UvRows = std::array<glm::vec4, 2>;

[[nodiscard]] inline UvRows rows_of(const UvMapping& mapping) {
    const float cosine = std::cos(mapping.rotation_rad);
    const float sine = std::sin(mapping.rotation_rad);
    const glm::vec2 scale = mapping.scale;
    // v grows downwards in the picture, so a turn that is counter-clockwise to the eye is (c, s; -s, c).
    return {glm::vec4(cosine * scale.x, sine * scale.y, -sine * scale.x, cosine * scale.y),
            glm::vec4(mapping.offset, 0.0f, 0.0f)};
}

/// True where the coordinates are those of the mesh's set, unchanged.
[[nodiscard]] inline bool is_plain(const UvMapping& mapping) { return mapping == UvMapping{.set = mapping.set}; }

}  // namespace halfframe
