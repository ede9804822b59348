// Meshes that touch show no background between them, though each is stored in 16 bits.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/harness/gl_fixture.h"

namespace halfframe {
namespace {

/// A black sheet in front of white, torn along a wavy line into two meshes with different boxes and put together again.
/// `shift_m` moves the right half: by nothing that a picture could show, but out of the space of the left one.
Scene torn_sheet(float shift_m) {
    Scene scene;
    scene.name = "torn sheet";
    scene.background = glm::vec3(1.0f);
    scene.materials.push_back({.name = "black", .base_color = {0.0f, 0.0f, 0.0f, 1.0f}, .double_sided = true});
    scene.meshes.resize(2);
    for (int i = 0; i <= 300; ++i) {
        const float y = static_cast<float>(i) * 0.0213f - 3.2f;
        const glm::vec3 shared(0.37f * std::sin(1.7f * y), y, 0.0f);
        scene.meshes[0].positions.insert(scene.meshes[0].positions.end(), {shared, {-6.1f, y, 0.0f}});
        scene.meshes[1].positions.insert(scene.meshes[1].positions.end(), {shared, {9.3f, 1.37f * y, 0.0f}});
    }
    for (int i = 0; i < 2; ++i) {
        scene.meshes[static_cast<std::size_t>(i)].primitive = Primitive::triangle_strip;
        Surface surface;
        surface.mesh = i;
        surface.world_from_local[3].x = i == 1 ? shift_m : 0.0f;
        scene.surfaces.push_back(surface);
    }
    return scene;
}

class Cracks : public harness::GlFixture {
protected:
    /// White pixels inside a picture that the sheet fills, over views that look along the tear.
    int white_pixels(const Scene& scene, VertexPrecision vertices) {
        int white = 0;
        for (int step = 0; step < 12; ++step) {
            Camera camera;
            camera.world_from_view[3] = {0.01f * static_cast<float>(step), 0.17f * static_cast<float>(step) - 1.0f,
                                         0.5f + 0.05f * static_cast<float>(step), 1.0f};
            camera.near_m = 0.01f;
            const View view = view_of(camera, 320, 320);
            const Wishes wishes{.effect_switches = {{"bloom", false}}, .vertices = vertices};
            const Picture picture =
                render(scene, view, wishes, all_effects(), harness::FlatPicture::is_expected).picture;
            for (std::size_t i = 0; i < picture.rgba.size(); i += 4) white += picture.rgba[i] > 60 ? 1 : 0;
        }
        return white;
    }
};

TEST_F(Cracks, NoneBetweenMeshesThatShareCorners) {
    EXPECT_EQ(white_pixels(torn_sheet(0.0f), VertexPrecision::full), 0);
    EXPECT_EQ(white_pixels(torn_sheet(0.0f), VertexPrecision::half), 0);
}

// 1e-30 m: the same picture in 32 bits, but the halves no longer share a space, so each is stored in steps of its own
// box (0.1 and 0.2 mm). Without that the test above could not fail.
TEST_F(Cracks, ShowWhereNeighboursAreStoredApart) {
    EXPECT_EQ(white_pixels(torn_sheet(1e-30f), VertexPrecision::full), 0);
    EXPECT_GT(white_pixels(torn_sheet(1e-30f), VertexPrecision::half), 0);
}

}  // namespace
}  // namespace halfframe
