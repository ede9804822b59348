// Twenty bones, and the sines that move them.
#include "content/street/bones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace halfframe::content::street {

namespace {

struct BoneDescription {
    const char* name;
    int parent;          ///< index in this table
    glm::vec3 standing;  ///< its joint in a body that stands straight [m], feet at the origin, looking along +z
};

/// Joints of an adult of 1.75 m: hips at 0.53 of the height, knee at 0.28, shoulder at 0.82 (after R. Drillis and
/// R. Contini 1966, whose shares are these to 2 cm).
constexpr std::array<BoneDescription, kBones> kTable{{
    {"root", -1, {0.0f, 0.0f, 0.0f}},
    {"hips", 0, {0.0f, 0.95f, 0.0f}},
    {"spine", 1, {0.0f, 1.06f, 0.0f}},
    {"chest", 2, {0.0f, 1.22f, 0.0f}},
    {"neck", 3, {0.0f, 1.48f, -0.01f}},
    {"head", 4, {0.0f, 1.56f, 0.0f}},
    {"left upper arm", 3, {0.19f, 1.43f, -0.01f}},
    {"left forearm", 6, {0.22f, 1.13f, -0.01f}},
    {"left hand", 7, {0.23f, 0.87f, 0.005f}},
    {"right upper arm", 3, {-0.19f, 1.43f, -0.01f}},
    {"right forearm", 9, {-0.22f, 1.13f, -0.01f}},
    {"right hand", 10, {-0.23f, 0.87f, 0.005f}},
    {"left thigh", 1, {0.095f, 0.92f, 0.0f}},
    {"left shin", 12, {0.095f, 0.49f, 0.005f}},
    {"left foot", 13, {0.095f, 0.09f, 0.0f}},
    {"left toe", 14, {0.095f, 0.03f, 0.12f}},
    {"right thigh", 1, {-0.095f, 0.92f, 0.0f}},
    {"right shin", 16, {-0.095f, 0.49f, 0.005f}},
    {"right foot", 17, {-0.095f, 0.09f, 0.0f}},
    {"right toe", 18, {-0.095f, 0.03f, 0.12f}},
}};

constexpr int kStrides = 8;
constexpr int kKeysAStride = 8;
/// Two steps of 0.68 m at 1.25 m/s.
constexpr float kStride_m = 1.36f;

glm::vec3 offset_of(int bone) {
    const BoneDescription& each = kTable[static_cast<std::size_t>(bone)];
    return each.parent < 0 ? each.standing : each.standing - kTable[static_cast<std::size_t>(each.parent)].standing;
}

glm::quat turned(double x_rad, double y_rad = 0.0, double z_rad = 0.0) {
    const auto about = [](double angle, const glm::dvec3& axis) {
        return glm::dquat(std::cos(0.5 * angle), std::sin(0.5 * angle) * axis);
    };
    const glm::dquat all =
        about(y_rad, {0.0, 1.0, 0.0}) * about(z_rad, {0.0, 0.0, 1.0}) * about(x_rad, {1.0, 0.0, 0.0});
    return {static_cast<float>(all.w), static_cast<float>(all.x), static_cast<float>(all.y), static_cast<float>(all.z)};
}

/// Angles of a leg at a place 0..1 of its stride; 0: its heel touches the ground in front. Positive about x is
/// backwards.
struct Leg {
    double thigh, shin, foot;
};
Leg leg_at(double t) {
    const double turn = glm::two_pi<double>() * t;
    const double thigh = -0.42 * std::cos(turn) - 0.06;
    // The knee gives a little under the weight and much when the foot swings forward.
    const double swing = std::sin(turn - glm::pi<double>() * 0.95);
    const double shin =
        0.10 + 0.95 * std::max(0.0, swing) * std::max(0.0, swing) + 0.12 * std::max(0.0, std::sin(turn * 2.0));
    return {thigh, shin, -thigh - shin + 0.25 * std::cos(turn - 2.2) - 0.05};
}

/// The turn of each bone at a place 0..1 of the stride.
glm::quat rotation_at(Bone bone, double t) {
    const double turn = glm::two_pi<double>() * t;
    const Leg left = leg_at(t);
    const Leg right = leg_at(t + 0.5 - std::floor(t + 0.5));
    const double swing = std::cos(turn);  // of the left leg, forward at +1; the arms go against it
    switch (bone) {
        case Bone::hips: return turned(0.03, -0.07 * swing, 0.03 * std::sin(turn));
        case Bone::spine: return turned(0.04, 0.05 * swing);
        case Bone::chest: return turned(0.02, 0.09 * swing);
        case Bone::neck: return turned(0.06, -0.04 * swing);
        case Bone::head: return turned(-0.08, -0.03 * swing);
        case Bone::left_upper_arm: return turned(0.40 * swing + 0.05, 0.0, 0.07);
        case Bone::right_upper_arm: return turned(-0.40 * swing + 0.05, 0.0, -0.07);
        case Bone::left_forearm: return turned(-0.30 + 0.18 * swing);
        case Bone::right_forearm: return turned(-0.30 - 0.18 * swing);
        case Bone::left_thigh: return turned(left.thigh);
        case Bone::left_shin: return turned(left.shin);
        case Bone::left_foot: return turned(left.foot);
        case Bone::right_thigh: return turned(right.thigh);
        case Bone::right_shin: return turned(right.shin);
        case Bone::right_foot: return turned(right.foot);
        default: return {1.0f, 0.0f, 0.0f, 0.0f};
    }
}

/// How far the hips are let down so that the lower foot stands on the ground [m].
float drop_at(double t) {
    float lowest = 1e9f;
    for (const bool left : {true, false}) {
        const double at = left ? t : t + 0.5 - std::floor(t + 0.5);
        const Leg leg = leg_at(at);
        const double knee = 0.43 * std::cos(leg.thigh);
        const double ankle = 0.40 * std::cos(leg.thigh + leg.shin);
        const double tilt = leg.thigh + leg.shin + leg.foot;  // heel or toe, whichever is lower
        const double sole = 0.09 * std::cos(tilt) + std::max(0.06 * -std::sin(tilt), 0.16 * std::sin(tilt));
        lowest = std::min(lowest, static_cast<float>(0.92 - knee - ankle - sole));
    }
    return lowest;
}

glm::vec3 hips_at(double t) { return offset_of(1) - glm::vec3(0.0f, drop_at(t), 0.0f); }

/// Places of all bones in the frame of the root at a place of the stride.
std::array<glm::mat4, kBones> posed(double t) {
    std::array<glm::mat4, kBones> root_from_bone{};
    root_from_bone[0] = glm::mat4(1.0f);
    for (int bone = 1; bone < kBones; ++bone) {
        const auto at = static_cast<std::size_t>(bone);
        const glm::vec3 offset = bone == 1 ? hips_at(t) : offset_of(bone);
        root_from_bone[at] = root_from_bone[static_cast<std::size_t>(kTable[at].parent)] *
                             glm::translate(glm::mat4(1.0f), offset) *
                             glm::mat4_cast(rotation_at(static_cast<Bone>(bone), t));
    }
    return root_from_bone;
}

glm::vec3 forward(const Walk& walk) {
    return {static_cast<float>(std::sin(static_cast<double>(walk.heading_rad))), 0.0f,
            static_cast<float>(std::cos(static_cast<double>(walk.heading_rad)))};
}

AnimationChannel rotation_channel(int node, Bone bone, const Walk& walk, float stride_s) {
    AnimationChannel channel{.node = node, .value = AnimatedValue::rotation, .times_s = {}, .values = {}};
    for (int key = 0; key <= kStrides * kKeysAStride; ++key) {
        const double stride = static_cast<double>(key) / kKeysAStride;
        const double t = stride + static_cast<double>(walk.phase);
        const glm::quat turn = rotation_at(bone, t - std::floor(t));
        channel.times_s.push_back(static_cast<float>(stride) * stride_s);
        for (const float part : {turn.x, turn.y, turn.z, turn.w}) channel.values.push_back(part);
    }
    return channel;
}

}  // namespace

glm::mat4 root_place(const Walk& walk) {
    return glm::translate(glm::mat4(1.0f), walk.start) *
           glm::mat4_cast(turned(0.0, static_cast<double>(walk.heading_rad)));
}

int add_bones(Scene& scene, const std::string& name, const Walk& walk) {
    const int first = static_cast<int>(scene.nodes.size());
    const auto t = static_cast<double>(walk.phase);
    for (int bone = 0; bone < kBones; ++bone) {
        const BoneDescription& each = kTable[static_cast<std::size_t>(bone)];
        Node node;
        node.name = name + " " + each.name;
        node.parent = each.parent < 0 ? -1 : first + each.parent;
        node.translation = bone == 0 ? walk.start : bone == 1 ? hips_at(t) : offset_of(bone);
        node.rotation =
            bone == 0 ? turned(0.0, static_cast<double>(walk.heading_rad)) : rotation_at(static_cast<Bone>(bone), t);
        scene.nodes.push_back(std::move(node));
    }
    return first;
}

Skin body_skin(const std::string& name, int first_node, const Walk& walk) {
    Skin skin;
    skin.name = name;
    for (int bone = 0; bone < kBones; ++bone) skin.joints.push_back(first_node + bone);
    for (const glm::mat4& root_from_bone : posed(static_cast<double>(walk.phase)))
        skin.joint_from_mesh.push_back(glm::inverse(root_from_bone));
    return skin;
}

Animation walk_animation(const std::string& name, int first_node, const Walk& walk) {
    Animation animation;
    animation.name = name + " walks";
    const float stride_s = kStride_m / walk.speed_m_s;
    for (int bone = 1; bone < kBones; ++bone) {
        if (static_cast<Bone>(bone) == Bone::left_toe || static_cast<Bone>(bone) == Bone::right_toe) continue;
        animation.channels.push_back(rotation_channel(first_node + bone, static_cast<Bone>(bone), walk, stride_s));
    }
    AnimationChannel hips{.node = first_node + 1, .value = AnimatedValue::translation, .times_s = {}, .values = {}};
    for (int key = 0; key <= kStrides * kKeysAStride; ++key) {
        const double stride = static_cast<double>(key) / kKeysAStride;
        const double t = stride + static_cast<double>(walk.phase);
        const glm::vec3 at = hips_at(t - std::floor(t));
        hips.times_s.push_back(static_cast<float>(stride) * stride_s);
        for (const float part : {at.x, at.y, at.z}) hips.values.push_back(part);
    }
    animation.duration_s = static_cast<float>(kStrides) * stride_s;
    AnimationChannel root{
        .node = first_node, .value = AnimatedValue::translation, .times_s = {0.0f, animation.duration_s}, .values = {}};
    const glm::vec3 end = walk.start + forward(walk) * (kStride_m * kStrides);
    for (const glm::vec3& at : {walk.start, end}) root.values.insert(root.values.end(), {at.x, at.y, at.z});
    animation.channels.push_back(std::move(hips));
    animation.channels.push_back(std::move(root));
    return animation;
}

void bake_first_step(Mesh& mesh, const Walk& walk) {
    const auto pose = posed(static_cast<double>(walk.phase));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::mat4 blend(0.0f);
        for (int k = 0; k < 2; ++k) {
            const std::size_t bone = mesh.joints[i][k];
            blend += mesh.weights[i][k] * pose[bone] * glm::translate(glm::mat4(1.0f), -kTable[bone].standing);
        }
        mesh.positions[i] = glm::vec3(blend * glm::vec4(mesh.positions[i], 1.0f));
        const glm::mat3 turn(blend);
        mesh.normals[i] = glm::normalize(turn * mesh.normals[i]);
        const glm::vec3 tangent = turn * glm::vec3(mesh.tangents[i]);
        mesh.tangents[i] =
            glm::vec4(glm::normalize(tangent - mesh.normals[i] * glm::dot(mesh.normals[i], tangent)), 1.0f);
    }
}

}  // namespace halfframe::content::street
