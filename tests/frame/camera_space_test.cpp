// Matrices relative to the eye, far from the origin, and what is in view.
#include "engine/frame/camera_space.h"

#include <gtest/gtest.h>

#include "tests/frame/planning.h"

namespace halfframe::tests {
namespace {

TEST(CameraSpace, IsTheSameTenKilometresAway) {
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, 2.0f, 1.0f};
    const View here = view_of(camera, 64, 64);
    const glm::vec3 far_away{8192.0f, 4096.0f, -8192.0f};  // exact in float, so that only our arithmetic is tested
    camera.world_from_view[3] += glm::vec4(far_away, 0.0f);
    const View there = view_of(camera, 64, 64);
    glm::mat4 local(1.0f), moved(1.0f);
    local[3] = {0.25f, 0.5f, -1.0f, 1.0f};
    moved[3] = local[3] + glm::vec4(far_away, 0.0f);
    EXPECT_EQ(eye_from_local(here, local), eye_from_local(there, moved));
    EXPECT_EQ(clip_from_local(here, local), clip_from_local(there, moved));
}

TEST(CameraSpace, KnowsWhatIsOutside) {
    const View view = square_view();
    const Box unit{.low = glm::vec3(-0.5f), .high = glm::vec3(0.5f)};
    EXPECT_FALSE(outside_view(unit, clip_from_local(view, glm::mat4(1.0f))));
    for (const glm::vec3 far_off :
         {glm::vec3(50, 0, 0), glm::vec3(-50, 0, 0), glm::vec3(0, 50, 0), glm::vec3(0, 0, 5)}) {
        glm::mat4 matrix(1.0f);
        matrix[3] = glm::vec4(far_off, 1.0f);
        EXPECT_TRUE(outside_view(unit, clip_from_local(view, matrix)))
            << far_off.x << ' ' << far_off.y << ' ' << far_off.z;
    }
    EXPECT_TRUE(outside_view(Box{}, clip_from_local(view, glm::mat4(1.0f)))) << "an empty box is nowhere";
}

TEST(CameraSpace, ScreenFractionHasKnownValues) {
    View view = square_view();
    view.clip_from_view =
        glm::mat4(1.0f);  // clip space is view space: a box of side 1 covers a quarter of the 2 x 2 screen
    view.view_from_world = glm::mat4(1.0f);
    view.eye = glm::vec3(0.0f);
    const Box unit{.low = glm::vec3(-0.5f), .high = glm::vec3(0.5f)};
    EXPECT_DOUBLE_EQ(screen_fraction(unit, clip_from_local(view, glm::mat4(1.0f))), 0.25);
    glm::mat4 aside(1.0f);
    aside[3] = {1.0f, 0.0f, 0.0f, 1.0f};
    EXPECT_DOUBLE_EQ(screen_fraction(unit, clip_from_local(view, aside)), 0.125) << "half of it is off the screen";
}

TEST(CameraSpace, ATightenedCameraHoldsTheSceneAndNoMore) {
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, 10.0f, 1.0f};
    camera.near_m = 0.001f;
    camera.far_m = 100000.0f;
    const Box box{.low = glm::vec3(-1.0f), .high = glm::vec3(1.0f)};
    const Camera tight = tightened(camera, box);
    EXPECT_LE(tight.near_m, 9.0f);
    EXPECT_GT(tight.near_m, 8.9f);
    EXPECT_GE(tight.far_m, 11.0f);
    EXPECT_LT(tight.far_m, 11.1f);

    camera.near_m = 9.5f;  // planes that cut the scene on purpose stay where they are
    camera.far_m = 10.5f;
    EXPECT_EQ(tightened(camera, box).near_m, 9.5f);
    EXPECT_EQ(tightened(camera, box).far_m, 10.5f);
    EXPECT_EQ(tightened(camera, Box{}).far_m, 10.5f);

    camera.near_m = 0.1f;
    camera.far_m = 50.0f;
    camera.world_from_view[3] = {0.0f, 0.0f, 0.0f, 1.0f};  // inside: the near plane stays, so that nothing is cut
    EXPECT_EQ(tightened(camera, box).near_m, 0.1f);
    camera.world_from_view[3] = {0.0f, 0.0f, -10.0f, 1.0f};  // the scene is behind the eye
    EXPECT_EQ(tightened(camera, box).far_m, 50.0f);
}

TEST(CameraSpace, ASingularMatrixHasAnUprightNormal) {
    glm::mat4 flat(1.0f);
    flat[1] = glm::vec4(0.0f);
    EXPECT_EQ(normal_from_local(flat), glm::mat4(1.0f));
}

}  // namespace
}  // namespace halfframe::tests
