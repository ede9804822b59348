// environment against maps with a known answer: white everywhere, one colour a face, one colour a level.
#include "engine/effects/environment/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "content/content.h"
#include "engine/effects/environment/environment_reference.h"
#include "shaders_es/environment/environment_limits.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

/// A chain whose level l is `color(face, l)` all over.
template <typename Color>
EnvironmentMap painted(int size, const Color& color) {
    EnvironmentMap map;
    map.name = "painted";
    map.size = size;
    for (int level = 0, side = size; side >= 1; ++level, side /= 2) {
        std::vector<glm::vec3> texels;
        for (int face = 0; face < 6; ++face) {
            texels.insert(texels.end(), static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                          color(face, level));
        }
        map.levels.push_back(std::move(texels));
        map.powers.push_back(2.0f);
    }
    map.roughest_level = static_cast<int>(map.levels.size()) - 1;
    return map;
}

/// The same radiance from everywhere: the diffuse light is that radiance too.
EnvironmentMap uniform_map(const glm::vec3& radiance) {
    EnvironmentMap map = painted(8, [&](int, int) { return radiance; });
    map.irradiance[0] = radiance;
    return map;
}

/// A texture of ones: it changes no number, and smoothness becomes a thing of every pixel. (Where it is none, a cube is
/// made for it: one_level_test.cpp.)
void map_smoothness(Scene& scene) {
    scene.images = {{.name = "ones", .width = 1, .height = 1, .srgb = false, .rgba = {255, 255, 255, 255}}};
    scene.materials[0].metallic_roughness_texture.image = 0;
}

struct Case {
    Tier tier;
    Arithmetic arithmetic;
    double tolerance;  ///< relative to the brightest channel
};
// RGBM8 rounds the root of the light to 1/510 of it, twice that after the square; half adds some ten roundings of
// 2^-12.
constexpr Case kCases[] = {{Tier::low, Arithmetic::full, 4e-3},
                           {Tier::low, Arithmetic::half, 8e-3},
                           {Tier::console, Arithmetic::full, 4e-3},
                           {Tier::console, Arithmetic::half, 8e-3},
                           {Tier::reference, Arithmetic::full, 1e-3}};  // RGBA16F: 2^-11 by truncation

class Environment : public harness::GlFixture {
protected:
    glm::vec3 centre(const Scene& scene, const View& view, const Case& test_case) {
        const FloatPicture picture = scene_color(ground(), scene, view, test_case.tier, test_case.arithmetic);
        return pixel(picture, picture.width / 2, picture.height / 2);
    }
};

std::string title(const Case& test_case) {
    return std::string(name(test_case.tier)) + " " + name(test_case.arithmetic);
}

TEST_F(Environment, AWhiteDiffuserAndAPerfectMirrorReturnAllOfAWhiteEnvironment) {
    const glm::vec3 radiance(0.7f, 0.35f, 0.1f);
    for (const Case& test_case : kCases) {
        Scene scene = wide_square();
        scene.environment = uniform_map(radiance);
        scene.materials[0].base_color = glm::vec4(1.0f);
        // A metal of white is all specular: F = 1, whatever the smoothness.
        for (const float roughness : {0.0f, 0.4f, 1.0f}) {
            scene.materials[0].metallic = 1.0f;
            scene.materials[0].roughness = roughness;
            const glm::vec3 got = centre(scene, square_view(8, 8), test_case);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(got[i], radiance[i], 0.7 * test_case.tolerance) << title(test_case) << " " << roughness;
        }
        // The dielectric adds its 4.4 % on top: fresnel_glossy seen head on is the specular itself.
        scene.materials[0].metallic = 0.0f;
        scene.materials[0].roughness = 1.0f;
        const glm::vec3 got = centre(scene, square_view(8, 8), test_case);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(got[i], 1.0437 * radiance[i], 0.7 * test_case.tolerance) << title(test_case);
    }
}

TEST_F(Environment, AMirrorShowsTheFaceItLooksAt) {
    const glm::vec3 faces[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
    const glm::vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const Case& test_case : kCases) {
        for (int face = 0; face < 6; ++face) {
            // A wall that faces `axis`, seen from 2 m along it: it mirrors the eye's own direction.
            Scene scene = wide_square();
            scene.environment = painted(16, [&](int of, int) { return faces[of]; });
            scene.materials[0] = {.base_color = glm::vec4(1.0f), .metallic = 1.0f, .roughness = 0.0f};
            const glm::vec3 axis = axes[face];
            const glm::vec3 up = std::abs(axis.y) > 0.5f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
            const glm::vec3 right = glm::cross(up, axis);
            scene.surfaces[0].world_from_local = {glm::vec4(right, 0), glm::vec4(glm::cross(axis, right), 0),
                                                  glm::vec4(axis, 0), glm::vec4(0, 0, 0, 1)};
            const Camera camera = camera_looking(axis * 2.0f, glm::vec3(0.0f), 0.7f, world_box(scene));
            const glm::vec3 got = centre(scene, view_of(camera, 8, 8), test_case);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(got[i], faces[face][i], 2.0 * test_case.tolerance) << title(test_case) << " face " << face;
        }
    }
}

TEST_F(Environment, SmoothnessChoosesTheLevel) {
    // Level l shines 0.9 - l / 10: a chain of five levels answers with 0.5 + 0.4 smoothness. (Between levels that
    // differ more RGBM8 darkens: it blends roots and multipliers, not light.)
    const auto shine = [](int, int level) { return glm::vec3(0.9f - static_cast<float>(level) / 10.0f); };
    for (const Case& test_case : kCases) {
        if (test_case.tier == Tier::low) continue;  // two cubes: see below
        for (const double smoothness : {0.0, 0.13, 0.5, 0.8, 1.0}) {
            Scene scene = wide_square();
            scene.environment = painted(16, shine);
            const double power = std::exp2(10.0 * smoothness + 1.0);
            scene.materials[0] = {.base_color = glm::vec4(1.0f),
                                  .metallic = 1.0f,
                                  .roughness = static_cast<float>(std::pow(2.0 / (power + 2.0), 0.25))};
            map_smoothness(scene);
            const glm::vec3 got = centre(scene, square_view(8, 8), test_case);
            // 1/256: the driver blends levels in 8 bits. Half: log2 of the power has steps of 2^-7 near its end.
            const double tolerance = test_case.arithmetic == Arithmetic::half ? 0.01 : 0.005;
            EXPECT_NEAR(got.r, 0.9 - 0.1 * reference::reflection_level(smoothness, 4.0), tolerance) << title(test_case);
        }
    }
}

TEST_F(Environment, LowMixesTwoCubesAndTheDiffuseLight) {
    EnvironmentMap map = painted(16, [](int, int level) {
        return glm::vec3(level == 1 ? 0.9f : level == 3 ? 0.3f : 0.0f);
    });
    map.irradiance[0] = glm::vec3(0.1f);
    ASSERT_EQ(level_for(map, static_cast<float>(ENVIRONMENT_SHARP), 4096), 1);
    ASSERT_EQ(level_for(map, static_cast<float>(ENVIRONMENT_ROUGH), 4096), 3);
    for (const double smoothness : {0.0, 0.2, 0.35, 0.6, 0.75, 1.0}) {
        Scene scene = wide_square();
        scene.environment = map;
        const double power = std::exp2(10.0 * smoothness + 1.0);
        scene.materials[0] = {.base_color = glm::vec4(1.0f),
                              .metallic = 1.0f,
                              .roughness = static_cast<float>(std::pow(2.0 / (power + 2.0), 0.25))};
        map_smoothness(scene);
        const double expected = reference::low_reflection(0.1, 0.3, 0.9, smoothness);
        for (const Arithmetic arithmetic : {Arithmetic::full, Arithmetic::half}) {
            const glm::vec3 got = centre(scene, square_view(8, 8), {Tier::low, arithmetic, 0.0});
            EXPECT_NEAR(got.r, expected, arithmetic == Arithmetic::half ? 0.015 : 0.005) << smoothness;
        }
    }
}

TEST_F(Environment, DiffuseLightFollowsTheNormal) {
    // Terms that only light from +Y: 0.5 + 0.5 y.
    EnvironmentMap map = painted(4, [](int, int) { return glm::vec3(0.0f); });
    map.irradiance[0] = map.irradiance[1] = glm::vec3(0.5f);
    for (const Case& test_case : kCases) {
        for (const float tilt_rad : {-1.0f, -0.3f, 0.0f, 0.7f}) {
            Scene scene = wide_square();
            scene.environment = map;
            scene.materials[0] = {.base_color = glm::vec4(1.0f), .metallic = 0.0f, .roughness = 1.0f};
            const glm::vec3 normal(0.0f, std::sin(tilt_rad), std::cos(tilt_rad));
            scene.surfaces[0].world_from_local = {glm::vec4(1, 0, 0, 0), glm::vec4(0, normal.z, -normal.y, 0),
                                                  glm::vec4(normal, 0), glm::vec4(0, 0, 0, 1)};
            const glm::vec3 got = centre(scene, square_view(8, 8), test_case);
            const double expected = 0.5 + 0.5 * double{normal.y};  // 2e-3: half, normals in 16 bits
            EXPECT_NEAR(got.r, expected, 2e-3) << title(test_case) << " " << tilt_rad;
        }
    }
}

TEST_F(Environment, ExposureScalesWhatItGives) {
    Scene scene = wide_square();
    scene.environment = uniform_map(glm::vec3(0.25f));
    scene.materials[0] = {.base_color = glm::vec4(1.0f), .metallic = 1.0f, .roughness = 0.5f};
    View view = square_view(8, 8);
    view.exposure = 3.0f;
    for (const Case& test_case : kCases)
        EXPECT_NEAR(centre(scene, view, test_case).r, 0.75, 0.75 * test_case.tolerance) << title(test_case);
}

TEST_F(Environment, FollowsASurfaceOfAnotherTierAndDraws) {
    // With a sun and a normal map: what is added differs between low and the others there.
    const Scene scene = [] {
        Scene room = content::open_scene("test_room");
        room.environment = uniform_map(glm::vec3(0.5f));
        return room;
    }();
    const View view = view_of(scene.cameras.at(0), 32, 18);
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        for (const Tier surface : {Tier::low, Tier::console, Tier::reference}) {
            const auto drawn = render(scene, view, {.tier = tier, .effect_tiers = {{"surface", surface}}});
            EXPECT_TRUE(drawn.plan.find("environment")->in);
            EXPECT_EQ(drawn.plan.find("environment")->tier == Tier::low, surface == Tier::low) << name(tier);
        }
    }
}

TEST(Rgbm, EveryLightComesBackWithinAHundredth) {
    // The multiplier is rounded up to n/255, so the brightest channel has 128 codes at least where n is 2 or more (15
    // stops under the range): its root is within half a code of them, 0.4 %, its square within 0.8 %.
    double worst = 0.0;
    int tried = 0;
    for (const float root_range : {0.25f, 1.0f, 8.0f}) {
        for (double stops = -15.0; stops <= 0.0; stops += 0.01) {
            const double light = root_range * root_range * std::exp2(stops);
            const auto texel = packed_rgbm(glm::vec3(static_cast<float>(light)), root_range);
            const double back = reference::rgbm_light(texel[0] / 255.0, texel[3] / 255.0, root_range);
            worst = std::max(worst, std::abs(back - light) / light);
            ++tried;
        }
    }
    EXPECT_GT(tried, 4000);
    EXPECT_LT(worst, 0.0082);
    EXPECT_GT(worst, 0.002) << "eight bits cannot be better";
}

TEST(Rgbm, WhatIsNoLightIsBlackAndWhatIsTooBrightIsCut) {
    using Texel = std::array<std::uint8_t, 4>;
    EXPECT_EQ(packed_rgbm(glm::vec3(0.0f), 8.0f), (Texel{0, 0, 0, 1}));
    EXPECT_EQ(packed_rgbm(glm::vec3(-1.0f), 8.0f), (Texel{0, 0, 0, 1}));
    EXPECT_EQ(packed_rgbm(glm::vec3(std::nanf("")), 8.0f), (Texel{0, 0, 0, 1}));
    EXPECT_EQ(packed_rgbm(glm::vec3(1e30f), 8.0f), (Texel{255, 255, 255, 255}));
    EXPECT_EQ(packed_rgbm(glm::vec3(INFINITY), 8.0f), (Texel{255, 255, 255, 255}));
}

TEST(EnvironmentLevels, AreChosenBySmoothnessAndByWhatTheDeviceTakes) {
    const EnvironmentMap map = painted(128, [](int, int) { return glm::vec3(1.0f); });
    EXPECT_EQ(level_for(map, 1.0f, 4096), 0);
    EXPECT_EQ(level_for(map, 0.0f, 4096), 7);
    EXPECT_EQ(level_for(map, 1.0f, 16), 3) << "ES 2.0 promises cubes of 16 texels and no more";
}

TEST(EnvironmentPlan, IsCalledForByAnEnvironmentThatSomethingReflects) {
    Scene scene = square_scene();
    EXPECT_FALSE(plan(scene).find("environment")->in);
    scene.environment = uniform_map(glm::vec3(1.0f));
    EXPECT_TRUE(plan(scene).find("environment")->in);
    scene.meshes[0].normals.clear();
    EXPECT_FALSE(plan(scene).find("environment")->in);
}

/// What the shader does with the answers of a prefiltered map, in double.
double split(double specular, double smoothness, double n_dot_v, double level) {
    return (specular + (std::max(smoothness, specular) - specular) * std::pow(1.0 - n_dot_v, 5.0)) * level;
}

TEST(EnvironmentReference, AWhiteSkyOverAMirrorOfFullPowerComesBackWhole) {
    const auto white = [](const std::array<double, 3>&) { return 1.0; };
    // Head on the integral of the lobe with F = 1 is power / (power + 4): (power + 2) (2 / (power + 4) - 1 / (power +
    // 2)).
    for (const double power : {16.0, 128.0, 2048.0}) {
        EXPECT_NEAR(reference::reflected_light(white, {0.0, 0.0, 1.0}, 1.0, power, 256), power / (power + 4.0), 2e-3)
            << power;
    }
    // What the shader answers is that of a mirror, whatever the power: the method's own error, 6 % at a power of 64.
    for (const double power : {64.0, 512.0, 2048.0}) {
        const double truth = reference::reflected_light(white, {0.0, 0.0, 1.0}, 0.0437, power, 256);
        const double shown = split(0.0437, (std::log2(power) - 1.0) / 10.0, 1.0, 1.0);
        EXPECT_NEAR(shown / truth, (power + 4.0) / power, 3e-3) << power;
    }
}

}  // namespace
}  // namespace halfframe::tests
