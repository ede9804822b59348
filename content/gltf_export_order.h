// In which order a scene's things stand in an exported file, so that it loads with surfaces, cameras and lights in theirs.
#pragma once

#include <vector>

#include "engine/frame/scene.h"

namespace halfframe::content {

/// One thing at the root of the file. Exactly one index is set.
struct ExportRoot {
    int surface = -1;  ///< stands still, or is carried by its skin alone
    int camera = -1;   ///< stands still
    int light = -1;    ///< stands still
    int node = -1;     ///< what moves, from its topmost node down, or a node that stands and carries morph weights
    auto operator<=>(const ExportRoot&) const = default;
};

/// What of Scene::nodes moves: animated nodes, joints, and all below them. As the loader decides.
[[nodiscard]] std::vector<bool> nodes_that_move(const Scene& scene);

/// The node that carries a surface in the file; -1: it stands at the root.
[[nodiscard]] int carrying_node(const Scene& scene, const std::vector<bool>& moves, const Surface& surface);

/// Every surface, camera, light and moving node is in exactly one of the roots, or below it.
[[nodiscard]] std::vector<ExportRoot> export_order(const Scene& scene, const std::vector<bool>& moves);

}  // namespace halfframe::content
