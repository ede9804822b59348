// The arithmetic of skins and morph targets that needs no device: palettes, boxes, and both carried out on the CPU.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe {

/// A joint index and a weight a bone, four a vertex, as the device has them. The weights of a vertex sum to 255.
struct SkinVertex {
    std::array<std::uint16_t, 4> joints{};  ///< places in SkinnedMesh::joints
    std::array<std::uint8_t, 4> weights{};  ///< unorm
};

/// What is known of a mesh with joints before it moves.
struct SkinnedMesh {
    std::vector<int> joints;  ///< of Skin::joints: those that carry a vertex, rising. A palette has one entry each.
    std::vector<Box> boxes;   ///< of the vertices that each of them carries, as the mesh has them [m]
    std::vector<SkinVertex> vertices;
};
[[nodiscard]] SkinnedMesh skinned_mesh(const Mesh& mesh);

/// Four weights as bytes that sum to exactly 255, each less than 1/255 from where it was.
[[nodiscard]] std::array<std::uint8_t, 4> unorm8_weights(const glm::vec4& weights);

/// x, y and z of a place as rows of its matrix: dot(row, vec4(at, 1)).
using JointRows = std::array<glm::vec4, 3>;

/// One entry for each of `joints`: from the mesh, to places relative to `surface`. Made in double.
void write_palette(const Scene& scene, const Surface& surface, std::span<const int> joints,
                   std::span<const glm::dmat4> world_from_node, std::span<JointRows> palette);

/// A box that holds the mesh in every pose of `palette`: each vertex is a mean of where its joints would take it.
/// `grown` is what morph targets may add on each side [m].
[[nodiscard]] Box skinned_box(const SkinnedMesh& skinned, std::span<const JointRows> palette, const Box& grown);

/// Position, normal and tangent of a vertex; xyz of the tangent.
struct MovedVertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    glm::vec4 tangent{0.0f};
};

/// Vertex `index` of `mesh` with its morph targets at `weights`. Directions are unit.
[[nodiscard]] MovedVertex morphed(const Mesh& mesh, std::size_t index, std::span<const float> weights);
/// `vertex` carried by its joints, as common/mesh_vertex.glsl does it.
[[nodiscard]] MovedVertex skinned(const MovedVertex& vertex, const SkinVertex& joints,
                                  std::span<const JointRows> palette);

/// What targets at `weights` add to a position at least and at most, on each axis [m].
[[nodiscard]] Box morph_reach(std::span<const Box> target_boxes, std::span<const float> weights);
/// Least and greatest of what each target adds to a position, 0 among them [m].
[[nodiscard]] std::vector<Box> target_boxes(const Mesh& mesh);

/// The smallest box of surface `index` as its nodes stand, relative to its world_from_local. Moves every vertex: for
/// planning, not for frames.
[[nodiscard]] Box posed_box(const Scene& scene, int index);
/// True when the vertices of the surface move against each other: a skin, or morph targets.
[[nodiscard]] bool changes_shape(const Scene& scene, const Surface& surface);

}  // namespace halfframe
