// The people of the street: sound skins, a walk that starts in the pose they are drawn in, feet on the ground.
#include <cmath>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/content/street/made_scenes.h"

namespace halfframe::tests {
namespace {

/// Places of all nodes as they stand in the scene.
std::vector<glm::mat4> world_from_nodes(const Scene& scene) {
    std::vector<glm::mat4> places;
    for (const Node& node : scene.nodes) {
        const glm::mat4 parent_from_local = glm::translate(glm::mat4(1.0f), node.translation) *
                                            glm::mat4_cast(node.rotation) * glm::scale(glm::mat4(1.0f), node.scale);
        places.push_back(node.parent < 0 ? parent_from_local
                                         : places.at(static_cast<std::size_t>(node.parent)) * parent_from_local);
    }
    return places;
}

TEST(StreetPeople, HaveBonesThatCarryThem) {
    const Scene& scene = made("street");
    ASSERT_EQ(scene.skins.size(), 2u);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        EXPECT_LT(scene.nodes[i].parent, static_cast<int>(i)) << scene.nodes[i].name;
        EXPECT_NEAR(glm::length(scene.nodes[i].rotation), 1.0f, 1e-6) << scene.nodes[i].name;  // float rounding
    }
    for (const Skin& skin : scene.skins) {
        EXPECT_GE(skin.joints.size(), 15u);
        EXPECT_LE(skin.joints.size(), 25u);
        ASSERT_EQ(skin.joint_from_mesh.size(), skin.joints.size());
        for (const int joint : skin.joints) ASSERT_LT(static_cast<std::size_t>(joint), scene.nodes.size());
    }
    int skinned = 0;
    for (const Surface& surface : scene.surfaces) {
        if (surface.skin < 0) continue;
        ++skinned;
        EXPECT_TRUE(surface.dynamic);
        const Mesh& mesh = mesh_of(scene, surface);
        ASSERT_EQ(mesh.joints.size(), mesh.positions.size());
        ASSERT_EQ(mesh.weights.size(), mesh.positions.size());
        for (std::size_t i = 0; i < mesh.weights.size(); ++i) {
            const glm::vec4& w = mesh.weights[i];
            ASSERT_NEAR(w.x + w.y + w.z + w.w, 1.0f, 1e-6);
            for (int k = 0; k < 4; ++k)
                ASSERT_LT(mesh.joints[i][k], scene.skins[static_cast<std::size_t>(surface.skin)].joints.size());
        }
    }
    EXPECT_GE(skinned, 8);
}

TEST(StreetPeople, AreDrawnWhereTheirBonesPutThem) {
    // The bind pose is the first step: bones and the place of the surface agree, moved or not.
    const Scene& scene = made("street");
    const std::vector<glm::mat4> places = world_from_nodes(scene);
    for (const Surface& surface : scene.surfaces) {
        if (surface.skin < 0) continue;
        const Skin& skin = scene.skins[static_cast<std::size_t>(surface.skin)];
        for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
            const glm::mat4 by_bone =
                places[static_cast<std::size_t>(skin.joints[joint])] * skin.joint_from_mesh[joint];
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 4; ++row)  // 2e-5: a chain of six float products at 15 m
                    ASSERT_NEAR(by_bone[column][row], surface.world_from_local[column][row], 2e-5) << surface.name;
            }
        }
    }
}

TEST(StreetPeople, StandOnTheGroundAndAreAsTallAsPeople) {
    const Scene& scene = made("street");
    for (const char* who : {"walker", "stroller"}) {
        Box box;
        for (const Surface& surface : scene.surfaces) {
            if (!surface.name.starts_with(who)) continue;
            for (const glm::vec3& at : mesh_of(scene, surface).positions)
                box.add(glm::vec3(surface.world_from_local * glm::vec4(at, 1.0f)));
        }
        const float ground = std::string(who) == "walker" ? content::street::road_height_m(-0.75f) : 0.15f;
        // The sole is reckoned from two points of it, its skin is rounder: 3 cm.
        EXPECT_NEAR(box.low.y, ground, 0.03f) << who;
        EXPECT_NEAR(box.high.y - box.low.y, 1.75f, 0.07f) << who;  // a step is lower than standing
    }
}

TEST(StreetPeople, WalkAsFastAsTheyStep) {
    const Scene& scene = made("street");
    ASSERT_EQ(scene.animations.size(), 2u);
    for (const Animation& animation : scene.animations) {
        EXPECT_GT(animation.duration_s, 5.0f);
        int rotations = 0;
        for (const AnimationChannel& channel : animation.channels) {
            ASSERT_LT(static_cast<std::size_t>(channel.node), scene.nodes.size());
            const std::size_t width = channel.value == AnimatedValue::rotation ? 4 : 3;
            ASSERT_EQ(channel.values.size(), width * channel.times_s.size());
            for (std::size_t i = 1; i < channel.times_s.size(); ++i)
                ASSERT_LT(channel.times_s[i - 1], channel.times_s[i]);
            EXPECT_NEAR(channel.times_s.back(), animation.duration_s, 1e-4);
            const Node& node = scene.nodes[static_cast<std::size_t>(channel.node)];
            if (channel.value == AnimatedValue::rotation) {
                ++rotations;
                for (int k = 0; k < 4; ++k)  // the first key is the pose of the scene
                    EXPECT_NEAR(channel.values[static_cast<std::size_t>(k)], node.rotation[k], 1e-6) << node.name;
            } else if (node.parent < 0) {
                const glm::vec3 from(channel.values[0], channel.values[1], channel.values[2]);
                const glm::vec3 to(channel.values[3], channel.values[4], channel.values[5]);
                const float speed = glm::distance(from, to) / animation.duration_s;
                EXPECT_GT(speed, 1.0f);  // a stroll
                EXPECT_LT(speed, 1.5f);  // and no run [m/s]
            }
        }
        EXPECT_GE(rotations, 15);
    }
}

}  // namespace
}  // namespace halfframe::tests
