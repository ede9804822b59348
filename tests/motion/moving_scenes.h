// Scenes that move, made by code, with a known answer.
#pragma once

#include "engine/frame/scene.h"

namespace halfframe::tests {

/// A strip 0.5 m wide and 2 m high with a row of vertices every 0.25 m, facing +Z. Two bones: the lower half stands,
/// the upper turns about the z axis at (0, 1, 0), by 90 degrees in the one second of its animation "bend". Rows between
/// 0.75 and 1.25 m follow both. `away`: where the lower bone stands [m].
[[nodiscard]] Scene two_bones(const glm::vec3& away = glm::vec3(0.0f));

/// The strip on `joints` bones that all stand still but the last, which does as above; each bone carries a row.
[[nodiscard]] Scene many_bones(int joints);

/// A square of 1 m, facing +Z, with two morph targets on one node: the first lifts it by 1 m, the second makes it twice
/// as wide. Animation "grow": weights (0, 0) at 0 s to (1, 1) at 1 s.
[[nodiscard]] Scene morphing_square();

/// `two_bones` and `morphing_square` over a ground, under a sun.
[[nodiscard]] Scene moving_scene();

}  // namespace halfframe::tests
