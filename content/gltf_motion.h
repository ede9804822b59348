// What moves in a glTF document, as Scene has it: joints and weights, morph targets, skins, animations.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "content/gltf_model.h"

namespace halfframe::content {

/// Animated values of all channels together: 4 bytes each, 256 MiB. Channels may share one accessor of a small file.
inline constexpr std::uint64_t kMostAnimatedValues = 64ull << 20;

/// Reads joints, weights and morph targets of a primitive whose positions are read. Of more than four joints a vertex
/// the strongest stay; what that drops is a notice. `place` is the primitive's JSON pointer.
void read_moving_streams(const GltfModel& gltf, const tinygltf::Primitive& primitive, const std::string& place,
                         Mesh& mesh, ReadSoFar& so_far, std::vector<std::string>& notices);

/// Nodes of the document that an animation moves, that are joints of a skin, or that carry morph targets.
struct MovingNodes {
    std::vector<bool> animated;
    std::vector<bool> joint;
    std::vector<bool> morphs;
    [[nodiscard]] bool any(std::size_t node) const { return animated[node] || joint[node] || morphs[node]; }
};
[[nodiscard]] MovingNodes moving_nodes(const JsonPlace& root, const GltfModel& gltf);

/// A node as Scene::nodes has it, without its parent.
[[nodiscard]] Node read_node(const GltfDocument& document, const GltfModel& gltf, std::size_t index);

/// `scene_nodes`: place in Scene::nodes of each node of the document; -1: it is not in the scene.
[[nodiscard]] Skin read_skin(const GltfDocument& document, const GltfModel& gltf, std::size_t skin,
                             std::span<const int> scene_nodes);
[[nodiscard]] std::vector<Animation> read_animations(const GltfDocument& document, const GltfModel& gltf,
                                                     std::span<const int> scene_nodes,
                                                     std::vector<std::string>& notices);

}  // namespace halfframe::content
