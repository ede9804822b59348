// Boxes of scenes and cameras made from boxes (engine/frame/scene.h), on scenes of content.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "content/shapes.h"
#include "engine/error.h"
#include "engine/frame/scene.h"

namespace halfframe::tests {
namespace {

TEST(SceneBoxes, LocalBoxCountsWhatIsDrawn) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 2, 3}, {100, 100, 100}};
    mesh.indices = {0, 1, 0};
    EXPECT_EQ(local_box(mesh).high, glm::vec3(1, 2, 3));
    mesh.indices.clear();
    EXPECT_EQ(local_box(mesh).high, glm::vec3(100));
    mesh.indices = {3};
    EXPECT_THROW((void)local_box(mesh), Mistake);
}

TEST(SceneBoxes, LocalBoxHoldsEveryVertexOfMeshesOfAnyLength) {
    for (int count = 1; count < 38; ++count) {
        for (int outermost = 0; outermost < count; ++outermost) {
            Mesh mesh;
            for (int i = 0; i < count; ++i) {
                mesh.positions.push_back(i == outermost ? glm::vec3(-7, 9, -8) : glm::vec3(-1, 1, 2));
                mesh.indices.push_back(static_cast<std::uint32_t>(count - 1 - i));
            }
            const Box box = local_box(mesh);
            EXPECT_EQ(box.low, glm::vec3(-7, count > 1 ? 1 : 9, -8)) << outermost << " of " << count;
            EXPECT_EQ(box.high, glm::vec3(count > 1 ? -1 : -7, 9, count > 1 ? 2 : -8)) << outermost << " of " << count;
            mesh.indices.clear();
            EXPECT_EQ(local_box(mesh).low, box.low) << outermost << " of " << count;
        }
    }
}

TEST(SceneBoxes, WorldBoxFollowsTheTransform) {
    const Box box{glm::vec3(-1), glm::vec3(1)};
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0f), {10, 0, 0}), 0.785398f, glm::vec3(0, 1, 0));
    const Box world = world_box(box, turned);
    EXPECT_NEAR(world.high.x, 10.0f + std::sqrt(2.0f), 1e-5);  // float rounding at 11
    EXPECT_NEAR(world.high.y, 1.0f, 1e-6);
    EXPECT_TRUE(world_box(Box{}, turned).empty());
    EXPECT_TRUE(world_box(Scene{}).empty());
}

class Framing : public ::testing::TestWithParam<Box> {};

TEST_P(Framing, TheWholeBoxIsInsideThePicture) {
    const Box box = GetParam();
    for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(300, 900), glm::ivec2(64, 64)}) {
        const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
        const View view = view_of(camera_framing(box, aspect), size.x, size.y);
        float most = 0.0f;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::vec4 clip = view.clip_from_world() * glm::vec4(corner & 1u ? box.high.x : box.low.x,
                                                                      corner & 2u ? box.high.y : box.low.y,
                                                                      corner & 4u ? box.high.z : box.low.z, 1.0f);
            ASSERT_GT(clip.w, 0.0f);
            EXPECT_LE(std::abs(clip.x), clip.w);
            EXPECT_LE(std::abs(clip.y), clip.w);
            EXPECT_LE(std::abs(clip.z), clip.w);
            most = std::max({most, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
        }
        EXPECT_GT(most, 0.7f) << "the box fills the picture in one direction";
    }
}

INSTANTIATE_TEST_SUITE_P(Boxes, Framing,
                         ::testing::Values(Box{glm::vec3(-1), glm::vec3(1)}, Box{{0, 0, 0}, {100, 1, 2}},
                                           Box{{5, 5, 5}, {5, 9, 5}}, Box{{-1e-3f, 0, 0}, {1e-3f, 1e-3f, 2e-3f}},
                                           Box{{-5000, 0, -5000}, {5000, 10, 5000}}),
                         [](const auto& each) { return std::to_string(each.index); });

TEST(Cameras, EmptyAndPointBoxesGiveFiniteCameras) {
    for (const Box& box : {Box{}, Box{glm::vec3(3), glm::vec3(3)}}) {
        const Camera camera = camera_framing(box, 1.5f);
        EXPECT_GT(camera.near_m, 0.0f);
        EXPECT_LT(camera.near_m, camera.far_m);
        EXPECT_TRUE(std::isfinite(camera.world_from_view[3][2]));
    }
}

TEST(Cameras, LookingStraightDownIsFine) {
    const Camera camera = camera_looking({0, 5, 0}, {0, 0, 0}, 1.0f, Box{glm::vec3(-1), glm::vec3(1)});
    EXPECT_NEAR(glm::determinant(glm::mat3(camera.world_from_view)), 1.0f, 1e-5);  // rounding of a 3 x 3 product
    EXPECT_EQ(glm::vec3(camera.world_from_view[2]), glm::vec3(0, 1, 0));
    EXPECT_THROW((void)camera_looking({1, 1, 1}, {1, 1, 1}, 1.0f, Box{}), Mistake);
}

TEST(Cameras, OrthographicViewKeepsSizes) {
    Camera camera;
    camera.orthographic = true;
    camera.half_height_m = 2.0f;
    camera.near_m = 1.0f;
    camera.far_m = 9.0f;
    const View view = view_of(camera, 200, 100);
    const glm::vec4 clip = view.clip_from_world() * glm::vec4(4, 2, -9, 1);
    EXPECT_NEAR(clip.x, 1.0f, 1e-6);
    EXPECT_NEAR(clip.y, 1.0f, 1e-6);
    EXPECT_NEAR(clip.z, 1.0f, 1e-6);
    EXPECT_EQ(clip.w, 1.0f);
}

}  // namespace
}  // namespace halfframe::tests
