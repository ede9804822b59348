// The surface on a real context where the answer is known beforehand: a Lambert sphere, white furnaces, the lobe's
// peak.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "content/shapes.h"
#include "engine/effects/surface/surface_reference.h"
#include "perf/measure/planted_effect.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

using glm::dvec3;

// No glTF material has a specular of 0, and its smoothness is bound to its power. This takes all of them from the base
// colour instead: red is the albedo, green the specular, blue the smoothness.
constexpr gl::Insertion kChosen[] = {
    {"surface.material", nullptr,
     "albedo = vec3(base.r); specular = vec3(base.g); smoothness = base.b; power = exp2(10.0 * base.b + 1.0);"}};
const EffectCard kChosenMaterial =
    perf::planted_effect([](const PlanContext&) { return std::span<const gl::Insertion>(kChosen); });

constexpr int kSize = 96;
constexpr double kHalfHeight_m = 1.05;

/// A sphere of 1 m, fine enough that an interpolated normal is right to 1e-4, of `material` as kChosen reads it.
Scene ball(const glm::vec3& material) {
    Scene scene;
    scene.name = "ball";
    scene.meshes.push_back(content::sphere(1.0f, 256, 128));
    scene.materials.push_back({});
    scene.materials[0].base_color = glm::vec4(material, 1.0f);
    Surface surface;
    surface.name = "ball";
    scene.surfaces.push_back(surface);
    scene.background = glm::vec3(0.0f);
    return scene;
}

/// Along -Z, without perspective: the normal of a pixel follows from its place alone.
View straight_view() {
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, 4.0f, 1.0f};
    camera.orthographic = true;
    camera.half_height_m = static_cast<float>(kHalfHeight_m);
    return view_of(camera, kSize, kSize);
}

struct BallPixel {
    int x, y;
    dvec3 normal;
};

/// Pixels on the ball, without the outermost hundredth, where a pixel sees more than one normal.
std::vector<BallPixel> ball_pixels() {
    std::vector<BallPixel> pixels;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double across = ((x + 0.5) * 2.0 / kSize - 1.0) * kHalfHeight_m;
            const double up = (1.0 - (y + 0.5) * 2.0 / kSize) * kHalfHeight_m;
            const double rest = 1.0 - across * across - up * up;
            if (rest > 0.02) pixels.push_back({x, y, dvec3(across, up, std::sqrt(rest))});
        }
    }
    return pixels;
}

class SurfaceKnownAnswers : public harness::GlFixture {
protected:
    FloatPicture drawn(const Scene& scene, const On& on) {
        std::vector<const EffectCard*> cards(all_effects().begin(), all_effects().end());
        cards.push_back(&kChosenMaterial);
        return scene_color(ground(), scene, straight_view(), on.tier, on.arithmetic, cards);
    }
};

TEST_F(SurfaceKnownAnswers, ALambertSphere) {
    const std::vector<BallPixel> pixels = ball_pixels();
    ASSERT_GT(pixels.size(), 6000u);
    for (const On& on : kEverywhere) {
        for (const dvec3& sun : {dvec3(0, 0, 1), dvec3(1, 0, 0), dvec3(0.5, -0.7, 0.3), dvec3(0, 1, -1)}) {
            const dvec3 l = glm::normalize(sun);
            Scene scene = ball({1.0f, 0.0f, 0.0f});
            // Specular 0 still has Schlick's (1 - l.h)^5 with a lobe of the power of 2: taken off below.
            scene.lights.push_back({.kind = LightKind::sun, .color = glm::vec3(1.0f), .direction = glm::vec3(-l)});
            const FloatPicture picture = drawn(scene, on);
            double drawn_sum = 0.0, true_sum = 0.0;
            for (const BallPixel& at : pixels) {
                const dvec3 h = glm::normalize(l + dvec3(0, 0, 1));
                const double n_l = std::max(glm::dot(at.normal, l), 0.0);
                const double n_h = std::max(glm::dot(at.normal, h), 0.0);
                const double rim = std::pow(1.0 - glm::dot(l, h), 5.0) * 0.5 * n_h * n_h;
                const double got = pixel(picture, at.x, at.y).g;
                // Half of a percent. Found: 8.2e-4 in full (the lobe's series at a power of 2), 1.5e-3 in half.
                ASSERT_NEAR(got, n_l * (1.0 + rim), 5e-3) << on.words() << " at " << at.x << ' ' << at.y;
                drawn_sum += got;
                true_sum += n_l * (1.0 + rim);
            }
            EXPECT_NEAR(drawn_sum, true_sum, 5e-3 * true_sum) << on.words();
        }
    }
}

TEST_F(SurfaceKnownAnswers, ALambertSphereLitFromTheEyeShowsTwoThirdsOfItsLight) {
    // The mean of n.l over the disc: the integral of sqrt(1 - r^2) 2 r dr. No reference of ours is in it.
    for (const On& on : kEverywhere) {
        Scene scene = ball({1.0f, 0.0f, 0.0f});
        scene.lights.push_back({.kind = LightKind::sun, .color = glm::vec3(1.0f), .direction = {0.0f, 0.0f, -1.0f}});
        const FloatPicture picture = drawn(scene, on);
        double sum = 0.0;
        for (std::size_t i = 1; i < picture.rgba.size(); i += 4) sum += picture.rgba[i];
        const double pixels_of_disc = std::numbers::pi * std::pow(kSize / (2.0 * kHalfHeight_m), 2.0);
        EXPECT_NEAR(sum / pixels_of_disc / (2.0 / 3.0), 1.0, 5e-3) << on.words();
    }
}

TEST_F(SurfaceKnownAnswers, WhiteFurnaces) {
    const std::vector<BallPixel> pixels = ball_pixels();
    // Albedo, specular, smoothness. The first five must give back all they get.
    const glm::vec3 furnaces[] = {{1, 0, 0}, {0, 1, 0},          {0, 1, 0.5f},       {0, 1, 1},      {0.5f, 0.5f, 0.5f},
                                  {0, 0, 0}, {1, 0.0437f, 0.3f}, {0.9f, 0.1f, 0.9f}, {0, 0.0437f, 1}};
    for (const On& on : kEverywhere) {
        for (const glm::vec3& furnace : furnaces) {
            Scene scene = ball(furnace);
            scene.ambient = glm::vec3(1.0f);
            const FloatPicture picture = drawn(scene, on);
            const bool keeps_all = &furnace < &furnaces[5];
            for (const BallPixel& at : pixels) {
                const double expected = furnace.r + reference::fresnel_glossy(furnace.g, furnace.b, at.normal.z);
                const double got = pixel(picture, at.x, at.y).g;
                // Found: 1.9e-3 in full, from interpolated normals under the fifth power at the rim; 2.7e-3 in half.
                ASSERT_NEAR(got, expected, 5e-3) << on.words() << " albedo " << furnace.r << " specular " << furnace.g
                                                 << " smoothness " << furnace.b << " n.v " << at.normal.z;
                ASSERT_TRUE(!keeps_all || std::abs(got - 1.0) < 1e-2) << got << ' ' << on.words();
            }
        }
    }
}

TEST_F(SurfaceKnownAnswers, TheHighlightPeaksAtItsNormalisation) {
    // Sun, eye and normal in one line everywhere, so every pixel is the peak: specular (power + 2) / 8.
    const double tolerances[] = {
        5e-4,  // half at low: 1.1e-4 found, roundings of the power, of 1/8 of it and of the product
        1e-6,  // full: 1.5e-7 found
        5e-4,  // console, as low
        1e-6,  // console, full
        5e-4,  // as written: fp32 n.h is 6e-8 to 1.2e-7 from 1, times 2048
    };
    for (std::size_t i = 0; i < std::size(kEverywhere); ++i) {
        for (const float smoothness : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
            Scene scene = wide_square();
            scene.materials[0].base_color = {0.0f, 1.0f, smoothness, 1.0f};
            scene.lights.push_back(
                {.kind = LightKind::sun, .color = glm::vec3(1.0f), .direction = {0.0f, 0.0f, -1.0f}});
            const double peak = (std::exp2(10.0 * smoothness + 1.0) + 2.0) / 8.0;
            const FloatPicture picture = drawn(scene, kEverywhere[i]);
            for (std::size_t at = 1; at < picture.rgba.size(); at += 4) {
                ASSERT_NEAR(picture.rgba[at] / peak, 1.0, tolerances[i]) << kEverywhere[i].words() << ' ' << smoothness;
            }
        }
    }
}

}  // namespace
}  // namespace halfframe::tests
