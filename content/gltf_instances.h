// EXT_mesh_gpu_instancing: one mesh at many places.
#pragma once

#include <optional>
#include <vector>

#include "content/gltf_model.h"

namespace halfframe::content {

/// Surfaces of one scene: each is a draw call, and a frame of this many is past every budget.
inline constexpr std::size_t kMostSurfaces = 1u << 17;

/// Where the node's instances stand, to the node; nothing where it has none. Damaged values: Error(input).
[[nodiscard]] std::optional<std::vector<glm::mat4>> instances_of_node(const GltfDocument& document,
                                                                      const GltfModel& gltf, std::size_t node);

}  // namespace halfframe::content
