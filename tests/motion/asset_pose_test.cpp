// Real models: every vertex of every skinned surface, in several moments of every animation, against the reference.
#include <cmath>

#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/frame/pose.h"
#include "engine/frame/skinning.h"
#include "tests/harness/assets.h"
#include "tests/motion/motion_reference.h"

namespace halfframe::tests {
namespace {

struct Compared {
    double worst = 0.0;  ///< distance over the size of the model
    std::size_t vertices = 0;
    std::size_t nodes = 0;
};

void compare_surface(const Scene& scene, const Surface& surface, const std::vector<Frame>& nodes, double size_m,
                     Compared& compared) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
    const SkinnedMesh bones = skinned_mesh(mesh);
    std::vector<glm::dmat4> world_from_node(scene.nodes.size());
    world_from_nodes(scene, world_from_node);
    std::vector<JointRows> palette(bones.joints.size());
    write_palette(scene, surface, bones.joints, world_from_node, palette);
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {  // a third of them: the reference is slow
        std::array<int, 4> joints{};
        Quadruple weights{};
        for (std::size_t k = 0; k < 4; ++k) {
            joints[k] = bones.joints[bones.vertices[i].joints[k]];
            weights[k] = bones.vertices[i].weights[k] / 255.0;
        }
        const glm::vec3 at = mesh.positions[i];
        const Triple truth = reference_skinned(scene, surface, nodes, {at.x, at.y, at.z}, joints, weights);
        const glm::vec3 ours = skinned({.position = at}, bones.vertices[i], palette).position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            const double apart = std::abs(double{surface.world_from_local[3][a]} + double{ours[a]} - truth[axis]);
            compared.worst = std::max(compared.worst, apart / size_m);
        }
        ++compared.vertices;
    }
}

Compared compare(Scene scene) {
    Compared compared;
    const Box box = world_box(scene);
    const double size_m = double{glm::length(box.high - box.low)};
    Animator animator(scene);
    const int animations = static_cast<int>(scene.animations.size());
    for (int animation = 0; animation < animations; animation += std::max(1, animations / 8)) {
        const double duration_s = scene.animations[static_cast<std::size_t>(animation)].duration_s;
        animator.pose(scene, -1, 0.0);
        const Scene rest = scene;
        for (const double share : {0.0, 0.31, 0.77, 1.0}) {
            const std::vector<Frame> nodes = reference_nodes(rest, animation, share * duration_s);
            animator.pose(scene, animation, share * duration_s);
            std::vector<glm::dmat4> world_from_node(scene.nodes.size());
            world_from_nodes(scene, world_from_node);
            for (std::size_t n = 0; n < nodes.size(); ++n) {
                for (std::size_t i = 0; i < 3; ++i) {
                    const double apart = std::abs(world_from_node[n][3][static_cast<int>(i)] - nodes[n].origin[i]);
                    compared.worst = std::max(compared.worst, apart / size_m);
                }
                ++compared.nodes;
            }
            for (const Surface& surface : scene.surfaces) {
                if (surface.skin >= 0) compare_surface(scene, surface, nodes, size_m, compared);
            }
        }
    }
    return compared;
}

TEST(AssetPose, AgreesWithTheReference) {
    const auto folder = harness::assets_folder();
    if (!folder) GTEST_SKIP() << harness::assets_missing();
    int skinned = 0, animated = 0;
    for (const char* model : {"AnimatedMorphCube", "AnimatedTriangle", "BoxAnimated", "CesiumMan", "Fox",
                              "InterpolationTest", "RiggedSimple", "SimpleMorph", "SimpleSkin"}) {
        const auto files = harness::gltf_files(*folder / "khronos" / model);
        ASSERT_FALSE(files.empty()) << model;
        const auto& file = files.front();
        const Scene scene = content::load_gltf(file);
        const Compared compared = compare(scene);
        // 1e-6 of the model's size: a node's values are stored as floats, and a chain of 20 joints adds up their
        // rounding; measured 1.2e-7 (CesiumMan)
        EXPECT_LT(compared.worst, 1e-6) << file.filename();
        animated += compared.nodes > 0;
        skinned += compared.vertices > 0;
    }
    EXPECT_GE(animated, 8);
    EXPECT_GE(skinned, 4) << "Fox, CesiumMan, RiggedSimple, SimpleSkin";
}

TEST(AssetPose, ACharacterOfManyClipsAgreesToo) {
    const auto folder = harness::assets_folder();
    if (!folder) GTEST_SKIP() << harness::assets_missing();
    const Scene scene = content::load_gltf(*folder / "kaykit" / "characters" / "Knight.glb");
    EXPECT_EQ(scene.animations.size(), 76u);
    const Compared compared = compare(scene);
    EXPECT_GT(compared.vertices, 10000u);
    EXPECT_LT(compared.worst, 1e-6);
}

}  // namespace
}  // namespace halfframe::tests
