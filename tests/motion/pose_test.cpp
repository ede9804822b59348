// Channels, trees and skins against a reference in double that shares no function with them.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/frame/pose.h"
#include "engine/frame/skinning.h"
#include "tests/motion/motion_reference.h"
#include "tests/motion/moving_scenes.h"

namespace halfframe::tests {
namespace {

constexpr unsigned kSeed = 20261124;

/// Random keys at 0.5, 1.0, 1.75 and 3 s; rotations are unit.
AnimationChannel random_channel(std::mt19937& random, AnimatedValue value, Interpolation interpolation) {
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    AnimationChannel channel{
        .node = 0, .value = value, .interpolation = interpolation, .times_s = {0.5f, 1.0f, 1.75f, 3.0f}};
    const std::size_t components = value == AnimatedValue::rotation ? 4 : 3;
    for (std::size_t i = 0; i < channel.times_s.size() * (interpolation == Interpolation::cubic_spline ? 3 : 1); ++i) {
        std::vector<float> key(components);
        float squared = 0.0f;
        for (float& part : key) {
            part = number(random);
            squared += part * part;
        }
        for (const float part : key)
            channel.values.push_back(value == AnimatedValue::rotation ? part / std::sqrt(squared) : part);
    }
    return channel;
}

/// How far two values are apart; a quaternion and its negative are one rotation.
double distance(const std::vector<double>& a, const std::vector<double>& b, AnimatedValue value) {
    double same = 0.0, opposite = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        same = std::max(same, std::abs(a[i] - b[i]));
        opposite = std::max(opposite, std::abs(a[i] + b[i]));
    }
    return value == AnimatedValue::rotation ? std::min(same, opposite) : same;
}

std::vector<double> sampled(const AnimationChannel& channel, double time_s) {
    std::vector<double> value(components_of(channel));
    sample(channel, time_s, value);
    return value;
}

TEST(Channel, AgreesWithTheReference) {
    std::mt19937 random(kSeed);
    double worst = 0.0;
    int compared = 0;
    for (const AnimatedValue value :
         {AnimatedValue::translation, AnimatedValue::rotation, AnimatedValue::morph_weights}) {
        for (const Interpolation way : {Interpolation::step, Interpolation::linear, Interpolation::cubic_spline}) {
            for (int each = 0; each < 20; ++each) {
                const AnimationChannel channel = random_channel(random, value, way);
                for (double time_s = 0.0; time_s < 3.6; time_s += 0.0625) {
                    const double apart = distance(sampled(channel, time_s), reference_sample(channel, time_s), value);
                    ASSERT_LT(apart, 1e-6) << "value " << static_cast<int>(value) << ", interpolation "
                                           << static_cast<int>(way) << ", channel " << each << ", " << time_s << " s";
                    worst = std::max(worst, apart);
                    ++compared;
                }
            }
        }
    }
    EXPECT_GT(compared, 5000);
    // 2e-7: the keys are unit to float's 6e-8 only, and the reference makes them unit first; measured 4.9e-8
    EXPECT_LT(worst, 2e-7);
}

TEST(Channel, AStraightLineBetweenRotationsWouldBeSeen) {
    std::mt19937 random(kSeed);
    double worst = 0.0;
    for (int each = 0; each < 20; ++each) {
        const AnimationChannel channel = random_channel(random, AnimatedValue::rotation, Interpolation::linear);
        AnimationChannel straight = channel;
        straight.value = AnimatedValue::morph_weights;  // four plain numbers: lerp
        std::vector<double> wrong = sampled(straight, 1.2);
        const double length =
            std::sqrt(wrong[0] * wrong[0] + wrong[1] * wrong[1] + wrong[2] * wrong[2] + wrong[3] * wrong[3]);
        for (double& part : wrong) part /= length;
        worst = std::max(worst, distance(wrong, reference_sample(channel, 1.2), AnimatedValue::rotation));
    }
    EXPECT_GT(worst, 1e-3);
}

TEST(Channel, StepHoldsAndEndsAreClamped) {
    const AnimationChannel steps{.node = 0,
                                 .value = AnimatedValue::translation,
                                 .interpolation = Interpolation::step,
                                 .times_s = {1.0f, 2.0f},
                                 .values = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f}};
    const std::vector<double> first{1.0, 2.0, 3.0}, second{4.0, 5.0, 6.0};
    EXPECT_EQ(sampled(steps, -1.0), first);
    EXPECT_EQ(sampled(steps, 1.999), first);
    EXPECT_EQ(sampled(steps, 2.0), second);
    EXPECT_EQ(sampled(steps, 1e9), second);
}

TEST(Channel, TheCubicIsHermites) {
    // p(t) over 2 s from 1 with slope 3 to 5 with slope -1. By hand at half way: 0.5 * 1 + 0.125 * 2 * 3 + 0.5 * 5 -
    // 0.125 * 2 * -1 = 4.
    const AnimationChannel cubic{.node = 0,
                                 .value = AnimatedValue::morph_weights,
                                 .interpolation = Interpolation::cubic_spline,
                                 .times_s = {1.0f, 3.0f},
                                 .values = {9.0f, 1.0f, 3.0f, -1.0f, 5.0f, 9.0f}};
    EXPECT_DOUBLE_EQ(sampled(cubic, 2.0)[0], 4.0);
    EXPECT_DOUBLE_EQ(sampled(cubic, 1.0)[0], 1.0);
    EXPECT_DOUBLE_EQ(sampled(cubic, 3.0)[0], 5.0);
}

TEST(Time, IsLooped) {
    EXPECT_DOUBLE_EQ(looped(0.0, 2.0), 0.0);
    EXPECT_DOUBLE_EQ(looped(2.0, 2.0), 2.0) << "the end can be asked for";
    EXPECT_DOUBLE_EQ(looped(2.5, 2.0), 0.5);
    EXPECT_DOUBLE_EQ(looped(-0.5, 2.0), 1.5);
    EXPECT_DOUBLE_EQ(looped(5.0, 0.0), 0.0);
    // A float could not tell these frames of a show that runs for twelve days apart.
    EXPECT_NEAR(looped(1048576.0 + 1.0 / 60.0, 2.0), 1.0 / 60.0, 1e-9);
}

TEST(Animator, GoesBackToRest) {
    Scene scene = moving_scene();
    const Scene before = scene;
    Animator animator(scene);
    animator.pose(scene, 0, 0.7);
    EXPECT_NE(scene.nodes[1].rotation, before.nodes[1].rotation);
    EXPECT_NE(scene.nodes[2].morph_weights, before.nodes[2].morph_weights);
    animator.pose(scene, -1, 0.7);
    EXPECT_EQ(scene.nodes[1].rotation, before.nodes[1].rotation);
    EXPECT_EQ(scene.nodes[2].morph_weights, before.nodes[2].morph_weights);
}

TEST(Animator, CarriesSurfacesLightsAndCameras) {
    Scene scene = morphing_square();
    scene.nodes[0].translation = {1.0f, 2.0f, 3.0f};
    scene.nodes[0].rotation = {std::sqrt(0.5f), 0.0f, std::sqrt(0.5f), 0.0f};  // 90 degrees about y: -Z becomes -X
    scene.nodes[0].scale = glm::vec3(2.0f);
    scene.lights.push_back({.kind = LightKind::spot, .node = 0});
    scene.cameras.push_back({.name = "on it", .node = 0});
    place(scene);
    EXPECT_EQ(glm::vec3(scene.surfaces[0].world_from_local[3]), glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_NEAR(glm::length(glm::vec3(scene.surfaces[0].world_from_local[0])), 2.0f, 1e-6f);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_NEAR(scene.lights[0].direction.x, -1.0f, 1e-6f);
    EXPECT_NEAR(glm::length(glm::vec3(scene.cameras[0].world_from_view[0])), 1.0f, 1e-6f) << "cameras have no scale";
}

/// Worst distance of the engine's vertices of a skinned surface from the reference's [m]; `change` spoils the bones.
template <typename Change>
double skinning_error(Scene scene, double time_s, Change change) {
    const std::vector<Frame> nodes = reference_nodes(scene, 0, time_s);
    Animator(scene).pose(scene, 0, time_s);
    const Surface& surface = scene.surfaces[0];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
    SkinnedMesh bones = skinned_mesh(mesh);
    std::vector<glm::dmat4> world_from_node(scene.nodes.size());
    world_from_nodes(scene, world_from_node);
    std::vector<JointRows> palette(bones.joints.size());
    write_palette(scene, surface, bones.joints, world_from_node, palette);
    double worst = 0.0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const SkinVertex exact = bones.vertices[i];
        std::array<int, 4> joints{};
        Quadruple weights{};
        for (std::size_t k = 0; k < 4; ++k) {
            joints[k] = bones.joints[exact.joints[k]];
            weights[k] = exact.weights[k] / 255.0;
        }
        const glm::vec3 at = mesh.positions[i];
        const Triple truth = reference_skinned(scene, surface, nodes, {at.x, at.y, at.z}, joints, weights);
        change(bones.vertices[i]);
        const glm::vec3 ours = skinned({.position = at}, bones.vertices[i], palette).position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double place = double{surface.world_from_local[3][static_cast<int>(axis)]};
            worst = std::max(worst, std::abs(place + double{ours[static_cast<int>(axis)]} - truth[axis]));
        }
    }
    return worst;
}

TEST(Skin, AgreesWithTheReferenceNearAndFar) {
    for (const glm::vec3& away : {glm::vec3(0.0f), glm::vec3(10000.3f, -7000.7f, 5000.1f)}) {
        double worst = 0.0;
        for (const double time_s : {0.0, 0.25, 0.5, 1.0})
            worst = std::max(worst, skinning_error(two_bones(away), time_s, [](SkinVertex&) {}));
        // 5e-7 m: float's rounding of places within 2 m of the first joint, 10 km from the origin as at it. Measured
        // 1.4e-7; a float there has steps of 1e-3.
        EXPECT_LT(worst, 5e-7) << away.x;
    }
}

TEST(Skin, WeightsThatDoNotSumToOneWouldBeSeen) {
    const auto lose_one = [](SkinVertex& vertex) { --vertex.weights[vertex.weights[0] > 0 ? 0 : 1]; };
    EXPECT_GT(skinning_error(two_bones(), 0.5, lose_one), 1e-3);
}

TEST(Skin, TheUpperBoneTurnsAboutItsJoint) {
    Scene scene = two_bones();
    Animator(scene).pose(scene, 0, 1.0);
    const Box box = posed_box(scene, 0);
    // 90 degrees about (0, 1, 0): the end of the strip, 1 m above, comes to x = -1, and its width lies along y.
    EXPECT_NEAR(box.low.x, -1.0f, 1e-6f);
    EXPECT_NEAR(box.high.x, 0.25f, 1e-6f);
    EXPECT_NEAR(box.low.y, 0.0f, 1e-6f);
    EXPECT_NEAR(box.high.y, 1.25f, 1e-6f);
}

TEST(Skin, BytesOfWeightsSumTo255) {
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> number(0.0f, 1.0f);
    for (int each = 0; each < 20000; ++each) {
        glm::vec4 weights{number(random), number(random), each % 3 == 0 ? 0.0f : number(random),
                          each % 2 == 0 ? 0.0f : number(random) * 0.01f};
        weights /= weights.x + weights.y + weights.z + weights.w;
        const auto bytes = unorm8_weights(weights);
        ASSERT_EQ(bytes[0] + bytes[1] + bytes[2] + bytes[3], 255) << each;
        for (std::size_t k = 0; k < 4; ++k) {
            ASSERT_LT(std::abs(static_cast<float>(bytes[k]) / 255.0f - weights[static_cast<int>(k)]), 1.0f / 255.0f);
            if (weights[static_cast<int>(k)] == 0.0f) {
                ASSERT_EQ(bytes[k], 0) << "a joint that carries nothing got weight";
            }
        }
    }
    EXPECT_EQ(unorm8_weights({1.0f, 0.0f, 0.0f, 0.0f}), (std::array<std::uint8_t, 4>{255, 0, 0, 0}));
}

TEST(Skin, TheBoxOfThePaletteHoldsEveryVertex) {
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    int looser = 0;
    for (int each = 0; each < 200; ++each) {
        Scene scene = two_bones();
        for (Node& node : scene.nodes) {
            node.rotation = glm::normalize(glm::quat(number(random), number(random), number(random), number(random)));
            node.scale = {1.0f + 0.5f * number(random), 1.0f, 1.0f + 0.5f * number(random)};
            node.translation += glm::vec3(number(random));
        }
        place(scene);
        const SkinnedMesh bones = skinned_mesh(scene.meshes[0]);
        std::vector<glm::dmat4> world_from_node(scene.nodes.size());
        world_from_nodes(scene, world_from_node);
        std::vector<JointRows> palette(bones.joints.size());
        write_palette(scene, scene.surfaces[0], bones.joints, world_from_node, palette);
        const Box around = skinned_box(bones, palette, {});
        const Box exact = posed_box(scene, 0);
        for (int axis = 0; axis < 3; ++axis) {
            // 1e-6 m: rounding of the two sums
            ASSERT_LE(around.low[axis], exact.low[axis] + 1e-6f) << each;
            ASSERT_GE(around.high[axis], exact.high[axis] - 1e-6f) << each;
            looser += around.high[axis] > exact.high[axis] + 1e-3f;
        }
    }
    EXPECT_GT(looser, 0) << "the box is that of the vertices: it proves nothing";
}

TEST(Morph, TargetsAddUpAndTheReachHoldsThem) {
    Scene scene = morphing_square();
    Animator(scene).pose(scene, 0, 0.5);
    const Box box = posed_box(scene, 0);
    // Half of lift: 0.5 m up. Half of widen: 1.5 times as wide.
    EXPECT_FLOAT_EQ(box.low.x, -0.75f);
    EXPECT_FLOAT_EQ(box.high.x, 0.75f);
    EXPECT_FLOAT_EQ(box.low.y, 0.0f);
    EXPECT_FLOAT_EQ(box.high.y, 1.0f);
    const Box reach = morph_reach(target_boxes(scene.meshes[0]), scene.nodes[0].morph_weights);
    EXPECT_FLOAT_EQ(reach.low.x, -0.25f);
    EXPECT_FLOAT_EQ(reach.high.y, 0.5f);
}

}  // namespace
}  // namespace halfframe::tests
