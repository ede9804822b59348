// Simple shapes as meshes, each with normals, tangents and uv. Fronts face outwards; sizes in metres.
#pragma once

#include "engine/frame/scene.h"

namespace halfframe::content {

/// In the XY plane around the origin, facing +Z. uv run from (0, 0) at the upper left to `uv_repeats` at the lower
/// right. A grid of cells at most `cell_m` wide and high (default: one cell), so that light by vertex has vertices.
[[nodiscard]] Mesh quad(const glm::vec2& size_m, const glm::vec2& uv_repeats = glm::vec2(1.0f), float cell_m = 1e9f);

/// Around the origin, flat sides; every side has uv 0..1.
[[nodiscard]] Mesh box(const glm::vec3& size_m);

/// Around the origin. u goes once around from the back, eastwards seen from outside; v from the top down.
[[nodiscard]] Mesh sphere(float radius_m, int slices = 48, int stacks = 24);

/// Around the origin along Y, with caps.
[[nodiscard]] Mesh cylinder(float radius_m, float height_m, int slices = 32);

}  // namespace halfframe::content
