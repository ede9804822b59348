// The map stays right far from the origin, in any unit, while things move, and is drawn only when it has to be.
#include <gtest/gtest.h>

#include "content/content.h"
#include "tests/effects/shadow/traced.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

class ShadowStability : public harness::GlFixture {};

const glm::vec3 kSun{0.5f, -1.0f, 0.3f};
const Box kAround{glm::vec3(-10.0f, 0.0f, -10.0f), glm::vec3(10.0f, 3.0f, 10.0f)};

Scene posts(const glm::vec3& sun = kSun) {
    Scene scene = sunny_ground(sun);
    add_body(scene, content::box({0.5f, 2.0f, 0.5f}), {0.5f, 1.0f, 0.25f});
    add_body(scene, content::box({1.5f, 0.25f, 1.0f}), {-0.75f, 1.0f, 0.5f});
    return scene;
}

Camera camera_at(const glm::vec3& offset) {
    Camera camera = camera_looking({3.0f, 6.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, 0.8f, kAround);
    camera.world_from_view[3] += glm::vec4(offset, 0.0f);
    return camera;
}

void expect_sound(const TracedGap& gap, const char* what) {
    EXPECT_GT(gap.edges, 50) << what;
    EXPECT_GT(gap.lit, 1000) << what;
    EXPECT_LT(gap.rms, 0.25) << what;  // the step along the normal: 0.12, beside a grazed wall 0.21
    EXPECT_GE(gap.darkest, 0.99) << what;
    EXPECT_LE(gap.lightest, 0.01) << what;
}

TEST_F(ShadowStability, FarFromTheOrigin) {
    for (const float distance_m : {0.0f, 1000.0f, 10000.0f}) {
        Scene scene = posts();
        const glm::vec3 offset(distance_m, 0.0f, -distance_m);
        for (Surface& surface : scene.surfaces) surface.world_from_local[3] += glm::vec4(offset, 0.0f);
        expect_sound(traced_gap(ground(), scene, view_of(camera_at(offset), 160, 120), Tier::console, Arithmetic::half),
                     distance_m > 0.0f ? "far away" : "at the origin");
    }
}

TEST_F(ShadowStability, InMillimetresAndInKilometres) {
    for (const float scale : {1000.0f, 0.001f}) {
        Scene scene = posts();
        for (Surface& surface : scene.surfaces)
            surface.world_from_local = glm::scale(glm::mat4(1.0f), glm::vec3(scale)) * surface.world_from_local;
        Camera camera = camera_at(glm::vec3(0.0f));
        camera.world_from_view[3] *= glm::vec4(glm::vec3(scale), 1.0f);
        camera.near_m *= scale;
        camera.far_m *= scale;
        expect_sound(traced_gap(ground(), scene, view_of(camera, 160, 120), Tier::console, Arithmetic::half),
                     scale > 1.0f ? "mm" : "km");
    }
}

TEST_F(ShadowStability, UnderAnOrthographicCamera) {
    Camera camera = camera_at(glm::vec3(0.0f));
    camera.orthographic = true;
    camera.half_height_m = 3.0f;
    expect_sound(traced_gap(ground(), posts(), view_of(camera, 160, 120), Tier::console, Arithmetic::full), "ortho");
}

TEST_F(ShadowStability, WithASunStraightDownAndAlongAWall) {
    expect_sound(traced_gap(ground(), posts({0.0f, -1.0f, 0.0f}), slanted_view(), Tier::console, Arithmetic::full),
                 "noon");
    // Almost along the posts' sides: their light is grazing, 1 in 50.
    expect_sound(traced_gap(ground(), posts({-0.02f, -0.7f, -0.7f}), slanted_view(), Tier::console, Arithmetic::full),
                 "along a wall");
}

TEST_F(ShadowStability, InsideTheCasters) {
    // A dark room: nothing gets in, whatever the eye is inside of.
    Scene scene = sunny_ground(kSun);
    add_body(scene, content::box({12.0f, 4.0f, 12.0f}), {0.0f, 1.0f, 0.0f});
    const View view = view_of(camera_looking({0.5f, 1.5f, 1.0f}, {0.0f, 0.0f, 0.0f}, 0.8f, kAround), 64, 48);
    for (const Tier tier : {Tier::console, Tier::reference}) {
        const Shares drawn = shares(ground(), scene, view, tier, Arithmetic::full);
        EXPECT_EQ(*std::ranges::max_element(drawn.values), 0.0) << name(tier);
    }
}

TEST_F(ShadowStability, EdgesDoNotCrawlWhenTheCameraMoves) {
    // An orthographic camera that moves by whole pixels of a third of a texel: the picture moves by whole pixels, and
    // its shadows with it.
    Camera camera = camera_looking({0.0f, 6.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.8f, kAround);
    camera.orthographic = true;
    camera.half_height_m = 0.1f;
    const Scene scene = posts();
    const float pixel_m = 2.0f * camera.half_height_m / 128.0f;
    const glm::vec4 pixel_step = camera.world_from_view[0] * pixel_m;
    camera.world_from_view[3] += glm::vec4(0.4f, 0.0f, 1.27f, 0.0f);  // above a corner of a shadow
    const FloatPicture first =
        with_shadow(ground(), scene, view_of(camera, 128, 128), Tier::console, Arithmetic::full, true);
    int different = 0, compared = 0, partly = 0;
    for (int step = 1; step <= 24; ++step) {
        camera.world_from_view[3] += pixel_step;
        const FloatPicture moved =
            with_shadow(ground(), scene, view_of(camera, 128, 128), Tier::console, Arithmetic::full, true);
        for (int y = 0; y < 128; ++y) {
            for (int x = step; x < 128; ++x) {
                const float before = pixel(first, x, y).r, after = pixel(moved, x - step, y).r;
                partly += before > 0.05f && before < 0.6f;
                // 0.02: the texel under a pixel's centre, interpolated in 24 bits
                different += std::abs(before - after) > 0.02f;
                ++compared;
            }
        }
    }
    EXPECT_GT(partly, 1000) << "no edge is in view";
    EXPECT_EQ(different, 0) << "of " << compared;
}

TEST_F(ShadowStability, TheMapIsDrawnAgainOnlyWhenSomethingItShowsHasMoved) {
    Scene scene = posts();
    View view = slanted_view(64, 48);
    const FramePlan frame = plan_frame(scene, view, {.tier = Tier::console}, caps(), all_effects());
    Renderer renderer(gl(), caps());
    renderer.prepare(scene, frame);
    const auto draws_of = [&](const View& seen) {
        gl().ledger.clear();
        renderer.draw(seen);
        std::uint64_t draws = 0;
        for (std::size_t i = 0; i < gl().ledger.pass_names().size(); ++i)
            draws += gl().ledger.pass(static_cast<int>(i)).draws;
        return draws;
    };
    const auto first = draws_of(view);
    const auto second = draws_of(view);
    const auto third = draws_of(view);
    EXPECT_EQ(first, second + 3) << "three casters";
    EXPECT_EQ(second, third) << "steady frames are alike";
    const Picture still = renderer.read_display();
    scene.surfaces[1].world_from_local[3].x += 0.5f;
    EXPECT_EQ(draws_of(view), first) << "a caster has moved";
    const Picture moved = renderer.read_display();
    EXPECT_GT(harness::difference(still, moved).max_channel_error, 50);
    EXPECT_TRUE(harness::same_picture(moved, render(scene, view, {.tier = Tier::console}).picture, "shadow_moved"));
    EXPECT_EQ(draws_of(view), second);
    scene.lights[0].direction = glm::normalize(glm::vec3(0.4f, -1.0f, 0.2f));
    EXPECT_EQ(draws_of(view), first) << "the sun has moved";
    const View away = view_of(camera_looking({3.0f, 6.0f, 5.0f}, {3.0f, 60.0f, 5.1f}, 0.4f, kAround), 64, 48);
    EXPECT_EQ(draws_of(away), second - 3) << "nothing is in view: neither casters nor surfaces";
    EXPECT_EQ(draws_of(view), first) << "and back";
    EXPECT_EQ(renderer.first_gl_error(), "");
}

TEST_F(ShadowStability, OffsetsDoNotReachOtherPasses) {
    const Scene scene = content::open_scene("test_room");
    for (const Tier tier : {Tier::low, Tier::console}) {
        const View view = view_of(scene.cameras[0], 64, 48);
        const FramePlan frame = plan_frame(scene, view, {.tier = tier}, caps(), all_effects());
        ASSERT_TRUE(frame.find("shadow")->in);
        Renderer renderer(gl(), caps());
        renderer.prepare(scene, frame);
        renderer.draw(view);
        GLint on = -1;
        gl().GetIntegerv(GL_POLYGON_OFFSET_FILL, &on);
        EXPECT_EQ(on, 0) << name(tier);
    }
}

TEST_F(ShadowStability, NoNanInAnyHardCase) {
    struct Case {
        const char* what;
        Scene scene;
        View view;
    };
    std::vector<Case> cases;
    cases.push_back({"one pixel", posts(), slanted_view(1, 1)});
    Scene point = posts();
    for (Mesh& mesh : point.meshes) {
        for (glm::vec3& position : mesh.positions) position = glm::vec3(0.0f);
    }
    for (Surface& surface : point.surfaces) surface.dynamic = true;
    cases.push_back({"no size", point, slanted_view(32, 24)});
    Scene plane = posts();
    plane.surfaces.resize(1);
    cases.push_back({"one plane", plane, slanted_view(32, 24)});
    cases.push_back({"sun along a plane", posts({1.0f, 0.0f, 0.0f}), slanted_view(32, 24)});
    Scene balls = posts();
    for (std::size_t i = 1; i < balls.surfaces.size(); ++i) balls.surfaces[i].dynamic = true;
    cases.push_back({"dynamic", balls, slanted_view(32, 24)});
    for (const Case& each : cases) {
        for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
            for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
                const Wishes wishes{
                    .tier = tier, .effect_switches = {{"shadow", true}}, .arithmetic = arithmetic, .census = true};
                Renderer renderer(gl(), caps());
                renderer.prepare(each.scene, plan_frame(each.scene, each.view, wishes, caps(), all_effects()));
                renderer.draw(each.view);
                EXPECT_EQ(renderer.first_gl_error(), "") << each.what;
                for (const CensusRow& row : renderer.census()) {
                    EXPECT_GT(row.values, 0u);
                    EXPECT_EQ(row.nan + row.inf, 0u) << each.what << ' ' << name(tier) << ' ' << row.target;
                }
            }
        }
    }
}

}  // namespace
}  // namespace halfframe::tests
