// Palettes, boxes, skinning and morphing on the CPU.
#include "engine/frame/skinning.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/frame/pose.h"

namespace halfframe {

namespace {

glm::vec3 unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 1e-20f ? v / length : v;
}

glm::vec3 carried(const JointRows& rows, const glm::vec3& at) {
    const glm::vec4 from(at, 1.0f);
    return {glm::dot(rows[0], from), glm::dot(rows[1], from), glm::dot(rows[2], from)};
}

/// Interval sum: every point of one box plus every point of the other.
Box sum(const Box& a, const Box& b) { return {a.low + b.low, a.high + b.high}; }

std::span<const float> weights_of(const Scene& scene, const Surface& surface) {
    if (surface.node < 0) return {};
    return scene.nodes[static_cast<std::size_t>(surface.node)].morph_weights;
}

}  // namespace

std::array<std::uint8_t, 4> unorm8_weights(const glm::vec4& weights) {
    std::array<std::uint8_t, 4> bytes{};
    std::array<float, 4> lost{};
    int rest = 255;
    for (std::size_t i = 0; i < 4; ++i) {
        const float exact = std::clamp(weights[static_cast<int>(i)], 0.0f, 1.0f) * 255.0f;
        bytes[i] = static_cast<std::uint8_t>(exact);
        lost[i] = exact - static_cast<float>(bytes[i]);
        rest -= bytes[i];
    }
    // What rounding down left over goes where it was taken; weights that never summed to 1 give it to the strongest.
    for (; rest > 0; --rest) {
        const auto most = static_cast<std::size_t>(std::ranges::max_element(lost) - lost.begin());
        const auto strongest = static_cast<std::size_t>(std::ranges::max_element(bytes) - bytes.begin());
        const std::size_t taker = lost[most] > 0.0f ? most : strongest;
        ++bytes[taker];
        lost[taker] = 0.0f;
    }
    for (; rest < 0; ++rest) --*std::ranges::max_element(bytes);
    return bytes;
}

SkinnedMesh skinned_mesh(const Mesh& mesh) {
    expect(mesh.joints.size() == mesh.positions.size() && mesh.weights.size() == mesh.positions.size(),
           "a skinned mesh needs joints and weights at every vertex");
    SkinnedMesh result;
    result.vertices.resize(mesh.positions.size());
    std::size_t highest = 0;
    for (const glm::u16vec4& joints : mesh.joints)
        highest = std::max<std::size_t>({highest, joints.x, joints.y, joints.z, joints.w});
    std::vector<int> place(highest + 1, -1);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        result.vertices[i].weights = unorm8_weights(mesh.weights[i]);
        for (int k = 0; k < 4; ++k) {
            if (result.vertices[i].weights[static_cast<std::size_t>(k)] > 0) place[mesh.joints[i][k]] = 0;
        }
    }
    for (std::size_t joint = 0; joint < place.size(); ++joint) {
        if (place[joint] < 0) continue;
        place[joint] = static_cast<int>(result.joints.size());
        result.joints.push_back(static_cast<int>(joint));
    }
    result.boxes.resize(result.joints.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (result.vertices[i].weights[k] == 0) continue;
            const int at = place[mesh.joints[i][static_cast<int>(k)]];
            result.vertices[i].joints[k] = static_cast<std::uint16_t>(at);
            result.boxes[static_cast<std::size_t>(at)].add(mesh.positions[i]);
        }
    }
    return result;
}

void write_palette(const Scene& scene, const Surface& surface, std::span<const int> joints,
                   std::span<const glm::dmat4> world_from_node, std::span<JointRows> palette) {
    const Skin& skin = scene.skins[static_cast<std::size_t>(surface.skin)];
    const glm::dmat4 local_from_world = glm::inverse(glm::dmat4(surface.world_from_local));
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto joint = static_cast<std::size_t>(joints[i]);
        const glm::dmat4& world_from_joint = world_from_node[static_cast<std::size_t>(skin.joints.at(joint))];
        const glm::dmat4 matrix = local_from_world * world_from_joint * glm::dmat4(skin.joint_from_mesh[joint]);
        for (int row = 0; row < 3; ++row)
            palette[i][static_cast<std::size_t>(row)] =
                glm::vec4(glm::dvec4(matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]));
    }
}

Box skinned_box(const SkinnedMesh& skinned, std::span<const JointRows> palette, const Box& grown) {
    Box box;
    for (std::size_t joint = 0; joint < skinned.boxes.size(); ++joint) {
        const Box from = grown.empty() ? skinned.boxes[joint] : sum(skinned.boxes[joint], grown);
        for (unsigned corner = 0; corner < 8; ++corner) {
            box.add(
                carried(palette[joint], {corner & 1u ? from.high.x : from.low.x, corner & 2u ? from.high.y : from.low.y,
                                         corner & 4u ? from.high.z : from.low.z}));
        }
    }
    return box;
}

MovedVertex morphed(const Mesh& mesh, std::size_t index, std::span<const float> weights) {
    MovedVertex vertex;
    vertex.position = mesh.positions[index];
    if (!mesh.normals.empty()) vertex.normal = mesh.normals[index];
    if (!mesh.tangents.empty()) vertex.tangent = mesh.tangents[index];
    glm::vec3 tangent(vertex.tangent);
    const std::size_t count = std::min(weights.size(), mesh.morph_targets.size());
    for (std::size_t i = 0; i < count; ++i) {
        const MorphTarget& target = mesh.morph_targets[i];
        const float weight = weights[i];
        if (weight == 0.0f) continue;
        if (!target.positions.empty()) vertex.position += weight * target.positions[index];
        if (!target.normals.empty()) vertex.normal += weight * target.normals[index];
        if (!target.tangents.empty()) tangent += weight * target.tangents[index];
    }
    vertex.normal = unit(vertex.normal);
    vertex.tangent = glm::vec4(unit(tangent), vertex.tangent.w);
    return vertex;
}

MovedVertex skinned(const MovedVertex& vertex, const SkinVertex& joints, std::span<const JointRows> palette) {
    JointRows rows{};
    for (std::size_t k = 0; k < 4; ++k) {
        if (joints.weights[k] == 0) continue;
        const float weight = static_cast<float>(joints.weights[k]) / 255.0f;
        for (std::size_t row = 0; row < 3; ++row) rows[row] += weight * palette[joints.joints[k]][row];
    }
    const glm::vec3 x(rows[0]), y(rows[1]), z(rows[2]);
    const glm::vec3 cofactor = glm::cross(y, z);
    const glm::vec3 normal(glm::dot(cofactor, vertex.normal), glm::dot(glm::cross(z, x), vertex.normal),
                           glm::dot(glm::cross(x, y), vertex.normal));
    const glm::vec3 tangent(vertex.tangent);
    const glm::vec3 along(glm::dot(x, tangent), glm::dot(y, tangent), glm::dot(z, tangent));
    return {carried(rows, vertex.position), unit(glm::dot(x, cofactor) < 0.0f ? -normal : normal),
            glm::vec4(unit(along), vertex.tangent.w)};
}

std::vector<Box> target_boxes(const Mesh& mesh) {
    std::vector<Box> boxes;
    for (const MorphTarget& target : mesh.morph_targets) {
        Box box{glm::vec3(0.0f), glm::vec3(0.0f)};
        for (const glm::vec3& position : target.positions) box.add(position);
        boxes.push_back(box);
    }
    return boxes;
}

Box morph_reach(std::span<const Box> boxes, std::span<const float> weights) {
    Box reach{glm::vec3(0.0f), glm::vec3(0.0f)};
    for (std::size_t i = 0; i < std::min(boxes.size(), weights.size()); ++i) {
        const glm::vec3 a = weights[i] * boxes[i].low, b = weights[i] * boxes[i].high;
        reach = sum(reach, {glm::min(a, b), glm::max(a, b)});
    }
    return reach;
}

bool changes_shape(const Scene& scene, const Surface& surface) {
    return surface.skin >= 0 || !scene.meshes[static_cast<std::size_t>(surface.mesh)].morph_targets.empty();
}

Box posed_box(const Scene& scene, int index) {
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(index)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
    if (!changes_shape(scene, surface)) return local_box(mesh);
    SkinnedMesh bones;
    std::vector<JointRows> palette;
    if (surface.skin >= 0) {
        std::vector<glm::dmat4> world_from_node(scene.nodes.size());
        world_from_nodes(scene, world_from_node);
        bones = skinned_mesh(mesh);
        palette.resize(bones.joints.size());
        write_palette(scene, surface, bones.joints, world_from_node, palette);
    }
    const auto add = [&](Box& box, std::size_t vertex) {
        const MovedVertex moved = morphed(mesh, vertex, weights_of(scene, surface));
        box.add(surface.skin >= 0 ? skinned(moved, bones.vertices[vertex], palette).position : moved.position);
    };
    Box box;
    if (mesh.indices.empty()) {
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) add(box, i);
    }
    for (const std::uint32_t vertex : mesh.indices) add(box, vertex);
    return box;
}

}  // namespace halfframe
