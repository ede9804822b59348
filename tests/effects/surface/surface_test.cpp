// surface against known answers, computed here in double from the papers' formulas and sharing nothing with the shader.
#include "engine/effects/surface/surface.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <cmath>

#include "content/content.h"
#include "tests/effects/lit_square.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

using glm::dvec3;

/// Hoffman 2010: (albedo + F (p + 2)/8 (n.h)^p) n.l c, with c the light's colour.
dvec3 hoffman(const dvec3& base, double metallic, double roughness, const dvec3& n, const dvec3& v, const dvec3& l,
              const dvec3& color) {
    const dvec3 h = glm::normalize(l + v);
    const double srgb_59 = std::pow((59.0 / 255.0 + 0.055) / 1.055, 2.4);  // the talk's default dielectric
    const dvec3 albedo = base * (1.0 - metallic);
    const dvec3 specular = dvec3(srgb_59) * (1.0 - metallic) + base * metallic;
    const double power = std::clamp(2.0 / std::pow(roughness, 4.0) - 2.0, 2.0, 2048.0);
    const dvec3 fresnel = specular + (dvec3(1.0) - specular) * std::pow(1.0 - std::max(glm::dot(l, h), 0.0), 5.0);
    const dvec3 lobe = fresnel * ((power + 2.0) / 8.0 * std::pow(std::max(glm::dot(n, h), 0.0), power));
    return (albedo + lobe) * std::max(glm::dot(n, l), 0.0) * color;
}

struct Case {
    Tier tier;
    Arithmetic arithmetic;
    double tolerance;  ///< relative to the brightest value of the picture
};

class Surface : public harness::GlFixture {
protected:
    /// Worst difference between the picture and hoffman() over a grid of pixels, relative to the brightest.
    double worst_error(const Scene& scene, const Case& test_case, bool point) {
        const View view = square_view(64, 64);
        const FloatPicture picture = scene_color(ground(), scene, view, test_case.tier, test_case.arithmetic);
        const Material& material = scene.materials[0];
        const Light& light = scene.lights[0];
        double worst = 0.0, brightest = 0.0;
        for (int y = 2; y < 64; y += 4) {
            for (int x = 2; x < 64; x += 4) {
                // The pixel's centre on the plane z = 0, seen from (0, 0, 2) through a 45 degree lens.
                const double half = 2.0 * std::tan(glm::radians(45.0) / 2.0);
                const dvec3 at{((x + 0.5) / 32.0 - 1.0) * half, (1.0 - (y + 0.5) / 32.0) * half, 0.0};
                const dvec3 to_light = point ? dvec3(light.position) - at : -dvec3(light.direction);
                dvec3 color(light.color);
                if (point) {
                    const double ratio = glm::dot(to_light, to_light) / (double(light.range_m) * light.range_m);
                    color *= std::pow(std::max(1.0 - ratio * ratio, 0.0), 2.0) / glm::dot(to_light, to_light);
                }
                const dvec3 expected =
                    hoffman(dvec3(material.base_color), material.metallic, material.roughness, {0, 0, 1},
                            glm::normalize(dvec3(0, 0, 2) - at), glm::normalize(to_light), color);
                const dvec3 got(pixel(picture, x, y));
                for (int c = 0; c < 3; ++c) {
                    worst = std::max(worst, std::abs(got[c] - expected[c]));
                    brightest = std::max(brightest, expected[c]);
                }
            }
        }
        EXPECT_GT(brightest, 0.01);
        return worst / brightest;
    }
};

// The camera's default field of view must be the one worst_error() assumes.
TEST_F(Surface, TheViewIsTheOneTheReferenceAssumes) { EXPECT_NEAR(Camera{}.fov_y_rad, glm::radians(45.0), 1e-6); }

TEST_F(Surface, DirectLightIsHoffmans) {
    const Case cases[] = {
        {Tier::reference, Arithmetic::full, 2e-3},  // float pow of a power up to 2048, and 16-bit normals
        {Tier::console, Arithmetic::full, 8e-3},    // the lobe's series stops at x^3: 0.6 % of the peak at a power of 2
        {Tier::console, Arithmetic::half, 2e-2},    // the same with 11-bit arithmetic after the chord
        {Tier::low, Arithmetic::full, 8e-3},       {Tier::low, Arithmetic::half, 2e-2},
    };
    for (const Case& test_case : cases) {
        for (const double roughness : {0.15, 0.3, 0.6, 1.0}) {
            for (const double metallic : {0.0, 1.0}) {
                Scene scene = wide_square();
                scene.materials[0].base_color = {0.8f, 0.5f, 0.2f, 1.0f};
                scene.materials[0].roughness = static_cast<float>(roughness);
                scene.materials[0].metallic = static_cast<float>(metallic);
                scene.lights.push_back({.kind = LightKind::sun,
                                        .color = {1.0f, 0.9f, 0.8f},
                                        .direction = glm::normalize(glm::vec3(-0.2f, -0.1f, -1.0f))});
                EXPECT_LT(worst_error(scene, test_case, false), test_case.tolerance)
                    << name(test_case.tier) << ' ' << name(test_case.arithmetic) << " roughness " << roughness
                    << " metallic " << metallic;
            }
        }
    }
}

TEST_F(Surface, PointLightFallsWithTheSquareOfDistance) {
    for (const Case& test_case :
         {Case{Tier::reference, Arithmetic::full, 2e-3}, Case{Tier::console, Arithmetic::full, 8e-3},
          Case{Tier::console, Arithmetic::half, 2e-2}}) {
        Scene scene = wide_square();
        scene.materials[0].roughness = 0.5f;
        scene.lights.push_back(
            {.kind = LightKind::point, .color = {2.0f, 2.0f, 2.0f}, .position = {0.3f, -0.2f, 0.8f}, .range_m = 6.0f});
        EXPECT_LT(worst_error(scene, test_case, true), test_case.tolerance)
            << name(test_case.tier) << ' ' << name(test_case.arithmetic);
    }
}

TEST_F(Surface, AnAntiAlignedHalfVectorIsFinite) {
    // The sun shines along the view: at the centre l = -v, which has no half vector.
    Scene scene = wide_square();
    scene.materials[0].double_sided = true;
    scene.lights.push_back({.kind = LightKind::sun, .color = glm::vec3(1e4f), .direction = {0.0f, 0.0f, 1.0f}});
    for (const Tier tier : {Tier::low, Tier::console}) {
        for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
            for (const float value : scene_color(ground(), scene, square_view(), tier, arithmetic).rgba) {
                ASSERT_TRUE(std::isfinite(value)) << name(tier) << ' ' << name(arithmetic);
            }
        }
    }
}

TEST_F(Surface, AWhiteLambertPlaneShowsTheLightsColour) {
    Scene scene = wide_square();
    scene.lights.push_back({.kind = LightKind::sun, .color = {0.5f, 0.25f, 0.125f}, .direction = {0.0f, 0.0f, -1.0f}});
    const FloatPicture picture = scene_color(ground(), scene, square_view(), Tier::reference, Arithmetic::full);
    // A power of 2 and a reflectance of 0.0437 add (2 + 2)/8 * 0.0437 = 0.0219 at the centre, where n = h.
    const glm::vec3 centre = pixel(picture, 32, 32);
    EXPECT_NEAR(centre.r / 0.5f, 1.0219, 0.005);  // half of a percent, and the pixel is not exactly at the centre
    EXPECT_NEAR(centre.g / 0.25f, 1.0219, 0.005);
    EXPECT_NEAR(centre.b / 0.125f, 1.0219, 0.005);
}

TEST_F(Surface, ConstantAmbientMakesAFurnace) {
    struct Furnace {
        glm::vec4 base;
        float metallic, roughness;
        double expected;
    };
    // Albedo 1 and specular 1 in a white room reflect everything: (1, rough dielectric) adds its own specular on top,
    // because the talk's model does not take it from the diffuse.
    for (const Furnace& furnace : {Furnace{{1, 1, 1, 1}, 1.0f, 0.5f, 1.0}, Furnace{{0, 0, 0, 1}, 1.0f, 1.0f, 0.0}}) {
        Scene scene = wide_square();
        scene.ambient = glm::vec3(1.0f);
        scene.materials[0].base_color = furnace.base;
        scene.materials[0].metallic = furnace.metallic;
        scene.materials[0].roughness = furnace.roughness;
        const FloatPicture picture = scene_color(ground(), scene, square_view(), Tier::console, Arithmetic::full);
        EXPECT_NEAR(pixel(picture, 32, 32).g, furnace.expected, 0.01);
    }
}

TEST_F(Surface, ANormalMapTurnsTheNormal) {
    Scene scene = wide_square();
    // 45 degrees towards +X everywhere: (0.7071, 0, 0.7071) in 8 bits.
    scene.images.push_back({.name = "tilt", .width = 1, .height = 1, .srgb = false, .rgba = {218, 128, 218, 255}});
    scene.materials[0].normal_texture = Texture{.image = 0};
    scene.lights.push_back({.kind = LightKind::sun, .color = glm::vec3(1.0f), .direction = {-1.0f, 0.0f, 0.0f}});
    const FloatPicture tilted = scene_color(ground(), scene, square_view(), Tier::console, Arithmetic::full);
    EXPECT_NEAR(pixel(tilted, 32, 32).g, std::sqrt(0.5), 0.03);  // 8-bit normal, plus up to 0.02 of rough specular
    scene.materials[0].normal_texture = {};
    const FloatPicture flat = scene_color(ground(), scene, square_view(), Tier::console, Arithmetic::full);
    EXPECT_NEAR(pixel(flat, 32, 32).g, 0.0, 0.01) << "without the map the sun only grazes";
}

TEST_F(Surface, AlphaMaskCutsAndBlendMixes) {
    Scene scene = square_scene();
    scene.background = {0.0f, 0.0f, 1.0f};
    scene.ambient = glm::vec3(0.5f);
    scene.materials[0].base_color = {1.0f, 0.0f, 0.0f, 0.4f};
    scene.materials[0].metallic = 0.0f;
    const auto centre = [&](Tier tier) {
        const Picture picture =
            render(scene, square_view(), {.tier = tier}, all_effects(), harness::FlatPicture::is_expected).picture;
        const std::size_t at = (32u * 64u + 32u) * 4u;
        return std::array<int, 3>{picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
    };
    for (const Tier tier : {Tier::low, Tier::console}) {
        scene.materials[0].alpha_mode = AlphaMode::mask;
        scene.materials[0].alpha_cutoff = 0.5f;
        EXPECT_EQ(centre(tier)[2], 255) << "0.4 is under the cutoff: the background shows";
        scene.materials[0].alpha_cutoff = 0.3f;
        EXPECT_GT(centre(tier)[0], 100);
        scene.materials[0].alpha_mode = AlphaMode::blend;
        const auto mixed = centre(tier);
        EXPECT_GT(mixed[0], 20);
        EXPECT_GT(mixed[2], 100);
    }
}

TEST_F(Surface, LowDecodesSrgbAsTheTextureUnitDoes) {
    Scene scene = wide_square();
    scene.ambient = glm::vec3(1.0f);
    scene.materials[0].base_color_texture = Texture{.image = 0, .linear = false, .mipmaps = false};
    for (const int code : {10, 40, 128, 200, 250}) {
        const auto byte = static_cast<std::uint8_t>(code);
        scene.images = {{.name = "grey", .width = 1, .height = 1, .srgb = true, .rgba = {byte, byte, byte, 255}}};
        const double console =
            pixel(scene_color(ground(), scene, square_view(), Tier::console, Arithmetic::full), 32, 32).g;
        const double low = pixel(scene_color(ground(), scene, square_view(), Tier::low, Arithmetic::full), 32, 32).g;
        EXPECT_NEAR(low, console, 0.004) << "code "
                                         << code;  // the cubic of common/colour.glsl is within 0.0018, on albedo and F0
    }
}

TEST_F(Surface, LightsReachOnlyTheirRangeStrongestFirst) {
    Scene scene;
    for (int i = 0; i < 12; ++i) {
        scene.lights.push_back({.kind = LightKind::point,
                                .color = glm::vec3(1.0f + static_cast<float>(i)),
                                .position = {0.0f, 2.0f, 0.0f},
                                .range_m = 5.0f});
    }
    scene.lights.push_back(
        {.kind = LightKind::point, .color = glm::vec3(1e6f), .position = {0.0f, 100.0f, 0.0f}, .range_m = 5.0f});
    scene.lights.push_back({.kind = LightKind::sun});
    int left_out = -1;
    std::vector<int> lights;
    lights_reaching(scene, Box{.low = glm::vec3(-1.0f), .high = glm::vec3(1.0f)}, 8, lights, left_out);
    ASSERT_EQ(lights.size(), 8u);
    EXPECT_EQ(left_out, 4);
    EXPECT_EQ(lights.front(), 11) << "the strongest";
    for (const int light : lights) EXPECT_LT(light, 12) << "neither the one out of range nor the sun";
}

TEST(SurfaceLights, OfEquallyStrongOnesTheOrderInTheFileChoosesNone) {
    Scene scene;  // the box holds all twelve, so that all are as near as can be
    for (int i = 0; i < 12; ++i)
        scene.lights.push_back({.kind = LightKind::point, .position = {0.07f * static_cast<float>(i), 0.0f, 0.0f}});
    const Box box{.low = glm::vec3(-1.0f), .high = glm::vec3(1.0f)};
    const auto chosen = [&] {
        std::vector<int> lights;
        int left_out = 0;
        lights_reaching(scene, box, 8, lights, left_out);
        std::vector<float> places;
        for (const int light : lights) places.push_back(scene.lights[static_cast<std::size_t>(light)].position.x);
        return places;
    };
    const std::vector<float> places = chosen();
    EXPECT_EQ(places.size(), 8u);
    std::ranges::reverse(scene.lights);
    EXPECT_EQ(chosen(), places);
}

TEST_F(Surface, SaysWhichLightsAreLeftOut) {
    Scene scene = wide_square();
    for (int i = 0; i < 10; ++i)
        scene.lights.push_back({.kind = LightKind::point, .position = {0.0f, 0.0f, 1.0f}, .range_m = 5.0f});
    Renderer renderer(gl(), caps());
    renderer.prepare(scene, plan_frame(scene, square_view(), {}, caps(), all_effects()));
    const auto notices = renderer.notices();  // the square is so wide that its positions keep 32 bits: another notice
    const auto tells = [](const std::string& sentence) { return sentence.find("2 weakest") != std::string::npos; };
    EXPECT_EQ(std::ranges::count_if(notices, tells), 1);
}

}  // namespace
}  // namespace halfframe::tests
