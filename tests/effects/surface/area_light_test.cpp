// Lights with a radius: against the integral over the sphere in double, and where a sphere has no point-light answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/effects/surface/surface_reference.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

using reference::Vector;

Vector unit(const glm::dvec3& a) {
    const glm::dvec3 n = glm::normalize(a);
    return {n.x, n.y, n.z};
}

constexpr On kGrounds[] = {
    {Tier::console, Arithmetic::full}, {Tier::console, Arithmetic::half}, {Tier::reference, Arithmetic::full}};

class AreaLight : public harness::GlFixture {
protected:
    static constexpr int kWidth = 256;
    /// Half of the width of what the camera sees of the plane z = 0 from 2 m [m].
    static double half_width_m() { return 2.0 * std::tan(glm::radians(45.0) / 2.0); }

    /// A mirroring square 100 m wide under a light at `height_m`, straight between the eye and it.
    static Scene mirror(float height_m, float radius_m, float roughness) {
        Scene scene = wide_square();
        scene.materials[0].metallic = 1.0f;
        scene.materials[0].roughness = roughness;
        scene.lights.push_back(
            {.kind = LightKind::point, .position = {0.0f, 0.0f, height_m}, .range_m = 100.0f, .radius_m = radius_m});
        return scene;
    }

    std::vector<double> drawn_row(const Scene& scene, const On& on) {
        const FloatPicture picture = scene_color(ground(), scene, square_view(kWidth, kWidth), on.tier, on.arithmetic);
        std::vector<double> row;
        for (int x = kWidth / 2; x < kWidth; ++x) row.push_back(pixel(picture, x, kWidth / 2).g);
        return row;
    }

    /// The same pixels, from the middle of the picture to its right, by integrating over the sphere.
    static std::vector<double> true_row(const Light& light, double power) {
        std::vector<double> row;
        for (int x = kWidth / 2; x < kWidth; ++x) {
            const glm::dvec3 at{((x + 0.5) * 2.0 / kWidth - 1.0) * half_width_m(), -half_width_m() / kWidth, 0.0};
            const glm::dvec3 to_light = glm::dvec3(light.position) - at;
            const double distance_m = glm::length(to_light);
            row.push_back(reference::sphere_light(
                0.0, 1.0, power, {0.0, 0.0, 1.0}, unit(glm::dvec3(0, 0, 2) - at), unit(to_light),
                reference::distance_falloff(distance_m, double(light.range_m)), light.radius_m / distance_m));
        }
        return row;
    }

    /// Where the row falls to half of its first value [pixels].
    static double half_width(const std::vector<double>& row) {
        for (std::size_t x = 1; x < row.size(); ++x) {
            if (row[x] > 0.5 * row[0]) continue;
            const double rest = (row[x - 1] - 0.5 * row[0]) / (row[x - 1] - row[x]);
            return static_cast<double>(x) - 1.0 + rest;
        }
        return static_cast<double>(row.size());
    }
};

constexpr float kRoughness = 0.25f;
const double kPower = reference::power_from_roughness(kRoughness);  // 510

/// Width of a highlight at half its height, in degrees that the half vector turns: what the plane shows of it is longer
/// under a distant light, because the plane is flat.
double turned_deg(double pixels, double height_m) {
    const double at_m = pixels / (256 / 2) * 2.0 * std::tan(glm::radians(45.0) / 2.0);
    return glm::degrees(std::atan(at_m / 2.0) + std::atan(at_m / height_m));
}

TEST_F(AreaLight, TheHighlightNarrowsWithDistanceAsTheSpheresDoes) {
    for (const On& on : kGrounds) {
        double nearer_deg = 1e9;
        for (const float height_m : {0.6f, 1.0f, 2.0f, 4.0f, 8.0f}) {
            const Scene scene = mirror(height_m, 0.3f, kRoughness);
            const std::vector<double> drawn = drawn_row(scene, on);
            const std::vector<double> truth = true_row(scene.lights[0], kPower);
            const double drawn_deg = turned_deg(half_width(drawn), height_m);
            const double true_deg = turned_deg(half_width(truth), height_m);
            const std::string where =
                std::string(name(on.tier)) + ' ' + name(on.arithmetic) + " at " + std::to_string(height_m) + " m";
            EXPECT_LT(drawn_deg, nearer_deg) << where;
            // A lobe is narrower at half its height than the disc it stands for: 20 % at 0.6 m, 13 % at 1 m, 0.6 % at 2
            // m.
            EXPECT_NEAR(drawn_deg / true_deg, 1.0, 0.25) << where;
            // The rational form of the peak: 6.4 % at 2 m, where power ratio^2 / 8 is 1.4.
            EXPECT_NEAR(drawn[0] / truth[0], 1.0, 0.09) << where;
            nearer_deg = drawn_deg;
        }
    }
}

TEST_F(AreaLight, ARadiusOfZeroIsAPointToTheBit) {
    for (const On& on : kGrounds) {
        Scene scene = mirror(1.0f, 0.0f, kRoughness);
        scene.materials[0].metallic = 0.5f;
        scene.lights.push_back({.kind = LightKind::spot,
                                .position = {0.3f, 0.2f, 0.5f},
                                .direction = {0.0f, 0.0f, -1.0f},
                                .range_m = 5.0f});
        // Black, so that only its radius matters: it turns the whole draw to the program that knows spheres.
        scene.lights.push_back({.kind = LightKind::point, .color = glm::vec3(0.0f), .position = {0.0f, 0.0f, 1.0f}});
        const FloatPicture points = scene_color(ground(), scene, square_view(), on.tier, on.arithmetic);
        scene.lights[2].radius_m = 0.5f;
        const FloatPicture beside_a_sphere = scene_color(ground(), scene, square_view(), on.tier, on.arithmetic);
        EXPECT_EQ(points.rgba, beside_a_sphere.rgba) << name(on.tier) << ' ' << name(on.arithmetic);
        scene.lights[0].radius_m = 0.2f;
        const FloatPicture sphere = scene_color(ground(), scene, square_view(), on.tier, on.arithmetic);
        EXPECT_NE(points.rgba, sphere.rgba) << name(on.tier) << ' ' << name(on.arithmetic);
    }
}

TEST_F(AreaLight, AtLowEveryLightIsAPoint) {
    Scene scene = mirror(1.0f, 0.0f, kRoughness);
    scene.materials[0].metallic = 0.0f;
    const FloatPicture point = scene_color(ground(), scene, square_view(), Tier::low, Arithmetic::half);
    scene.lights[0].radius_m = 0.3f;
    const FloatPicture sphere = scene_color(ground(), scene, square_view(), Tier::low, Arithmetic::half);
    EXPECT_EQ(point.rgba, sphere.rgba);
}

// Points of the square inside the sphere, and a sphere whose centre lies on it, behind it, or nowhere but at the eye.
TEST_F(AreaLight, InsideTheSphereLightIsFiniteAndNoBrighterThanOnIt) {
    constexpr float kRadius_m = 0.4f;
    for (const On& on : kGrounds) {
        for (const float height_m : {-0.1f, 0.0f, 1e-4f, 0.05f, 0.4f, 2.0f}) {
            for (const float roughness : {0.0f, 1.0f}) {
                const Scene scene = mirror(height_m, kRadius_m, roughness);
                const FloatPicture picture = scene_color(ground(), scene, square_view(), on.tier, on.arithmetic);
                // On its surface pi L arrives; the power that a ratio of 1 leaves of 2048 is 8, whose peak is 1.25.
                const double most = 1.25 / (kRadius_m * kRadius_m);
                for (const float value : picture.rgba) {
                    ASSERT_TRUE(std::isfinite(value)) << height_m << ' ' << roughness << ' ' << name(on.tier);
                    ASSERT_LE(value, most * 1.01) << height_m << ' ' << roughness << ' ' << name(on.tier);
                }
                EXPECT_GT(pixel(picture, 32, 32).g, height_m > 0.01f ? 0.1 : -1.0) << height_m;
            }
        }
    }
}

}  // namespace
}  // namespace halfframe::tests
