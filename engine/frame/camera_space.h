// Matrices relative to the eye, made in double: a scene 10 km from the origin draws as it does at the origin.
#pragma once

#include "engine/frame/scene.h"
#include "engine/frame/vertex_storage.h"

namespace halfframe {

/// World axes, origin at the eye [m].
[[nodiscard]] glm::mat4 eye_from_local(const View& view, const glm::mat4& world_from_local);
[[nodiscard]] glm::mat4 clip_from_local(const View& view, const glm::mat4& world_from_local);
/// What the matrices of all places of one view share: worked out once a frame.
struct ViewSpace {
    glm::dmat4 clip_from_eye{1.0};  ///< world axes, origin at the eye
    glm::dvec3 eye{0.0};            ///< [m] world
};
[[nodiscard]] ViewSpace view_space(const View& view);
/// Positions of a mesh as stored, taken to the eye and to clip coordinates. Both in double; a shader gets them rounded.
[[nodiscard]] glm::dmat4 eye_from_stored(const ViewSpace& space, const glm::mat4& world_from_local,
                                         const StoredPositions& stored);
/// Rounded the same way for whoever draws the same mesh, so that depths are equal to the bit.
[[nodiscard]] glm::mat4 clip_from_stored(const ViewSpace& space, const glm::dmat4& eye_from_stored_matrix);

/// Inverse transpose of the upper 3x3, for directions that stand on a surface; the identity if that is singular.
[[nodiscard]] glm::mat4 normal_from_local(const glm::mat4& world_from_local);

/// True when the whole box is outside one plane of the view. May say false for a box that is just outside.
[[nodiscard]] bool outside_view(const Box& local, const glm::mat4& clip_from_local_matrix);
/// Share of the picture that the screen rectangle of the box covers, 0..1; 1 when the box reaches behind the eye.
[[nodiscard]] double screen_fraction(const Box& local, const glm::mat4& clip_from_local_matrix);

}  // namespace halfframe
