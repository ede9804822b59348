// What faces away is not given to the device, and no pixel of any tier moves for that.
#include <gtest/gtest.h>

#include "content/shapes.h"
#include "engine/frame/facing.h"
#include "engine/frame/renderer.h"
#include "engine/gl/call_number.h"
#include "tests/frame/counted_new.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

/// The triangles of a mesh in pieces too small to be ordered.
std::vector<Mesh> pieces_of(const Mesh& mesh) {
    std::vector<Mesh> pieces;
    constexpr std::size_t kIndices = 3 * (kFacingTriangles - 1);
    for (std::size_t i = 0; i < mesh.indices.size(); i += kIndices) {
        pieces.push_back(mesh);
        pieces.back().indices.assign(
            mesh.indices.begin() + static_cast<std::ptrdiff_t>(i),
            mesh.indices.begin() + static_cast<std::ptrdiff_t>(std::min(i + kIndices, mesh.indices.size())));
    }
    return pieces;
}

/// Three balls, one half behind another, whole or in pieces.
Scene balls(bool whole, const Material& material = {.roughness = 0.4f}) {
    Scene scene;
    scene.name = "balls";
    const Mesh ball = content::sphere(1.0f);
    scene.meshes = whole ? std::vector{ball} : pieces_of(ball);
    scene.materials = {material};
    scene.lights = {{.kind = LightKind::sun, .color = glm::vec3(2.0f), .direction = {0.3f, -0.5f, -1.0f}},
                    {.kind = LightKind::point, .color = glm::vec3(3.0f), .position = {2.0f, 1.0f, 3.0f}}};
    scene.ambient = glm::vec3(0.1f);
    for (int i = 0; i < 3; ++i) {
        for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
            Surface surface{.mesh = static_cast<int>(mesh)};
            surface.world_from_local[3] = glm::vec4(1.5f * static_cast<float>(i - 1), 0.3f * static_cast<float>(i),
                                                    -1.2f * static_cast<float>(i), 1.0f);
            scene.surfaces.push_back(surface);
        }
    }
    return scene;
}

Camera camera_at(float distance_m) {
    return camera_looking({0.2f * distance_m, 0.3f * distance_m, distance_m}, glm::vec3(0.0f), 0.7f,
                          world_box(balls(true)));
}

class FacingFrame : public harness::GlFixture {
protected:
    struct Drawn {
        std::uint32_t draws = 0;      ///< of the pass of surfaces
        std::uint64_t triangles = 0;  ///< given to the device in it
        std::uint64_t allocations = 0;
        Picture picture;
    };
    /// The second frame of a renderer.
    Drawn draw(const Scene& scene, const Camera& camera, Wishes wishes = {}) {
        Renderer renderer(gl(), caps());
        const View view = view_of(camera, 240, 160);
        wishes.vertices = VertexPrecision::full;  // pieces store their positions in the box of the whole, or in none
        renderer.prepare(scene, plan_frame(scene, view, wishes, caps(), all_effects()));
        renderer.draw(view);
        gl().ledger.clear();
        const std::uint64_t before = heap_allocations();
        renderer.draw(view);
        Drawn drawn{.allocations = heap_allocations() - before};
        const gl::PassCalls& pass = gl().ledger.pass(gl().ledger.pass_index("surface"));
        drawn.draws = pass.draws;
        drawn.triangles = pass.vertices / 3;
        drawn.picture = renderer.read_display();
        EXPECT_EQ(renderer.first_gl_error(), "");
        EXPECT_GT(harness::coverage(drawn.picture), 0.05);
        return drawn;
    }
};

TEST_F(FacingFrame, MovesNoPixel) {
    const std::uint64_t all = 3 * balls(true).meshes[0].indices.size() / 3;
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        for (const float distance : {12.0f, 4.0f}) {
            if (tier == Tier::low && distance < 10.0f) continue;  // pieces, which are smaller, are lit by vertex still
            for (const bool parallel : {false, true}) {
                Camera camera = camera_at(distance);
                camera.orthographic = parallel;
                camera.half_height_m = 0.35f * distance;
                const Drawn ordered = draw(balls(true), camera, {.tier = tier});
                const Drawn pieces = draw(balls(false), camera, {.tier = tier});
                EXPECT_TRUE(harness::same_picture(ordered.picture, pieces.picture, std::string("facing_") + name(tier)))
                    << name(tier) << " " << distance << " m" << (parallel ? ", parallel" : "");
                EXPECT_LE(pieces.triangles, all);
                EXPECT_LT(ordered.triangles, all * 5 / 6) << name(tier) << " " << distance;
                EXPECT_LE(ordered.draws, 3 * 6u);
                EXPECT_EQ(ordered.allocations, 0u);
            }
        }
    }
}

TEST_F(FacingFrame, APrepassLeavesTheSameOut) {
    Wishes wishes{.tier = Tier::console};
    wishes.effect_switches = {{"depth_prepass", true}};
    const Drawn ordered = draw(balls(true), camera_at(5.0f), wishes);
    EXPECT_TRUE(
        harness::same_picture(ordered.picture, draw(balls(false), camera_at(5.0f), wishes).picture, "facing_prepass"));
    const gl::PassCalls& depth = gl().ledger.pass(gl().ledger.pass_index("depth_prepass"));
    EXPECT_GT(depth.draws, 0u);
}

TEST_F(FacingFrame, BacksThatShowAreDrawn) {
    const Scene scene = balls(true, {.roughness = 0.4f, .double_sided = true});
    const Drawn drawn = draw(scene, camera_at(5.0f), {.tier = Tier::console});
    EXPECT_EQ(drawn.draws, 3u);
    EXPECT_EQ(drawn.triangles, scene.meshes[0].indices.size());
}

TEST_F(FacingFrame, WhatBlendsKeepsItsOrder) {
    Scene scene = balls(true);
    scene.materials.push_back({.alpha_mode = AlphaMode::blend});
    scene.surfaces.push_back(scene.surfaces[0]);
    scene.surfaces.back().material = 1;
    EXPECT_EQ(draw(scene, camera_at(5.0f), {.tier = Tier::console}).draws, 3u);
}

}  // namespace
}  // namespace halfframe::tests
