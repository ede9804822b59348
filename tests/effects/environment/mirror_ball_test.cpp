// A mirror ball in a studio, pixel by pixel against the map it reflects, looked up in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "content/content.h"
#include "content/shapes.h"
#include "tests/content/environment_reference.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

using glm::dvec3;

constexpr int kSide = 96;
constexpr double kEye_m = 4.0;
constexpr float kFovY_rad = 0.6f;

/// A ball of 1 m at the origin that reflects everything.
Scene mirror_ball(float roughness) {
    Scene scene;
    scene.name = "mirror ball";
    scene.meshes.push_back(content::sphere(1.0f, 192, 96));
    scene.materials.push_back({.base_color = glm::vec4(1.0f), .metallic = 1.0f, .roughness = roughness});
    scene.surfaces.push_back({.name = "ball"});
    scene.environment = content::environment("studio", {.size = 64}).map;
    return scene;
}

/// The unit normal where the ray through the pixel's centre meets the ball; none: it passes.
std::optional<dvec3> normal_under(int x, int y, dvec3& ray) {
    const double half = std::tan(0.5 * double{kFovY_rad});
    ray = glm::normalize(dvec3(((x + 0.5) / kSide * 2.0 - 1.0) * half, (1.0 - (y + 0.5) / kSide * 2.0) * half, -1.0));
    const double along = -kEye_m * ray.z;
    const double inside = along * along - (kEye_m * kEye_m - 1.0);
    if (inside <= 0.0) return std::nullopt;
    return glm::normalize(dvec3(0.0, 0.0, kEye_m) + ray * (along - std::sqrt(inside)));
}

struct Gap {
    double largest = 0.0;  ///< of the brightest radiance of the map
    double p95 = 0.0;
};

class MirrorBall : public harness::GlFixture {
protected:
    /// The picture against what `expected(mirrored direction)` says, over the ball but for its rim, where a pixel spans
    /// tens of degrees of surroundings.
    template <typename Expected>
    Gap gap(const Scene& scene, Tier tier, Arithmetic arithmetic, const Expected& expected) {
        Camera camera;
        camera.world_from_view[3] = glm::vec4(0.0f, 0.0f, static_cast<float>(kEye_m), 1.0f);
        camera.fov_y_rad = kFovY_rad;
        const FloatPicture picture = scene_color(ground(), scene, view_of(camera, kSide, kSide), tier, arithmetic);
        double brightest = 0.0;
        for (const glm::vec3& texel : scene.environment->levels[0])
            brightest = std::max({brightest, double{texel.r}, double{texel.g}, double{texel.b}});
        std::vector<double> errors;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                dvec3 ray;
                const auto normal = normal_under(x, y, ray);
                if (!normal || normal->z < 0.35) continue;
                const dvec3 mirrored = glm::reflect(ray, *normal);
                const dvec3 difference = glm::abs(dvec3(pixel(picture, x, y)) - expected(mirrored));
                errors.push_back(std::max({difference.x, difference.y, difference.z}) / brightest);
            }
        }
        EXPECT_GT(errors.size(), 2000u);
        std::ranges::sort(errors);
        return {errors.back(), errors[errors.size() * 95 / 100]};
    }
};

TEST_F(MirrorBall, ShowsTheEnvironmentItStandsIn) {
    const Scene scene = mirror_ball(0.0f);
    const auto level_0 = [&](const dvec3& toward) { return sampled(*scene.environment, 0, place_of(toward)); };
    const auto turned = [&](const dvec3& toward) { return level_0({-toward.x, toward.y, toward.z}); };
    struct Case {
        Tier tier;
        Arithmetic arithmetic;
    };
    for (const Case& on : {Case{Tier::console, Arithmetic::full}, Case{Tier::console, Arithmetic::half},
                           Case{Tier::reference, Arithmetic::full}}) {
        const Gap found = gap(scene, on.tier, on.arithmetic, level_0);
        // Largest, 0.026: at a soft box's edge the driver's 8-bit filter weights, facets of 2 degrees and RGBM8's blend
        // of roots move light by part of a texel. p95, 0.0031 in half, 0.0025 in full, 0.0007 at the reference tier:
        // away from edges what is left is RGBM8's rounding and half's direction.
        EXPECT_LT(found.largest, 0.05) << name(on.tier) << " " << name(on.arithmetic);
        EXPECT_LT(found.p95, on.tier == Tier::reference ? 0.0015 : 0.006)
            << name(on.tier) << " " << name(on.arithmetic);
        EXPECT_GT(gap(scene, on.tier, on.arithmetic, turned).p95, 0.2) << "a mirrored studio passes too";
    }
}

}  // namespace
}  // namespace halfframe::tests
