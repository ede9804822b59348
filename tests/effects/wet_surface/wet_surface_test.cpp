// wet_surface: known answers of the talk's formula at every tier, what stays as it is, and when the effect is in.
#include "engine/effects/wet_surface/wet_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "content/content.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/effects/wet_surface/wet_bake.h"
#include "engine/effects/wet_surface/wet_material.h"
#include "engine/effects/wet_surface/wet_surface_reference.h"
#include "tests/effects/lit_square.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

constexpr double kDielectric = 0.0437;

/// The wide square under constant light, soaking everywhere, in the frame and not in textures.
Scene wet_square(float level) {
    Scene scene = wide_square();
    scene.ambient = glm::vec3(1.0f);
    scene.materials[0].base_color = glm::vec4(0.6f, 0.3f, 0.1f, 1.0f);
    scene.materials[0].roughness = 0.8f;
    scene.materials[0].water = WaterMask::everywhere;
    scene.wetness = Wetness{.level = level, .is_static = false};
    return scene;
}

double smoothness_of_roughness(double roughness) {
    return reference::smoothness_from_power(reference::power_from_roughness(roughness));
}

/// What the square shows head on: albedo and glossy Fresnel of the wet material times the light of 1.
std::array<double, 3> shown(const reference::WetMaterial& wet, double n_v) {
    std::array<double, 3> light{};
    for (std::size_t i = 0; i < 3; ++i)
        light[i] = wet.albedo[i] + reference::fresnel_glossy(wet.specular[i], wet.smoothness, n_v);
    return light;
}

class WetSurface : public harness::GlFixture {
protected:
    glm::vec3 centre(const Scene& scene, const On& on) {
        const FloatPicture picture = scene_color(ground(), scene, square_view(8, 8), on.tier, on.arithmetic);
        return pixel(picture, 4, 4);
    }
};

TEST_F(WetSurface, DarkensAndSmoothsAsTheFormulaSays) {
    for (const On& on : kEverywhere) {
        for (const float level : {0.25f, 0.5f, 1.0f}) {
            for (const float roughness : {0.5f, 0.62f, 0.8f, 1.0f}) {
                Scene scene = wet_square(level);
                scene.materials[0].roughness = roughness;
                const reference::DryMaterial dry{{0.6, 0.3, 0.1},
                                                 {kDielectric, kDielectric, kDielectric},
                                                 smoothness_of_roughness(static_cast<double>(roughness))};
                const auto expected = shown(reference::wet_material(dry, static_cast<double>(level)), 1.0);
                const glm::vec3 got = centre(scene, on);
                // Half: five roundings of 2^-12 and the storage of smoothness. Full: rounding of fp32 alone.
                const double tolerance = on.arithmetic == Arithmetic::half ? 2e-3 : 2e-4;
                for (int i = 0; i < 3; ++i) {
                    EXPECT_NEAR(got[i], expected[static_cast<std::size_t>(i)], tolerance)
                        << on.words() << " wetness " << level << " roughness " << roughness << " channel " << i;
                }
            }
        }
    }
}

TEST_F(WetSurface, SoakedStoneIsAFifthAsBrightAndShinesAtTheRim) {
    // The extremes of the formula, by hand: porosity 1 and wetness 1 leave 0.2 of the albedo.
    Scene dry = wet_square(1.0f), wet = wet_square(1.0f);
    dry.wetness.reset();
    for (Scene* scene : {&dry, &wet}) scene->materials[0].roughness = 1.0f;
    const glm::vec3 before = centre(dry, {Tier::console, Arithmetic::full});
    const glm::vec3 after = centre(wet, {Tier::console, Arithmetic::full});
    const float specular = static_cast<float>(kDielectric);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(after[i] - specular, 0.2f * (before[i] - specular), 1e-4f);
}

TEST_F(WetSurface, MetalsAndSmoothSurfacesStayAsTheyAreToTheBit) {
    for (const On& on : kEverywhere) {
        for (const bool metal : {false, true}) {
            Scene wet = wet_square(1.0f);
            wet.materials[0].metallic = metal ? 1.0f : 0.0f;
            wet.materials[0].base_color = glm::vec4(0.9f, 0.8f, 0.7f, 1.0f);
            wet.materials[0].roughness = metal ? 0.9f : 0.3f;
            Scene dry = wet;
            dry.wetness.reset();
            EXPECT_EQ(centre(wet, on), centre(dry, on)) << on.words() << (metal ? " metal" : " smooth");
        }
    }
}

TEST_F(WetSurface, WetnessOfZeroIsTheIdentityToTheBit) {
    for (const On& on : kEverywhere) {
        // The program with water in it, over a place that is sheltered.
        Scene wet = wet_square(1.0f);
        wet.materials[0].water = WaterMask::vertex_color;
        wet.meshes[0].colors.assign(4, {1.0f, 1.0f, 1.0f, 0.0f});
        wet.lights.push_back({.kind = LightKind::sun, .color = glm::vec3(2.0f), .direction = {0.0f, 0.0f, -1.0f}});
        Scene dry = wet;
        dry.wetness.reset();
        EXPECT_EQ(centre(wet, on), centre(dry, on)) << on.words();
    }
}

TEST_F(WetSurface, HighlightsGetNarrowerWhereItIsWet) {
    Scene scene = wet_square(1.0f);
    scene.ambient = glm::vec3(0.0f);
    scene.materials[0].base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    scene.materials[0].roughness = 0.8f;
    scene.lights.push_back({.kind = LightKind::sun, .color = glm::vec3(1.0f), .direction = {0.0f, 0.0f, -1.0f}});
    const double dry_smoothness = smoothness_of_roughness(0.8);
    const reference::DryMaterial dry{{}, {kDielectric, kDielectric, kDielectric}, dry_smoothness};
    for (const float level : {0.0f, 0.5f, 1.0f}) {
        scene.wetness->level = level;
        const double smoothness = reference::wet_material(dry, static_cast<double>(level)).smoothness;
        const double power = std::exp2(10.0 * smoothness + 1.0);
        const double expected = kDielectric * (power + 2.0) / 8.0;
        for (const On& on : kEverywhere) {
            // 3 %: a pixel beside the axis of the highlight, and half's exponent.
            EXPECT_NEAR(static_cast<double>(centre(scene, on).x), expected, 0.03 * expected)
                << on.words() << " wetness " << level;
        }
    }
}

TEST_F(WetSurface, MasksOfVerticesAndTexturesShareOutTheWater) {
    for (const On& on : kEverywhere) {
        Scene whole = wet_square(0.5f), vertex = wet_square(1.0f), texture = wet_square(1.0f);
        vertex.materials[0].water = WaterMask::vertex_color;
        vertex.meshes[0].colors.assign(4, {1.0f, 1.0f, 1.0f, vertex_alpha({0.5f, 0.0f})});
        texture.images.push_back({.name = "mask", .width = 1, .height = 1, .srgb = false, .rgba = {128, 255, 0, 255}});
        texture.materials[0].water = WaterMask::texture;
        texture.materials[0].water_texture.image = 0;
        const glm::vec3 expected = centre(whole, on);
        // A code of 255 is half a code off a half, and half arithmetic rounds the mask.
        EXPECT_LT(glm::length(centre(vertex, on) - expected), 5e-3f) << on.words();
        if (on.tier == Tier::low) continue;  // it reads no mask from a texture
        EXPECT_LT(glm::length(centre(texture, on) - expected), 5e-3f) << on.words();
    }
}

TEST_F(WetSurface, TheLevelMayChangeBetweenFrames) {
    Scene scene = wet_square(1.0f);
    const FramePlan frame =
        plan_frame(scene, square_view(8, 8), {.tier = Tier::console, .storage = gl::PixelFormat::rgba32f}, caps(),
                   all_effects());
    Renderer renderer(ground().gl, ground().caps);
    renderer.prepare(scene, frame);
    float last = 0.0f;
    for (const float level : {1.0f, 0.7f, 0.4f, 0.1f, 0.0f}) {
        scene.wetness->level = level;
        renderer.draw(square_view(8, 8));
        const float bright = pixel(renderer.read_target(frame.target_index("scene_color")), 4, 4).x;
        EXPECT_GT(bright, last) << level;
        last = bright;
    }
}

TEST(WetMaterial, OnTheCpuAgreesWithTheReference) {
    for (float smoothness = 0.0f; smoothness <= 1.0f; smoothness += 0.05f) {
        for (float specular = 0.0f; specular <= 1.0f; specular += 0.05f) {
            const auto s = static_cast<double>(specular);
            const double pores = reference::porosity({s, s, s}, static_cast<double>(smoothness));
            EXPECT_NEAR(porosity(glm::vec3(specular), smoothness), pores, 2e-6);
            for (const float wetness : {0.0f, 0.3f, 1.0f}) {
                const auto wet = reference::wet_material({{1.0, 1.0, 1.0}, {s, s, s}, static_cast<double>(smoothness)},
                                                         static_cast<double>(wetness));
                const auto p = static_cast<float>(pores);
                EXPECT_NEAR(wet_factor(p, wetness), wet.albedo[0], 1e-6);
                EXPECT_NEAR(wet_smoothness(smoothness, p, wetness), wet.smoothness, 1e-6);
            }
        }
    }
}

TEST(Drying, SpecularFadesBeforeDiffuseAndBothEndDry) {
    Scene scene;
    scene.wetness = Wetness{.level = 0.8f, .is_static = false, .since_s = 0.0f, .dry_s = 60.0f};
    EXPECT_FLOAT_EQ(wet_levels(scene).diffuse, 0.8f);
    EXPECT_FLOAT_EQ(wet_levels(scene).specular, 0.8f);
    WetLevels last = wet_levels(scene);
    for (float since = 1.0f; since < 60.0f; since += 1.0f) {
        scene.wetness->since_s = since;
        const WetLevels now = wet_levels(scene);
        EXPECT_LT(now.specular, now.diffuse) << since;
        EXPECT_LT(now.specular, last.specular) << since;
        EXPECT_LT(now.diffuse, last.diffuse) << since;
        EXPECT_NEAR(now.diffuse, 0.8 * reference::diffuse_water_left(static_cast<double>(since), 60.0), 1e-5);
        EXPECT_NEAR(now.specular, 0.8 * reference::specular_water_left(static_cast<double>(since), 60.0), 1e-5);
        last = now;
    }
    scene.wetness->since_s = 60.0f;
    EXPECT_EQ(wet_levels(scene).diffuse, 0.0f);
    EXPECT_EQ(wet_levels(scene).specular, 0.0f);
}

TEST(VertexWater, GoesThroughEightBitsAndBack) {
    for (int i = 0; i <= 127; ++i) {
        const float open = static_cast<float>(i) / 127.0f;
        const float stored = std::round(vertex_alpha({open, 0.0f}) * 255.0f) / 255.0f;
        EXPECT_NEAR(vertex_water(stored).open, open, 0.006f) << i;  // half a code of 127, and the factor of 1.001
        EXPECT_EQ(vertex_water(stored).hollow, 0.0f) << i;
    }
    for (int i = 0; i <= 128; ++i) {
        const float hollow = static_cast<float>(i) / 128.0f;
        const float stored = std::round(vertex_alpha({1.0f, hollow}) * 255.0f) / 255.0f;
        EXPECT_EQ(vertex_water(stored).open, 1.0f) << i;
        EXPECT_NEAR(vertex_water(stored).hollow, hollow, 0.006f) << i;
    }
}

FramePlan fixed_plan(const Scene& scene, const View& view) {
    return plan_frame(scene, view, {.fixed_view = true}, able_caps(), all_effects());
}

TEST(WetSurfaceDemand, SaysWhyInEveryCase) {
    const auto why = [](const Scene& scene) { return plan(scene).find("wet_surface")->why; };
    const auto in = [](const Scene& scene) { return plan(scene).find("wet_surface")->in; };
    Scene scene = wet_square(0.5f);
    EXPECT_TRUE(in(scene));
    EXPECT_NE(why(scene).find("because the wetness may change"), std::string::npos) << why(scene);
    scene.wetness->is_static = true;
    EXPECT_TRUE(in(scene));
    EXPECT_NE(why(scene).find("wetness 0.50 never changes and is written into the textures of 1 material"),
              std::string::npos)
        << why(scene);
    EXPECT_TRUE(plan(scene).find("wet_surface")->insertions.empty());
    scene.wetness->level = 0.0f;
    EXPECT_EQ(why(scene), "the wetness of the scene is 0");
    scene.wetness = Wetness{.level = 1.0f, .since_s = 100.0f, .dry_s = 60.0f};
    EXPECT_EQ(why(scene), "the scene has dried");
    scene.wetness.reset();
    EXPECT_EQ(why(scene), "the scene says nothing of water");
    scene.wetness = Wetness{};
    scene.materials[0].water = WaterMask::none;
    EXPECT_EQ(why(scene), "no surface takes up water");
    EXPECT_FALSE(in(scene));
}

TEST(WetSurfaceDemand, ACameraThatSeesNoneOfItPaysNothing) {
    const Scene scene = wet_square(1.0f);
    View away = square_view();
    away.view_from_world = glm::inverse(glm::mat4(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, -1, 0),
                                                  glm::vec4(0, 0, 2, 1)));
    EXPECT_TRUE(fixed_plan(scene, square_view()).find("wet_surface")->in);
    const FramePlan turned = fixed_plan(scene, away);
    EXPECT_FALSE(turned.find("wet_surface")->in);
    EXPECT_EQ(turned.find("wet_surface")->why, "none of the 1 surface that take up water is in view");
    // Where the view may move, what is behind the camera now may be before it in the next frame.
    EXPECT_TRUE(plan_frame(scene, away, {}, able_caps(), all_effects()).find("wet_surface")->in);
}

}  // namespace
}  // namespace halfframe::tests
