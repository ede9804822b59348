// Wetness written into textures: the same picture as live, within a stated distance, and the calls of a dry frame.
#include "engine/effects/wet_surface/wet_bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "content/content.h"
#include "engine/effects/wet_surface/wet_surface.h"
#include "perf/report/frame_report.h"
#include "tests/effects/lit_square.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

/// The test room, whose tiled floor and plain walls take up water.
Scene wet_room(float level, bool is_static) {
    Scene scene = content::open_scene("test_room");
    for (Material& material : scene.materials) {
        if (material.alpha_mode == AlphaMode::opaque) material.water = WaterMask::everywhere;
    }
    scene.wetness = Wetness{.level = level, .is_static = is_static};
    return scene;
}

View room_view(const Scene& scene) { return view_of(scene.cameras.front(), 320, 180); }

class WetBake : public harness::GlFixture {
protected:
    struct Frame {
        Picture picture;
        perf::CallReport calls;
        std::vector<ProgramUse> programs;
        std::size_t texture_bytes = 0;
    };
    Frame draw(const Scene& scene, Tier tier) {
        const View view = room_view(scene);
        const FramePlan frame = plan_frame(scene, view, {.tier = tier, .arithmetic = Arithmetic::full}, caps(), all_effects());
        Renderer renderer(gl(), caps());
        renderer.prepare(scene, frame);
        gl().ledger.clear();
        renderer.draw(view);
        Frame drawn{.picture = {}, .calls = perf::call_report(gl().ledger), .programs = renderer.program_uses()};
        drawn.picture = renderer.read_display();
        drawn.texture_bytes = renderer.texture_bytes();
        EXPECT_EQ(renderer.first_gl_error(), "");
        return drawn;
    }
};

struct Distance {
    double mean_codes = 0.0;
    double above_16 = 0.0;  ///< share of channels more than 16 codes apart
};

Distance distance(const Picture& a, const Picture& b) {
    Distance result;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        const double apart = static_cast<double>(std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
        result.mean_codes += apart / static_cast<double>(a.rgba.size());
        result.above_16 += apart > 16.0 ? 1.0 / static_cast<double>(a.rgba.size()) : 0.0;
    }
    return result;
}

TEST_F(WetBake, LooksAsLiveDoesWithinTheStatedDistance) {
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        for (const float level : {0.5f, 1.0f}) {
            const Frame live = draw(wet_room(level, false), tier);
            const Frame written = draw(wet_room(level, true), tier);
            Scene dry_room = wet_room(level, true);
            dry_room.wetness.reset();
            const Frame dry = draw(dry_room, tier);
            const Distance apart = distance(written.picture, live.picture);
            const Distance from_dry = distance(written.picture, dry.picture);
            // Measured: see the README of wet_surface. Eight bits of albedo and of roughness, and filtering roughness
            // instead of what follows from it. At low live has one porosity for a whole material.
            EXPECT_LT(apart.mean_codes, tier == Tier::low ? 2.4 : 0.8) << name(tier) << " " << level;
            EXPECT_LT(apart.above_16, tier == Tier::low ? 0.013 : 0.007) << name(tier) << " " << level;
            EXPECT_GT(from_dry.mean_codes, 4.0 * apart.mean_codes) << "water must show, " << name(tier);
            std::printf("[ measured ] %s wetness %.1f: written against live %.2f codes mean, %.2f %% above 16; "
                        "against dry %.2f\n",
                        name(tier), static_cast<double>(level), apart.mean_codes, 100.0 * apart.above_16,
                        from_dry.mean_codes);
        }
    }
}

TEST_F(WetBake, CostsAFrameWhatTheDryOneCosts) {
    for (const Tier tier : {Tier::low, Tier::console}) {
        const auto room = [](bool is_written) {
            Scene scene = wet_room(1.0f, is_written);
            // Dry ones that are very rough would have other programs at low, which light by vertex alone.
            for (Material& material : scene.materials) material.roughness = std::min(material.roughness, 0.7f);
            return scene;
        };
        Scene dry_room = room(true);
        dry_room.wetness.reset();
        const Frame dry = draw(dry_room, tier);
        const Frame written = draw(room(true), tier);
        const Frame live = draw(room(false), tier);
        ASSERT_EQ(written.calls.passes.size(), dry.calls.passes.size());
        bool same = true, live_same = live.calls.passes.size() == dry.calls.passes.size();
        for (std::size_t i = 0; i < dry.calls.passes.size(); ++i) {
            same = same && written.calls.passes[i].by_name == dry.calls.passes[i].by_name;
            live_same = live_same && live.calls.passes[i].by_name == dry.calls.passes[i].by_name;
        }
        EXPECT_TRUE(same) << name(tier);
        EXPECT_FALSE(live_same) << "the comparison sees what live water costs, " << name(tier);
        const auto water = [](const Frame& frame) {
            return std::ranges::count_if(frame.programs, [](const ProgramUse& use) {
                return use.defines.find("WATER") != std::string::npos;
            });
        };
        EXPECT_EQ(water(written), 0);
        EXPECT_GT(water(live), 0);
    }
}

TEST_F(WetBake, IsWrittenOutWholeAndDrawnAsThePlanDrawsIt) {
    const Scene scene = wet_room(0.7f, true);
    const Scene baked = with_written_wetness(scene);
    EXPECT_FALSE(baked.wetness.has_value()) << "nothing in it is live";
    EXPECT_GT(baked.images.size(), scene.images.size());
    EXPECT_TRUE(harness::same_picture(draw(baked, Tier::console).picture, draw(scene, Tier::console).picture,
                                      "wet_bake_whole"));
}

TEST(WetBakeRoughness, GoesThereAndBack) {
    for (float smoothness = 0.0f; smoothness <= 1.0f; smoothness += 0.01f)
        EXPECT_NEAR(smoothness_of(roughness_of(smoothness)), smoothness, 2e-6f);
}

TEST(WetBakeObstacles, AreSaid) {
    Scene scene = wet_room(1.0f, true);
    for (const Material& material : scene.materials) {
        if (material.water == WaterMask::none) continue;
        EXPECT_EQ(water_decision(scene, material).path, WaterPath::written) << material.name;
    }
    const auto textured = std::ranges::find_if(scene.materials, [](const Material& material) {
        return material.base_color_texture && material.metallic_roughness_texture;
    });
    ASSERT_NE(textured, scene.materials.end());
    textured->metallic_roughness_uv.scale = glm::vec2(2.0f);
    const WaterDecision apart = water_decision(scene, *textured);
    EXPECT_EQ(apart.path, WaterPath::live);
    EXPECT_EQ(apart.why, "its textures are mapped in different ways");
    textured->metallic_roughness_uv = {};
    textured->water = WaterMask::vertex_color;
    EXPECT_EQ(water_decision(scene, *textured).why, "its mask is in vertex colours");
    scene.puddles = Puddles{};
    EXPECT_EQ(water_decision(scene, *textured).why, "puddles stand on it");
}

TEST(WetBakeObstacles, WhatIsNotPorousKeepsItsNumbers) {
    Scene scene;
    scene.wetness = Wetness{.level = 1.0f};
    scene.materials.resize(2);
    scene.materials[0].roughness = 0.3f;
    scene.materials[0].metallic = 0.0f;
    scene.materials[1].roughness = 0.9f;  // metal
    scene.materials[1].base_color = glm::vec4(0.9f, 0.8f, 0.7f, 1.0f);
    for (Material& material : scene.materials) material.water = WaterMask::everywhere;
    const Scene baked = with_written_wetness(scene);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(baked.materials[i].base_color, scene.materials[i].base_color);
        EXPECT_EQ(baked.materials[i].roughness, scene.materials[i].roughness);
    }
}

}  // namespace
}  // namespace halfframe::tests
