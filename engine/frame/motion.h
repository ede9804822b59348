// What moves in a scene: nodes, skins and the animations that drive them, as glTF 2.0 has them. Plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace halfframe {

/// A place that may move. Parents stand before their children.
struct Node {
    std::string name;
    int parent = -1;                             ///< index in Scene::nodes; -1: the world
    glm::vec3 translation{0.0f};                 ///< [m], to the parent
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  ///< unit; w x y z
    glm::vec3 scale{1.0f};
    std::optional<glm::mat4> parent_from_local;  ///< takes the place of the three; such a node is not animated
    std::vector<float> morph_weights;            ///< of the meshes that hang on it
};

/// Bones that carry a mesh. Vertex i goes to the sum over k of weights[i][k] * world_from_joint[joints[i][k]] *
/// joint_from_mesh[joints[i][k]] (glTF 2.0, section 3.7.3.3).
struct Skin {
    std::string name;
    std::vector<int> joints;                 ///< indices in Scene::nodes
    std::vector<glm::mat4> joint_from_mesh;  ///< inverse bind matrices, one a joint
};

enum class Interpolation : std::uint8_t { step, linear, cubic_spline };
enum class AnimatedValue : std::uint8_t { translation, rotation, scale, morph_weights };

/// The course of one value of one node.
struct AnimationChannel {
    int node = 0;
    AnimatedValue value = AnimatedValue::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times_s;  ///< rising
    /// For each time the components of the value (3, 4 as x y z w, or one a morph target); with cubic_spline three of
    /// these, in-tangent, value, out-tangent.
    std::vector<float> values;
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0f;  ///< the last time of any channel
};

}  // namespace halfframe
