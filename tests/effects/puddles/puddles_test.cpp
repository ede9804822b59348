// puddles: mirrors of 2 %, level ground, slopes, the slot for another normal; and the query of a place beside the picture.
#include "engine/effects/puddles/puddles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "content/content.h"
#include "engine/effects/puddles/puddles_reference.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/effects/wet_surface/surface_at.h"
#include "engine/effects/wet_surface/wet_surface.h"
#include "perf/measure/planted_effect.h"
#include "tests/effects/lit_square.h"
#include "tests/frame/counted_new.h"

namespace halfframe::tests {
namespace {

/// The wide square lies on the ground and is one hollow; it is looked at straight from above.
Scene pond(float hollow, float level, float slope_rad = 0.0f) {
    Scene scene = wide_square();
    Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 at = mesh.positions[i];
        mesh.positions[i] = {at.x, 0.0f, -at.y};
        mesh.normals[i] = {std::sin(slope_rad), std::cos(slope_rad), 0.0f};
    }
    mesh.tangents.clear();
    mesh.colors.assign(4, {1.0f, 1.0f, 1.0f, vertex_alpha({1.0f, hollow})});
    scene.materials[0].water = WaterMask::vertex_color;
    scene.materials[0].base_color = glm::vec4(0.5f, 0.4f, 0.3f, 1.0f);
    scene.ambient = glm::vec3(1.0f);
    scene.puddles = Puddles{.level = level};
    return scene;
}

View from_above(float half_height_m, float height_m, int pixels, const glm::vec2& centre = glm::vec2(0.0f)) {
    Camera camera;
    camera.orthographic = true;
    camera.half_height_m = half_height_m;
    camera.near_m = 0.01f;
    camera.far_m = height_m + 50.0f;
    // Looks down -Y; +X to the right, -Z upwards in the picture.
    camera.world_from_view = glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, -1, 0), glm::vec4(0, 1, 0, 0),
                                       glm::vec4(centre.x, height_m, centre.y, 1));
    return view_of(camera, pixels, pixels);
}

class PuddlesTest : public harness::GlFixture {
protected:
    glm::vec3 centre(const Scene& scene, const On& on) {
        const FloatPicture picture = scene_color(ground(), scene, from_above(1.0f, 3.0f, 8), on.tier, on.arithmetic);
        return pixel(picture, 4, 4);
    }
};

TEST_F(PuddlesTest, AFullPuddleReflectsTwoPercentOverSoakedGround) {
    for (const On& on : kEverywhere) {
        const glm::vec3 got = centre(pond(1.0f, 1.0f), on);
        const double pores = 1.0;  // roughness 1
        // Half rounds the mask's ends and the sum; both ends of vertex_water are a little early.
        const double tolerance = on.arithmetic == Arithmetic::half ? 2e-3 : 2e-4;
        const double albedo[] = {0.5, 0.4, 0.3};
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(got[i], albedo[i] * (1.0 - 0.8 * pores) + reference::fresnel_glossy(0.02, 1.0, 1.0), tolerance)
                << on.words();
        }
    }
}

TEST_F(PuddlesTest, FillAsTheReferenceSays) {
    for (const On& on : kEverywhere) {
        for (const float hollow : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
            for (const float level : {0.2f, 0.5f, 0.8f, 1.0f}) {
                for (const float slope_deg : {0.0f, 12.0f, 20.0f, 30.0f}) {
                    const float slope = glm::radians(slope_deg);
                    const glm::vec3 got = centre(pond(hollow, level, slope), on);
                    const double share =
                        reference::water_accumulation(1.0 - static_cast<double>(hollow), 1.0,
                                                      static_cast<double>(level), static_cast<double>(slope));
                    const auto up = reference::normal_under_water(
                        {std::sin(static_cast<double>(slope)), std::cos(static_cast<double>(slope)), 0.0},
                        {0.0, 1.0, 0.0}, share);
                    const double specular = reference::specular_under_water(0.0437, share);
                    const double smoothness = reference::smoothness_under_water(0.4 * share, share);
                    const double expected = 0.5 * (1.0 - 0.8 * share) +
                                            reference::fresnel_glossy(specular, smoothness, up[1]);
                    // The share is off by 0.0065 in half (halfframe accuracy puddles), and 0.006 from 8 bits of alpha.
                    EXPECT_NEAR(got.x, expected, on.arithmetic == Arithmetic::half ? 1.2e-2 : 6e-3)
                        << on.words() << " hollow " << hollow << " level " << level << " slope " << slope_deg;
                }
            }
        }
    }
}

TEST_F(PuddlesTest, CracksOfATextureFillToTheLevelAboveLow) {
    Scene scene = pond(0.0f, 0.6f);
    scene.images.push_back({.name = "height", .width = 1, .height = 1, .srgb = false, .rgba = {255, 51, 0, 255}});
    scene.materials[0].water_texture.image = 0;
    const double share = std::min(0.6, 1.0 - 51.0 / 255.0);
    const double expected =
        0.5 * (1.0 - 0.8 * share) + reference::fresnel_glossy(reference::specular_under_water(0.0437, share),
                                                              reference::smoothness_under_water(0.4 * share, share), 1.0);
    EXPECT_NEAR(centre(scene, {Tier::console, Arithmetic::full}).x, expected, 1e-3);
    const double dry = 0.5 + 0.0437;
    EXPECT_NEAR(centre(scene, {Tier::low, Arithmetic::full}).x, dry, 1e-3) << "low reads no height";
}

constexpr std::array kTilt = {gl::Insertion{"surface.water_normal", nullptr,
                                            "water_normal = normalize(vec3(1.0, 1.0, 0.0));", "PUDDLES"}};

TEST_F(PuddlesTest, AnotherEffectMayMoveTheNormalOfWater) {
    Scene scene = pond(1.0f, 1.0f);
    scene.ambient = glm::vec3(0.0f);
    // Light from 45 degrees: on level water it is a third of the way to the horizon, on tilted water it comes straight.
    scene.lights.push_back({.kind = LightKind::sun,
                            .color = glm::vec3(1.0f),
                            .direction = glm::normalize(glm::vec3(-1.0f, -1.0f, 0.0f))});
    const EffectCard tilt = perf::planted_effect(
        [](const PlanContext&) -> std::span<const gl::Insertion> { return kTilt; });
    const std::vector<const EffectCard*> cards = perf::all_effects_and(tilt);
    const View view = from_above(1.0f, 3.0f, 8);
    const float level = pixel(scene_color(ground(), scene, view, Tier::console, Arithmetic::full), 4, 4).x;
    const float tilted = pixel(scene_color(ground(), scene, view, Tier::console, Arithmetic::full, cards), 4, 4).x;
    EXPECT_NEAR(tilted / level, std::sqrt(2.0f), 1e-3f);  // n.l of the diffuse part: 1 against cos 45 degrees
}

TEST(PuddlesDemand, SaysWhyInEveryCase) {
    const auto decision = [](const Scene& scene) { return *plan(scene).find("puddles"); };
    Scene scene = pond(1.0f, 1.0f);
    EXPECT_TRUE(decision(scene).in);
    EXPECT_EQ(decision(scene).why, "hollows of 1 surface are filled to 1.00");
    EXPECT_TRUE(plan(scene).find("wet_surface")->in) << "what stands under water is soaked";
    scene.puddles->level = 0.0f;
    EXPECT_EQ(decision(scene).why, "the level of the puddles is 0");
    scene.puddles.reset();
    EXPECT_EQ(decision(scene).why, "no water stands in the scene");
    scene = pond(0.0f, 1.0f);
    EXPECT_EQ(decision(scene).why, "no surface that takes up water has hollows");
    EXPECT_FALSE(decision(scene).in);
    EXPECT_FALSE(plan(scene).find("wet_surface")->in) << "dry ground without hollows shows no water";
}

// The mask as the shader has it: x wetness, y open water, z whether there is a program with water at all.
constexpr std::array kMask = {gl::Insertion{"surface.color", nullptr, "color = vec3(0.0);"},
                              gl::Insertion{"surface.color", nullptr, "color = vec3(wetness.x, puddle, 1.0);", "WATER"}};

struct MaskGap {
    int compared = 0, beyond = 0;
    double worst = 0.0;
};

/// The picture of the mask from above beside GroundQuery, at the middle of every pixel.
MaskGap mask_gap(harness::Ground& ground, const Scene& scene, float half_height_m, float height_m, int pixels,
                 const glm::vec2& centre, double tolerance) {
    const EffectCard mask = perf::planted_effect(
        [](const PlanContext&) -> std::span<const gl::Insertion> { return kMask; });
    const std::vector<const EffectCard*> cards = perf::all_effects_and(mask);
    const View view = from_above(half_height_m, height_m, pixels, centre);
    const FloatPicture picture = scene_color(ground, scene, view, Tier::console, Arithmetic::full, cards);
    const GroundQuery query(scene);
    MaskGap gap;
    for (int y = 0; y < pixels; ++y) {
        for (int x = 0; x < pixels; ++x) {
            const float share_x = (2.0f * (static_cast<float>(x) + 0.5f) / static_cast<float>(pixels)) - 1.0f;
            const float share_y = (2.0f * (static_cast<float>(y) + 0.5f) / static_cast<float>(pixels)) - 1.0f;
            const auto at = query.surface_at(
                {centre.x + share_x * half_height_m, height_m - 0.01f, centre.y + share_y * half_height_m});
            const glm::vec3 drawn = pixel(picture, x, y);
            const double wet = at ? static_cast<double>(at->wetness) : 0.0;
            const double puddle = at ? static_cast<double>(at->puddle) : 0.0;
            const double apart = std::max(std::abs(static_cast<double>(drawn.x) * static_cast<double>(drawn.z) - wet),
                                          std::abs(static_cast<double>(drawn.y) - puddle));
            ++gap.compared;
            gap.beyond += apart > tolerance;
            gap.worst = std::max(gap.worst, apart);
        }
    }
    return gap;
}

TEST_F(PuddlesTest, TheQueryAgreesWithThePictureInEveryPixelOfOpenGround) {
    Scene scene = content::open_scene("wet_yard");
    // The slab alone, which is drawn from above without an edge in sight.
    std::erase_if(scene.surfaces, [](const Surface& surface) { return surface.name != "slab"; });
    for (const float level : {0.3f, 0.85f, 1.0f}) {
        scene.puddles->level = level;
        // 0.006: alpha in 8 bits is off by 1/510, times 1.99 for the hollow and 2.5 for the share, with slack.
        const MaskGap gap = mask_gap(ground(), scene, 4.9f, 2.0f, 160, {0.0f, 0.0f}, 0.012);
        EXPECT_EQ(gap.compared, 160 * 160);
        EXPECT_EQ(gap.beyond, 0) << "level " << level << ": " << gap.worst;
    }
}

TEST_F(PuddlesTest, TheQueryAgreesWithThePictureOfTheStreet) {
    Scene scene = content::open_scene("street");
    scene.wetness = Wetness{.level = 0.6f, .is_static = false};
    scene.puddles = Puddles{.level = 1.0f};
    std::erase_if(scene.surfaces, [](const Surface& surface) {
        return surface.node >= 0 || surface.skin >= 0 || surface.dynamic;  // the query leaves out what moves
    });
    // Under the balconies, over the road and into the arcade.
    const MaskGap gap = mask_gap(ground(), scene, 6.0f, 2.2f, 256, {4.0f, -14.0f}, 0.012);
    // A pixel whose middle lies on the edge of a thing may go to either side of it.
    EXPECT_LT(gap.beyond, gap.compared / 200) << gap.worst;
    EXPECT_EQ(gap.compared, 256 * 256);
}

TEST(GroundQuery, KnowsDryWetAndPuddle) {
    Scene scene = pond(1.0f, 1.0f);
    scene.materials[0].deepest_puddle_m = 0.1f;
    const GroundQuery query(scene);
    const auto at = [&](float y) { return query.surface_at({0.2f, y, 0.3f}); };
    ASSERT_TRUE(at(1.0f).has_value());
    EXPECT_FALSE(at(-1.0f).has_value()) << "nothing lies below";
    EXPECT_FALSE(query.surface_at({1000.0f, 1.0f, 0.0f}).has_value());
    EXPECT_EQ(at(1.0f)->footing, Footing::puddle);
    EXPECT_NEAR(at(1.0f)->puddle_depth_m, 0.1f, 1e-4f);
    scene.puddles->level = 0.5f;
    EXPECT_NEAR(at(1.0f)->puddle_depth_m, 0.05f, 1e-4f) << "asked anew of a scene that has changed";
    scene.puddles.reset();
    EXPECT_EQ(at(1.0f)->footing, Footing::dry);
    scene.wetness = Wetness{.level = 0.4f};
    EXPECT_EQ(at(1.0f)->footing, Footing::wet);
    EXPECT_NEAR(at(1.0f)->wetness, 0.4f, 1e-6f);
    EXPECT_EQ(at(1.0f)->material, 0);
    scene.materials[0].water = WaterMask::none;
    EXPECT_EQ(at(1.0f)->footing, Footing::dry);
}

TEST(GroundQuery, AllocatesNothing) {
    if (!heap_is_counted()) GTEST_SKIP() << "AddressSanitizer owns operator new";
    const Scene scene = content::open_scene("wet_yard");
    const GroundQuery query(scene);
    ASSERT_GT(query.triangles(), 1000u);
    int found = 0;
    const std::uint64_t before = heap_allocations();
    for (float x = -4.9f; x < 5.0f; x += 0.1f) found += query.surface_at({x, 2.0f, 0.3f}).has_value();
    EXPECT_EQ(heap_allocations(), before);
    EXPECT_GT(found, 90);
}

TEST(GroundQuery, FindsTheNearestBelowAndTheUpperOfTwo) {
    Scene scene = pond(0.0f, 1.0f);
    Surface shelf = scene.surfaces[0];
    shelf.name = "shelf";
    shelf.world_from_local[3] = {0.0f, 2.0f, 0.0f, 1.0f};
    scene.surfaces.push_back(shelf);
    const GroundQuery query(scene);
    EXPECT_EQ(query.surface_at({0.0f, 5.0f, 0.0f})->surface, 1);
    EXPECT_EQ(query.surface_at({0.0f, 1.9f, 0.0f})->surface, 0);
    EXPECT_NEAR(query.surface_at({0.0f, 5.0f, 0.0f})->height_m, 2.0f, 1e-6f);
    scene.surfaces[1].dynamic = true;
    const GroundQuery without(scene);
    EXPECT_EQ(without.surface_at({0.0f, 5.0f, 0.0f})->surface, 0);
}

}  // namespace
}  // namespace halfframe::tests
