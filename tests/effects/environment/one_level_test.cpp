// What reflects the same everywhere reads a cube that is made for its smoothness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/effects/environment/environment.h"
#include "engine/effects/environment/environment_reference.h"
#include "shaders_es/environment/environment_limits.h"
#include "tests/content/environment_reference.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

/// Levels of 16 to 1 texels a side; level l is `light(l)` all over.
template <typename Light>
EnvironmentMap even_levels(const Light& light) {
    EnvironmentMap map{.name = "even levels", .size = 16, .levels = {}, .roughest_level = 4, .powers = {}};
    for (int level = 0; level <= map.roughest_level; ++level) {
        const auto side = static_cast<std::size_t>(map.size >> level);
        map.levels.emplace_back(6 * side * side, glm::vec3(light(level)));
    }
    return map;
}

float roughness_for(double smoothness) {
    return static_cast<float>(std::pow(2.0 / (std::exp2(10.0 * smoothness + 1.0) + 2.0), 0.25));
}

Scene mirror(const EnvironmentMap& map, double smoothness) {
    Scene scene = wide_square();
    scene.environment = map;
    scene.materials[0] = {.base_color = glm::vec4(1.0f), .metallic = 1.0f, .roughness = roughness_for(smoothness)};
    return scene;
}

/// A texture of ones: it changes no number, and smoothness becomes a thing of every pixel.
void map_smoothness(Scene& scene) {
    scene.images.push_back({.name = "ones", .width = 1, .height = 1, .srgb = false, .rgba = {255, 255, 255, 255}});
    scene.materials[0].metallic_roughness_texture.image = 0;
}

float shining(int level) { return 0.9f - static_cast<float>(level) / 10.0f; }

class OneLevel : public harness::GlFixture {
protected:
    float centre(const Scene& scene, Tier tier, Arithmetic arithmetic = Arithmetic::full) {
        const FloatPicture picture = scene_color(ground(), scene, square_view(8, 8), tier, arithmetic);
        return pixel(picture, 4, 4).r;
    }
    /// Bytes of the textures that a frame of `scene` has.
    std::size_t texture_bytes(const Scene& scene, Tier tier) {
        const FramePlan frame = plan_frame(scene, square_view(8, 8), {.tier = tier}, ground().caps, all_effects());
        Renderer renderer(ground().gl, ground().caps);
        renderer.prepare(scene, frame);
        return renderer.texture_bytes();
    }
};

TEST_F(OneLevel, IsThatOfTheSmoothnessToAnEighthOfALevel) {
    // At low nothing is sharper than level 1, whose smoothness is 0.75.
    for (const On& on : kEverywhere) {
        if (on.tier == Tier::reference) continue;
        for (const double smoothness : {0.0, 0.07, 0.13, 0.3, 0.5, 0.61, 0.8, 0.93, 1.0}) {
            double level = reference::constant_reflection_level(smoothness, 4.0);
            if (on.tier == Tier::low) level = std::max(level, 1.0);
            // 5e-3: RGBM8 rounds the root of 0.9 to 1/510; half adds five roundings of 2^-12. A step is 0.0125.
            EXPECT_NEAR(centre(mirror(even_levels(shining), smoothness), on.tier, on.arithmetic), 0.9 - 0.1 * level,
                        5e-3)
                << on.words() << " " << smoothness;
        }
    }
}

TEST_F(OneLevel, TheReferenceTierChoosesByPixelAllTheSame) {
    // 0.9133 is level 0.4375, between two eighths: 0.00625 from each.
    const double level = reference::reflection_level(0.9133, 4.0);
    EXPECT_NEAR(centre(mirror(even_levels(shining), 0.9133), Tier::reference), 0.9 - 0.1 * level, 2e-3);
}

TEST_F(OneLevel, AMappedSurfaceLooksAlikeWhereALevelFitsExactly) {
    for (const double smoothness : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const Scene even = mirror(even_levels(shining), smoothness);
        Scene mapped = even;
        map_smoothness(mapped);
        // 5e-3: as above, and the driver blends levels in 8 bits.
        EXPECT_NEAR(centre(even, Tier::console), centre(mapped, Tier::console), 5e-3) << smoothness;
    }
}

TEST_F(OneLevel, ASmoothnessThatChangesLaterTakesTheNearestCubeThereIs) {
    Scene scene = mirror(even_levels(shining), 1.0);
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].roughness = roughness_for(0.25);  // level 3
    scene.surfaces.push_back(scene.surfaces[0]);
    scene.surfaces[1].material = 1;
    scene.surfaces[1].world_from_local[3].z = -50.0f;  // behind the other one
    for (const Tier tier : {Tier::low, Tier::console}) {
        const View view = square_view(8, 8);
        const Wishes wishes{.tier = tier,
                            .effect_switches = {{"anti_alias", false}},
                            .arithmetic = Arithmetic::full,
                            .storage = gl::PixelFormat::rgba32f};
        const FramePlan frame = plan_frame(scene, view, wishes, ground().caps, all_effects());
        Renderer renderer(ground().gl, ground().caps);
        Scene moving = scene;
        renderer.prepare(moving, frame);
        const auto shown = [&](double smoothness) {
            moving.materials[0].roughness = roughness_for(smoothness);
            renderer.draw(view);
            return pixel(renderer.read_target(frame.target_index("scene_color")), 4, 4).r;
        };
        const double sharpest = tier == Tier::low ? 0.8 : 0.9;
        EXPECT_NEAR(shown(1.0), sharpest, 5e-3) << name(tier);
        EXPECT_NEAR(shown(0.2), 0.6, 5e-3) << name(tier);  // level 3.2 or so: the other's is nearer
        EXPECT_NEAR(shown(0.9), sharpest, 5e-3) << name(tier);
        EXPECT_EQ(renderer.first_gl_error(), "");
    }
}

TEST_F(OneLevel, AScenePaysForTheCubesThatItReads) {
    const auto cube = [](std::size_t side) { return 6 * side * side * 4; };
    Scene scene = mirror(even_levels(shining), 0.5);
    EXPECT_EQ(texture_bytes(scene, Tier::console), cube(4));
    EXPECT_EQ(texture_bytes(scene, Tier::low), cube(4));
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].roughness = roughness_for(0.0);
    EXPECT_EQ(texture_bytes(scene, Tier::console), cube(4)) << "a material that nothing wears";
    scene.surfaces.push_back(scene.surfaces[0]);
    scene.surfaces[1].material = 1;
    EXPECT_EQ(texture_bytes(scene, Tier::console), cube(4) + cube(1));
    map_smoothness(scene);
    const std::size_t map_bytes = 1;  // grey
    EXPECT_EQ(texture_bytes(scene, Tier::console),
              map_bytes + cube(1) + cube(16) + cube(8) + cube(4) + cube(2) + cube(1));
    EXPECT_EQ(texture_bytes(scene, Tier::low), map_bytes + cube(1) + cube(8) + cube(2));
}

TEST(TexelsOfStep, AreTheBlendOfBothLevelsAsASamplerFiltersThem) {
    std::mt19937 random(7);
    EnvironmentMap map = even_levels(shining);
    for (auto& level : map.levels) {
        for (glm::vec3& texel : level) texel = glm::vec3(static_cast<float>(random() % 1000) / 1000.0f);
    }
    int tried = 0;
    for (int step = 0; step <= 4 * ENVIRONMENT_STEPS; ++step) {
        const auto level = static_cast<std::size_t>(step / ENVIRONMENT_STEPS);
        const double part = static_cast<double>(step % ENVIRONMENT_STEPS) / ENVIRONMENT_STEPS;
        const std::vector<glm::vec3> texels = texels_of_step(map, step);
        ASSERT_EQ(texels.size(), map.levels[level].size());
        const int side = map.size >> level;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const int in_face = static_cast<int>(i) % (side * side);
            const FacePlace place{static_cast<int>(i) / (side * side), (in_face % side + 0.5) / side,
                                  (in_face / side + 0.5) / side};
            double expected = sampled(map, level, place).r;
            if (part > 0.0) expected += (sampled(map, level + 1, place).r - expected) * part;
            EXPECT_NEAR(texels[i].r, expected, 1e-6) << step << " " << i;
            ++tried;
        }
    }
    EXPECT_GT(tried, 6 * 4 * 256);
}

}  // namespace
}  // namespace halfframe::tests
