// What moves is drawn: in three ways that agree, 10 km away as at home, with its shadow, and taking nothing from the
// heap.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/frame/pose.h"
#include "engine/frame/renderer.h"
#include "tests/frame/counted_new.h"
#include "tests/harness/gl_fixture.h"
#include "tests/motion/moving_scenes.h"

namespace halfframe::tests {
namespace {

constexpr int kSide = 128;

/// Straight along -Z at `centre`, `half_height` m to each side.
View view_at(const glm::vec3& centre, float half_height) {
    Camera camera;
    camera.orthographic = true;
    camera.half_height_m = half_height;
    camera.near_m = 0.5f;
    camera.far_m = 4.0f;
    camera.world_from_view[3] = glm::vec4(centre + glm::vec3(0.0f, 0.0f, 2.0f), 1.0f);
    return view_of(camera, kSide, kSide);
}

Scene lit(Scene scene) {
    scene.ambient = glm::vec3(0.5f);
    return scene;
}

struct Differences {
    int pixels = 0;   ///< that differ at all
    int covered = 0;  ///< of the first picture, that are not its background
};

Differences differences(const Picture& a, const Picture& b) {
    Differences result;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        const auto differs = [&](const Picture& one, std::size_t at, const Picture& other, std::size_t other_at) {
            return !std::equal(one.rgba.begin() + static_cast<std::ptrdiff_t>(at),
                               one.rgba.begin() + static_cast<std::ptrdiff_t>(at) + 3,
                               other.rgba.begin() + static_cast<std::ptrdiff_t>(other_at));
        };
        result.pixels += differs(a, i, b, i);
        result.covered += differs(a, i, a, 0);
    }
    return result;
}

class MovingFrame : public harness::GlFixture {
protected:
    Picture drawn(const Scene& scene, const View& view, std::optional<Skinning> way, Tier tier = Tier::console) {
        const FramePlan plan = plan_frame(scene, view, {.tier = tier}, caps(), all_effects());
        Renderer renderer(gl(), caps(), {.skinning = way});
        renderer.prepare(scene, plan);
        renderer.draw(view);
        EXPECT_EQ(renderer.first_gl_error(), "");
        used_.clear();
        for (const std::string& sentence : renderer.notices()) used_ += sentence + "\n";
        return renderer.read_display();
    }
    std::string used_;  ///< notices of the last picture
};

TEST_F(MovingFrame, ThreeWaysAgree) {
    Scene scene = lit(two_bones());
    Animator(scene).pose(scene, 0, 0.37);
    // The upper end of the strip and the bend, 0.5 mm of each: a pixel is 7.8 micrometres.
    const float angle = 0.37f * 1.5707963f;
    const glm::vec3 end{-std::sin(angle), 1.0f + std::cos(angle), 0.0f};
    for (const glm::vec3& centre : {end, glm::vec3(-0.25f, 0.75f, 0.0f)}) {
        const View view = view_at(centre, 0.0005f);
        const Picture in_uniforms = drawn(scene, view, Skinning::uniforms);
        EXPECT_NE(used_.find("in uniforms ("), std::string::npos) << used_;
        const Picture in_texture = drawn(scene, view, Skinning::texture);
        EXPECT_NE(used_.find("in a texture"), std::string::npos) << used_;
        const Picture on_cpu = drawn(scene, view, Skinning::cpu);
        EXPECT_NE(used_.find("on the CPU"), std::string::npos) << used_;
        const int covered = differences(in_uniforms, in_uniforms).covered;
        EXPECT_GT(covered, kSide) << "no edge in the picture";
        EXPECT_LT(covered, kSide * (kSide - 1)) << "no edge in the picture";
        EXPECT_EQ(differences(in_uniforms, in_texture).pixels, 0) << "the same numbers, fetched elsewhere";
        // One pixel along an edge of at most 1.5 * 128 pixels: another order of the sums moves a vertex by 1e-7 m, a
        // 78th of a pixel. Measured 0.
        EXPECT_LE(differences(in_uniforms, on_cpu).pixels, 8);
    }
}

TEST_F(MovingFrame, ThreeWaysAgreeAtLow) {
    Scene scene = lit(two_bones());
    Animator(scene).pose(scene, 0, 0.37);
    const View view = view_at({-0.4f, 1.0f, 0.0f}, 1.2f);
    const Picture in_uniforms = drawn(scene, view, Skinning::uniforms, Tier::low);
    EXPECT_NE(used_.find("in uniforms ("), std::string::npos) << used_;
    const Picture on_cpu = drawn(scene, view, Skinning::cpu, Tier::low);
    EXPECT_NE(used_.find("on the CPU"), std::string::npos) << used_;
    EXPECT_GT(differences(in_uniforms, in_uniforms).covered, 1000);
    EXPECT_LE(differences(in_uniforms, on_cpu).pixels, 2);
    drawn(scene, view, Skinning::texture, Tier::low);
    EXPECT_NE(used_.find("on the CPU"), std::string::npos)
        << "ES 2.0 fetches no texture in its vertex stage: " << used_;
}

TEST_F(MovingFrame, JointsDecideTheWay) {
    const View view = view_at({0.0f, 1.0f, 0.0f}, 1.2f);
    const std::vector<std::pair<int, const char*>> ways{
        {24, "in uniforms ("}, {64, "in uniforms ("}, {65, "in a texture"}, {300, "in a texture"}};
    for (const auto& [joints, says] : ways) {
        Scene scene = lit(many_bones(joints));
        Animator(scene).pose(scene, 0, 0.5);
        const Picture picture = drawn(scene, view, std::nullopt);
        EXPECT_NE(used_.find(says), std::string::npos) << joints << ": " << used_;
        const Picture on_cpu = drawn(scene, view, Skinning::cpu);
        EXPECT_GT(differences(picture, picture).covered, 1000) << joints;
        EXPECT_LE(differences(picture, on_cpu).pixels, 2) << joints;
    }
    for (const auto& [joints, says] : {std::pair{24, "in uniforms ("}, std::pair{25, "on the CPU"}}) {
        drawn(lit(many_bones(joints)), view, std::nullopt, Tier::low);
        EXPECT_NE(used_.find(says), std::string::npos) << joints << " at low: " << used_;
    }
}

TEST_F(MovingFrame, TenKilometresAwayIsTheSame) {
    // Whole metres, so that a float holds them: what differs is only what bones and eye are subtracted in.
    const glm::vec3 away{10000.0f, -3000.0f, 7000.0f};
    for (const Skinning way : {Skinning::uniforms, Skinning::texture, Skinning::cpu}) {
        Scene here = lit(two_bones()), there = lit(two_bones(away));
        Animator(here).pose(here, 0, 0.37);
        Animator(there).pose(there, 0, 0.37);
        // 16 mm wide: a pixel is 0.125 mm, a step of float at 10 km eight of them.
        const Picture near_by = drawn(here, view_at({-0.25f, 0.75f, 0.0f}, 0.008f), way);
        const Picture far_off = drawn(there, view_at(away + glm::vec3(-0.25f, 0.75f, 0.0f), 0.008f), way);
        const Differences found = differences(near_by, far_off);
        EXPECT_GT(found.covered, kSide);
        EXPECT_EQ(found.pixels, 0) << static_cast<int>(way);
    }
}

TEST_F(MovingFrame, MorphTargetsAreDrawnWhereTheySay) {
    Scene scene = lit(morphing_square());
    Animator(scene).pose(scene, 0, 1.0);  // 1 m up, 2 m wide: x -1..1, y 0.5..1.5
    for (const Tier tier : {Tier::low, Tier::console}) {
        const View view = view_at({0.0f, 1.0f, 0.0f}, 2.0f);  // 32 pixels a metre
        EXPECT_EQ(differences(drawn(scene, view, std::nullopt, tier), drawn(scene, view, std::nullopt, tier)).covered,
                  64 * 32)
            << name(tier);
    }
}

/// Draw calls of the pass "shadow" in one frame.
std::uint64_t shadow_draws(gl::EntryPoints& gl, Renderer& renderer, const View& view) {
    gl.ledger.clear();
    renderer.draw(view);
    return gl.ledger.pass(gl.ledger.pass_index("shadow")).draws;
}

TEST_F(MovingFrame, TheShadowFollowsThePose) {
    Scene scene = moving_scene();
    const View view =
        view_of(camera_looking({2.0f, 3.0f, 5.0f}, {0.5f, 0.8f, 0.0f}, 0.8f, world_box(scene)), kSide, kSide);
    const FramePlan plan = plan_frame(scene, view, {.tier = Tier::console}, caps(), all_effects());
    Renderer renderer(gl(), caps());
    Animator animator(scene);
    renderer.prepare(scene, plan);
    EXPECT_GT(shadow_draws(gl(), renderer, view), 0u);
    EXPECT_EQ(shadow_draws(gl(), renderer, view), 0u) << "nothing moved";
    animator.pose(scene, 0, 0.5);
    EXPECT_GT(shadow_draws(gl(), renderer, view), 0u) << "the skin bent";
    animator.pose(scene, 0, 0.5);
    EXPECT_EQ(shadow_draws(gl(), renderer, view), 0u) << "the same pose again";
    scene.nodes[2].morph_weights[0] = 0.1f;
    EXPECT_GT(shadow_draws(gl(), renderer, view), 0u) << "the square grew";
}

struct Steady {
    Tier tier;
    Skinning way;
};

std::string name_of(const Steady& steady) {
    constexpr std::array<const char*, 3> kWays{"Uniforms", "Texture", "Cpu"};
    return std::string(name(steady.tier)) + kWays[static_cast<std::size_t>(steady.way)];
}

class MovingSteadyFrame : public harness::GlFixture, public testing::WithParamInterface<Steady> {};

TEST_P(MovingSteadyFrame, TakesNothing) {
    Scene scene = moving_scene();
    const View view = view_of(camera_looking({2.0f, 3.0f, 5.0f}, {0.5f, 0.8f, 0.0f}, 0.8f, world_box(scene)), 96, 64);
    const FramePlan plan = plan_frame(scene, view, {.tier = GetParam().tier}, caps(), all_effects());
    Renderer renderer(gl(), caps(), {.skinning = GetParam().way});
    Animator animator(scene);
    renderer.prepare(scene, plan);
    for (int frame = 0; frame < 3; ++frame) {
        animator.pose(scene, 0, 0.1 * frame);
        renderer.draw(view);
    }
    gl().Finish();
    gl().ledger.clear();
    const std::uint64_t before = heap_allocations();
    for (int frame = 0; frame < 8; ++frame) {
        animator.pose(scene, 0, 0.05 + 0.11 * frame);
        renderer.draw(view);
    }
    EXPECT_EQ(heap_allocations() - before, 0u);
    EXPECT_EQ(gl().ledger.object_creations(), 0u);
    EXPECT_EQ(gl().ledger.program_links(), 0u);
    EXPECT_EQ(renderer.first_gl_error(), "");
}

INSTANTIATE_TEST_SUITE_P(Ways, MovingSteadyFrame,
                         testing::Values(Steady{Tier::low, Skinning::uniforms}, Steady{Tier::low, Skinning::cpu},
                                         Steady{Tier::console, Skinning::uniforms},
                                         Steady{Tier::console, Skinning::texture},
                                         Steady{Tier::reference, Skinning::cpu}),
                         [](const auto& each) { return name_of(each.param); });

class PoorDevice : public harness::GlFixture {
protected:
    [[nodiscard]] harness::GroundWish wish() const override { return {.device = "es2-minimum"}; }
};

TEST_F(PoorDevice, SkinsAndMorphsWithoutVertexArrayObjects) {
    Scene scene = moving_scene();
    Animator(scene).pose(scene, 0, 0.6);
    const View view =
        view_of(camera_looking({2.0f, 3.0f, 5.0f}, {0.5f, 0.8f, 0.0f}, 0.8f, world_box(scene)), kSide, kSide);
    const FramePlan plan = plan_frame(scene, view, {}, caps(), all_effects());
    std::vector<Picture> pictures;
    for (const Skinning way : {Skinning::uniforms, Skinning::cpu}) {
        Renderer renderer(gl(), caps(), {.skinning = way});
        renderer.prepare(scene, plan);
        renderer.draw(view);
        renderer.draw(view);
        EXPECT_EQ(renderer.first_gl_error(), "");
        pictures.push_back(renderer.read_display());
    }
    EXPECT_GT(differences(pictures[0], pictures[0]).covered, 2000);
    // Edges of the strip where a vertex rounds to the next pixel, and shades a code apart by 16-bit normals; measured 0
    EXPECT_LE(differences(pictures[0], pictures[1]).pixels, 20);
}

}  // namespace
}  // namespace halfframe::tests
