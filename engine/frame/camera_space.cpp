// Matrices relative to the eye, and what is in view.
#include "engine/frame/camera_space.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfframe {

namespace {

glm::dmat4 precise_eye_from_local(const View& view, const glm::mat4& world_from_local) {
    glm::dmat4 matrix(world_from_local);
    matrix[3] -= glm::dvec4(glm::dvec3(view.eye), 0.0) * matrix[3].w;
    return matrix;
}

std::array<glm::vec4, 8> clip_corners(const Box& box, const glm::mat4& clip_from_local_matrix) {
    std::array<glm::vec4, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec3 corner{i & 1u ? box.high.x : box.low.x, i & 2u ? box.high.y : box.low.y,
                               i & 4u ? box.high.z : box.low.z};
        corners[i] = clip_from_local_matrix * glm::vec4(corner, 1.0f);
    }
    return corners;
}

}  // namespace

glm::mat4 eye_from_local(const View& view, const glm::mat4& world_from_local) {
    return glm::mat4(precise_eye_from_local(view, world_from_local));
}

glm::mat4 clip_from_local(const View& view, const glm::mat4& world_from_local) {
    glm::dmat4 view_from_eye(view.view_from_world);
    view_from_eye[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);  // the eye is the origin already
    return glm::mat4(glm::dmat4(view.clip_from_view) * view_from_eye * precise_eye_from_local(view, world_from_local));
}

glm::mat4 normal_from_local(const glm::mat4& world_from_local) {
    const glm::dmat3 upper(world_from_local);
    if (std::abs(glm::determinant(upper)) < 1e-30) return glm::mat4(1.0f);
    return glm::mat4(glm::mat3(glm::transpose(glm::inverse(upper))));
}

ViewSpace view_space(const View& view) {
    glm::dmat4 view_from_eye(view.view_from_world);
    view_from_eye[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);  // the eye is the origin already
    return {glm::dmat4(view.clip_from_view) * view_from_eye, glm::dvec3(view.eye)};
}

glm::dmat4 eye_from_stored(const ViewSpace& space, const glm::mat4& world_from_local, const StoredPositions& stored) {
    glm::dmat4 matrix(world_from_local);
    matrix[3] -= glm::dvec4(space.eye, 0.0) * matrix[3].w;
    matrix[3] += matrix[0] * stored.origin.x + matrix[1] * stored.origin.y + matrix[2] * stored.origin.z;
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= stored.step[axis];
    return matrix;
}

glm::mat4 clip_from_stored(const ViewSpace& space, const glm::dmat4& eye_from_stored_matrix) {
    return glm::mat4(space.clip_from_eye * eye_from_stored_matrix);
}

// A box is outside a plane when its centre is farther out than its corners reach: the sum of what each axis adds.
// Four lanes where three are needed, so that a compiler does the planes of one side at once.
bool outside_view(const Box& local, const glm::mat4& clip_from_local_matrix) {
    if (local.empty()) return true;
    const glm::vec3 half = (local.high - local.low) * 0.5f;
    const glm::vec4 centre = clip_from_local_matrix * glm::vec4((local.low + local.high) * 0.5f, 1.0f);
    std::array<float, 4> above{}, below{};  // how far the reach exceeds the way out, on either side
    for (int lane = 0; lane < 4; ++lane) {
        const auto at = static_cast<std::size_t>(lane);
        float reach_above = 0.0f, reach_below = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            const float along = clip_from_local_matrix[axis][lane] * half[axis];
            const float along_w = clip_from_local_matrix[axis].w * half[axis];
            reach_above += std::abs(along_w + along);
            reach_below += std::abs(along_w - along);
        }
        above[at] = centre.w + centre[lane] + reach_above;
        below[at] = centre.w - centre[lane] + reach_below;
    }
    for (std::size_t lane = 0; lane < 3; ++lane) {
        if (above[lane] < 0.0f || below[lane] < 0.0f) return true;
    }
    return false;
}

double screen_fraction(const Box& local, const glm::mat4& clip_from_local_matrix) {
    if (outside_view(local, clip_from_local_matrix)) return 0.0;
    glm::dvec2 low{1.0}, high{-1.0};
    for (const glm::vec4& corner : clip_corners(local, clip_from_local_matrix)) {
        if (corner.w <= 1e-6f) return 1.0;
        const glm::dvec2 at{corner.x / corner.w, corner.y / corner.w};
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    low = glm::clamp(low, -1.0, 1.0);
    high = glm::clamp(high, -1.0, 1.0);
    return (high.x - low.x) * (high.y - low.y) * 0.25;
}

}  // namespace halfframe
