// The low tier's blob against its curve in double; where it lies, and where there is none.
#include "engine/effects/shadow/shadow_blob.h"

#include <gtest/gtest.h>

#include "tests/effects/shadow/traced.h"

namespace halfframe::tests {
namespace {

class ShadowBlob : public harness::GlFixture {};

/// A ball of half a metre, its lowest point `height_m` above the ground.
Scene ball_above(float height_m, float ground_size_m = 20.0f) {
    Scene scene = sunny_ground({-0.3f, -1.0f, 0.2f}, ground_size_m);
    add_body(scene, content::sphere(0.5f), {0.0f, 0.5f + height_m, 0.0f});
    scene.surfaces.back().dynamic = true;
    return scene;
}

Blob blob_of(const Scene& scene) {
    const Surface& surface = scene.surfaces.back();
    const auto blob =
        blob_under(world_box(local_box(scene.meshes[static_cast<std::size_t>(surface.mesh)]), surface.world_from_local),
                   grounds_of(scene));
    EXPECT_TRUE(blob.has_value());
    return blob.value_or(Blob{});
}

TEST_F(ShadowBlob, HasTheShapeOfItsCurveOnEveryStorage) {
    const Scene scene = ball_above(0.25f);
    const Blob blob = blob_of(scene);
    // A flat view: with an offset too small the blob would flicker with the ground's own depth.
    const View view = view_of(camera_looking({0.0f, 1.0f, 7.0f}, {0.0f, 0.0f, 0.0f}, 0.5f,
                                             Box{glm::vec3(-10.0f, 0.0f, -10.0f), glm::vec3(10.0f, 3.0f, 10.0f)}),
                              160, 96);
    const TracedScene traced = traced_scene(scene, scene.lights[0].direction);
    for (const gl::PixelFormat storage : {gl::PixelFormat::rgba8, gl::PixelFormat::rgba32f}) {
        for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
            const auto draw = [&](bool on) {
                const Wishes wishes{.tier = Tier::low,
                                    .effect_switches = {{"shadow", on}},
                                    .arithmetic = arithmetic,
                                    .storage = storage};
                const FramePlan frame = plan_frame(scene, view, wishes, caps(), all_effects());
                Renderer renderer(gl(), caps());
                renderer.prepare(scene, frame);
                renderer.draw(view);
                EXPECT_EQ(renderer.first_gl_error(), "");
                const bool is_display = storage == gl::PixelFormat::rgba8;
                return renderer.read_target(is_display ? frame.display : frame.target_index("scene_color"));
            };
            const FloatPicture on = draw(true);
            const FloatPicture off = draw(false);
            double worst = 0.0, wrong = 0.0;
            int inside = 0;
            for (int y = 0; y < view.height; ++y) {
                for (int x = 0; x < view.width; ++x) {
                    const SeenPlace place = seen_place(traced, view, x, y);
                    if (!place.found || place.at[1] > 1e-6) continue;  // the ball, or the sky
                    const double distance = std::hypot(place.at[0] / blob.radius.x, place.at[2] / blob.radius.y);
                    const double left = reference::blob_left(distance, blob.strength);
                    const double expected = storage == gl::PixelFormat::rgba8 ? left : left * left;
                    const double got = double{pixel(on, x, y).g} / double{pixel(off, x, y).g};
                    worst = std::max(worst, std::abs(got - expected));
                    wrong = std::max(wrong, std::abs(got - reference::blob_left(distance * 1.1, blob.strength)));
                    inside += distance < 1.0;
                }
            }
            EXPECT_GT(inside, 200);
            // 8e-3: two display codes of 8 bits; 4.2e-3 found. Floats: half gives 9e-4, full 1e-5
            EXPECT_LT(worst, storage == gl::PixelFormat::rgba8 ? 8e-3 : 2e-3)
                << name(storage) << ' ' << name(arithmetic);
            EXPECT_GT(wrong, 0.03) << "the check cannot tell a blob that is a tenth too small";
        }
    }
}

TEST(ShadowBlobPlace, LiesOnTheHighestStaticBoxBelowAndFadesWithHeight) {
    Scene scene = ball_above(0.0f);
    const Blob standing = blob_of(scene);
    EXPECT_NEAR(standing.centre.y, 0.0f, 1e-6f);
    scene.surfaces.back().world_from_local[3].y += 0.5f;
    const Blob above = blob_of(scene);
    EXPECT_LT(above.strength, standing.strength);
    EXPECT_GT(above.radius.x, standing.radius.x);
    EXPECT_NEAR(above.centre.y, 0.0f, 1e-6f);  // a quad turned by 90 degrees in fp32
    const Scene far = ball_above(1.5f);
    EXPECT_FALSE(blob_under(world_box(local_box(far.meshes[1]), far.surfaces[1].world_from_local), grounds_of(far)))
        << "too high";
    // A table between ball and ground.
    scene.surfaces.insert(scene.surfaces.begin(), scene.surfaces[0]);
    scene.meshes.push_back(content::box({2.0f, 0.25f, 2.0f}));
    scene.surfaces[0].mesh = 2;
    scene.surfaces[0].world_from_local = glm::translate(glm::mat4(1.0f), {0.0f, 0.25f, 0.0f});
    EXPECT_FLOAT_EQ(blob_of(scene).centre.y, 0.375f);
    EXPECT_GT(blob_of(scene).span.x, -2.0f);
}

TEST(ShadowBlobPlace, IsCutAtTheEdgeOfItsGround) {
    Scene scene = ball_above(0.0f, 0.5f);
    const Blob blob = blob_of(scene);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(std::abs(blob.span[i]), 0.25f / blob.radius.x, 1e-5f) << i;
    const std::vector<Box> none;
    EXPECT_FALSE(blob_under(Box{glm::vec3(0.0f), glm::vec3(1.0f)}, none)) << "nothing to lie on";
    EXPECT_FALSE(blob_under(Box{}, grounds_of(scene)));
    EXPECT_FALSE(blob_under(Box{glm::vec3(0.0f), glm::vec3(0.0f)}, grounds_of(scene))) << "no size";
    const Box room{glm::vec3(-5.0f, -1.0f, -5.0f), glm::vec3(5.0f, 4.0f, 5.0f)};
    const auto inside = blob_under(Box{glm::vec3(0.0f), glm::vec3(1.0f)}, std::span(&room, 1));
    ASSERT_TRUE(inside.has_value());
    EXPECT_EQ(inside->centre.y, 0.0f) << "in a room of one mesh an object is taken to stand";
}

TEST_F(ShadowBlob, StaticSurfacesHaveNone) {
    Scene scene = ball_above(0.0f);
    EXPECT_TRUE(plan(scene, {.tier = Tier::low}).find("shadow")->in);
    scene.surfaces.back().dynamic = false;
    const FramePlan frame = plan(scene, {.tier = Tier::low});
    EXPECT_FALSE(frame.find("shadow")->in);
    EXPECT_EQ(frame.find("shadow")->why, "no surface is dynamic, and this tier shadows nothing else");
}

}  // namespace
}  // namespace halfframe::tests
