// Several renderers in one process draw what one alone draws: nothing in the library is global, and none takes the GL
// state that it left for the state it finds.
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "engine/frame/renderer.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/image_compare.h"

namespace halfframe {
namespace {

using harness::Ground;
using harness::GroundWish;
using harness::same_picture;

constexpr int kWidth = 96;  // pixels
constexpr int kHeight = 64;

/// A pyramid and a floor, lit from the side. `variant` changes colours, the background and the place, so that the
/// pictures of two variants share almost no pixel.
Scene make_scene(int variant) {
    Scene scene;
    scene.name = variant == 0 ? "red pyramid" : "blue pyramid";
    Mesh pyramid;
    pyramid.name = "pyramid";
    pyramid.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {0, 1.5f, 0}};
    for (const glm::vec3& position : pyramid.positions) {
        pyramid.normals.push_back(glm::normalize(position + glm::vec3{0, 0.5f, 0}));
    }
    pyramid.indices = {0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0};
    Mesh floor;
    floor.name = "floor";
    floor.positions = {{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}};
    floor.normals.assign(4, {0, 1, 0});
    floor.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes = {pyramid, floor};
    Material paint;
    paint.name = "paint";
    paint.base_color = variant == 0 ? glm::vec4{0.8f, 0.1f, 0.1f, 1} : glm::vec4{0.1f, 0.2f, 0.9f, 1};
    paint.metallic = 0.0f;
    paint.roughness = 0.5f;
    Material ground;
    ground.name = "floor";
    ground.metallic = 0.0f;
    scene.materials = {paint, ground};
    const float shift_m = variant == 0 ? -0.5f : 0.7f;
    scene.surfaces = {{.name = "pyramid", .mesh = 0, .material = 0}, {.name = "floor", .mesh = 1, .material = 1}};
    scene.surfaces[0].world_from_local[3] = {shift_m, 0, 0, 1};
    scene.lights = {{.kind = LightKind::sun,
                     .name = "sun",
                     .color = {1, 0.9f, 0.8f},
                     .direction = glm::normalize(glm::vec3{-1, -2, -0.5f})}};
    if (variant != 0) scene.lights.push_back({.kind = LightKind::point, .name = "lamp", .position = {1, 2, 2}});
    scene.ambient = {0.05f, 0.05f, 0.05f};
    scene.background = variant == 0 ? glm::vec3{0.1f} : glm::vec3{0.5f, 0.6f, 0.2f};
    if (variant != 0) scene.sky = Sky{};
    return scene;
}

View make_view(const Scene& scene) {
    return view_of(camera_framing(world_box(scene), static_cast<float>(kWidth) / kHeight), kWidth, kHeight);
}

/// One renderer with the scene it draws; the address of the scene stays.
struct Drawing {
    Drawing(Ground& ground, int variant, const Wishes& wishes = {})
        : scene(make_scene(variant)), view(make_view(scene)), renderer(ground.gl, ground.caps) {
        renderer.prepare(scene, plan_frame(scene, view, wishes, ground.caps, all_effects()));
    }
    Picture draw() {
        renderer.draw(view);
        Picture picture = renderer.read_display();
        EXPECT_EQ(renderer.first_gl_error(), "") << scene.name;
        return picture;
    }
    Scene scene;
    View view;
    Renderer renderer;
};

/// The picture of a renderer that is alone on its context.
Picture alone(const GroundWish& wish, int variant, const Wishes& wishes = {}) {
    Ground ground(wish);
    return Drawing(ground, variant, wishes).draw();
}

class ManyRenderers : public testing::TestWithParam<platform::Backend> {
protected:
    void SetUp() override {
        if (const auto made = harness::make_ground(wish()); !made.ground) GTEST_SKIP() << made.reason;
        expected_ = {alone(wish(), 0), alone(wish(), 1)};
        for (const Picture& picture : expected_)
            ASSERT_GT(harness::coverage(picture), 0.1) << "a blank picture proves nothing";
        ASSERT_FALSE(harness::difference(expected_[0], expected_[1]).exact())
            << "two scenes with one picture prove nothing";
    }
    [[nodiscard]] static GroundWish wish() { return {.backend = GetParam()}; }
    std::vector<Picture> expected_;
};

INSTANTIATE_TEST_SUITE_P(Backends, ManyRenderers, testing::Values(platform::Backend::egl, platform::Backend::osmesa),
                         [](const auto& backend) { return std::string(name(backend.param)); });

TEST_P(ManyRenderers, each_on_its_own_context) {
    Ground first(wish());
    auto red = std::make_unique<Drawing>(first, 0);
    Ground second(wish());
    auto blue = std::make_unique<Drawing>(second, 1);
    for (int turn = 0; turn < 3; ++turn) {
        first.context.make_current();
        EXPECT_TRUE(same_picture(red->draw(), expected_[0], "own_context_red"));
        second.context.make_current();
        EXPECT_TRUE(same_picture(blue->draw(), expected_[1], "own_context_blue"));
    }
    // A renderer gives its GL objects back to the context that is current: its own.
    first.context.make_current();
    red.reset();
    second.context.make_current();
    EXPECT_TRUE(same_picture(blue->draw(), expected_[1], "own_context_blue_last"));
}

TEST_P(ManyRenderers, both_on_one_context) {
    Ground ground(wish());
    Drawing red(ground, 0);
    Drawing blue(ground, 1);
    for (int turn = 0; turn < 3; ++turn) {
        EXPECT_TRUE(same_picture(red.draw(), expected_[0], "one_context_red"));
        EXPECT_TRUE(same_picture(blue.draw(), expected_[1], "one_context_blue"));
    }
}

TEST_P(ManyRenderers, one_goes_and_the_other_draws_on) {
    Ground ground(wish());
    Drawing red(ground, 0);
    {
        Drawing blue(ground, 1);
        EXPECT_TRUE(same_picture(blue.draw(), expected_[1], "short_lived_blue"));
    }
    EXPECT_TRUE(same_picture(red.draw(), expected_[0], "survivor_red"));
}

TEST_P(ManyRenderers, two_tables_of_entry_points_on_one_context) {
    Ground ground(wish());
    gl::EntryPoints own(ground.context.loader());
    const gl::Caps caps = gl::read_caps(own);
    Drawing red(ground, 0);
    const Scene scene = make_scene(1);
    const View view = make_view(scene);
    Renderer blue(own, caps);
    blue.prepare(scene, plan_frame(scene, view, {}, caps, all_effects()));
    for (int turn = 0; turn < 2; ++turn) {
        EXPECT_TRUE(same_picture(red.draw(), expected_[0], "two_tables_red"));
        blue.draw(view);
        EXPECT_TRUE(same_picture(blue.read_display(), expected_[1], "two_tables_blue"));
    }
}

TEST_P(ManyRenderers, tiers_side_by_side) {
    Wishes low;
    low.tier = Tier::low;
    const Picture expected_low = alone(wish(), 1, low);
    Ground ground(wish());
    Drawing usual(ground, 1);
    Drawing poor(ground, 1, low);
    for (int turn = 0; turn < 2; ++turn) {
        EXPECT_TRUE(same_picture(usual.draw(), expected_[1], "tiers_usual"));
        EXPECT_TRUE(same_picture(poor.draw(), expected_low, "tiers_low"));
    }
}

// Each thread has a context of its own, as EGL wants it; the library has no state that they could share.
TEST_P(ManyRenderers, on_two_threads_at_once) {
    std::vector<Picture> pictures(2);
    {
        std::vector<std::jthread> threads;
        for (int variant = 0; variant < 2; ++variant) {
            threads.emplace_back([variant, &picture = pictures[static_cast<std::size_t>(variant)]] {
                Ground ground(wish());
                Drawing drawing(ground, variant);
                for (int frame = 0; frame < 5; ++frame) picture = drawing.draw();
            });
        }
    }
    EXPECT_TRUE(same_picture(pictures[0], expected_[0], "threads_red"));
    EXPECT_TRUE(same_picture(pictures[1], expected_[1], "threads_blue"));
}

}  // namespace
}  // namespace halfframe
