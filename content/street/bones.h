// The bones of the people of the street, and how they walk.
#pragma once

#include <string>

#include "engine/frame/scene.h"

namespace halfframe::content::street {

/// Parents stand before their children.
enum class Bone : std::uint8_t {
    root,
    hips,
    spine,
    chest,
    neck,
    head,
    left_upper_arm,
    left_forearm,
    left_hand,
    right_upper_arm,
    right_forearm,
    right_hand,
    left_thigh,
    left_shin,
    left_foot,
    left_toe,
    right_thigh,
    right_shin,
    right_foot,
    right_toe,
};
constexpr int kBones = 20;

struct Walk {
    glm::vec3 start{0.0f};     ///< [m] of the feet
    float heading_rad = 0.0f;  ///< about y; 0 walks towards +z
    float phase = 0.0f;        ///< 0..1 of a stride at the first key
    float speed_m_s = 1.25f;
};

/// Nodes for all bones in the pose of the first key; returns the index of the first.
int add_bones(Scene& scene, const std::string& name, const Walk& walk);
/// Inverse bind matrices for a mesh in the pose of the first key, in the frame of `root_place`.
[[nodiscard]] Skin body_skin(const std::string& name, int first_node, const Walk& walk);
/// Eight strides, then from the start again.
[[nodiscard]] Animation walk_animation(const std::string& name, int first_node, const Walk& walk);
/// Where the feet stand at the first key.
[[nodiscard]] glm::mat4 root_place(const Walk& walk);
/// Takes a mesh that was made standing straight into the pose of the first key, which then is its bind pose: so it
/// shows a step even where nothing moves it.
void bake_first_step(Mesh& mesh, const Walk& walk);

}  // namespace halfframe::content::street
