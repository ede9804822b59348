// The shadow of the sun's map against rays cast in double: edges, acne, leaks, masks, and what casts nothing.
#include "engine/effects/shadow/shadow.h"

#include <gtest/gtest.h>

#include "tests/effects/shadow/traced.h"

namespace halfframe::tests {
namespace {

class Shadow : public harness::GlFixture {};

constexpr std::array kTiers = {Tier::console, Tier::reference};
constexpr std::array kArithmetics = {Arithmetic::half, Arithmetic::full};

Scene floating_box(const glm::vec3& sun) {
    Scene scene = sunny_ground(sun);
    add_body(scene, content::box({1.5f, 0.25f, 1.0f}), {0.25f, 1.0f, 0.0f});
    return scene;
}

TEST_F(Shadow, EdgesAreThoseOfRaysThroughABox) {
    const Scene scene = floating_box({0.6f, -1.0f, 0.4f});
    for (const Tier tier : kTiers) {
        for (const Arithmetic arithmetic : kArithmetics) {
            const TracedGap gap = traced_gap(ground(), scene, slanted_view(240, 180), tier, arithmetic);
            EXPECT_GT(gap.edges, 100);
            EXPECT_GT(gap.dark, 300);
            // Twice what four taps and thirty-six differ from a box (0.049 and 0.019), once the rays start where the
            // step along the normal leads. That step is the larger part of the method's error: 0.17 rms in all.
            const double bound = tier == Tier::reference ? 0.04 : 0.1;
            EXPECT_LT(gap.filter_rms, bound) << name(tier) << ' ' << name(arithmetic);
            EXPECT_LT(gap.rms, 0.25) << name(tier) << ' ' << name(arithmetic);
            EXPECT_GT(gap.rms, 1.5 * bound) << "the check cannot tell whether the step is there";
            EXPECT_GE(gap.darkest, 0.999);
            EXPECT_LE(gap.lightest, 0.001);
        }
    }
    const TracedGap wrong =
        traced_gap(ground(), scene, slanted_view(), Tier::console, Arithmetic::full, {-0.6f, -1.0f, 0.4f});
    EXPECT_GT(wrong.lightest, 0.99) << "the check cannot tell a mirrored sun from the true one";
    EXPECT_LT(wrong.darkest, 0.01);
}

TEST_F(Shadow, TapsAreThoseOfItsOwnTierOnASurfaceOfAnother) {
    const Scene scene = floating_box({0.6f, -1.0f, 0.4f});
    for (const Tier tier : kTiers) {
        const Tier other = tier == Tier::console ? Tier::reference : Tier::console;
        const TracedGap gap = traced_gap(ground(), scene, slanted_view(240, 180), tier, Arithmetic::full,
                                         scene.lights.front().direction, other);
        EXPECT_GT(gap.edges, 100);
        // As where the surface has the shadow's tier. Four taps of a map of 2048 are 0.1 from the box of 36.
        EXPECT_LT(gap.filter_rms, tier == Tier::reference ? 0.04 : 0.1) << name(tier);
    }
}

TEST_F(Shadow, NeitherAcneNorLeakFromNoonToGrazing) {
    for (const float elevation_deg : {90.0f, 75.0f, 45.0f, 20.0f, 8.0f, 3.0f}) {
        const float elevation = elevation_deg * std::numbers::pi_v<float> / 180.0f;
        const glm::vec3 sun(-std::cos(elevation) * 0.8f, -std::sin(elevation), -std::cos(elevation) * 0.6f);
        Scene scene = sunny_ground(sun);
        add_body(scene, content::box(glm::vec3(1.0f)), {0.5f, 0.5f, 0.0f});     // stands on the ground
        add_body(scene, content::quad({2.0f, 2.0f}), {-1.0f, 1.0f, -1.0f}, 0);  // a thin wall
        for (const Tier tier : kTiers) {
            const TracedGap gap = traced_gap(ground(), scene, slanted_view(), tier, Arithmetic::full);
            EXPECT_GT(gap.lit, 1000) << elevation_deg;
            EXPECT_GE(gap.darkest, 0.99) << name(tier) << " acne at " << elevation_deg;
            EXPECT_LE(gap.lightest, 0.01) << name(tier) << " leak at " << elevation_deg;
        }
    }
}

TEST_F(Shadow, BeginsAtTheFoot) {
    // Along the ground behind a wall without thickness, away from the sun: dark from within a few texels of the wall
    // on.
    const Scene scene = [] {
        Scene made = sunny_ground({-1.0f, -1.0f, 0.0f});
        add_body(made, content::quad({2.0f, 1.0f}), glm::vec3(0.0f));
        made.surfaces.back().world_from_local =
            glm::rotate(glm::translate(glm::mat4(1.0f), {-0.5f, 0.5f, 0.0f}), 0.5f * std::numbers::pi_v<float>,
                        glm::vec3(0.0f, 1.0f, 0.0f));
        return made;
    }();
    Camera camera = camera_looking({-0.5f, 4.0f, 0.0f}, {-0.5f, 0.0f, 0.0f}, 0.05f,
                                   Box{glm::vec3(-2.0f, 0.0f, -2.0f), glm::vec3(2.0f, 1.0f, 2.0f)});
    const View view = view_of(camera, 256, 64);
    const TracedScene traced = traced_scene(scene, scene.lights[0].direction);
    for (const Tier tier : kTiers) {
        const Shares drawn = shares(ground(), scene, view, tier, Arithmetic::full);
        const double texel = texel_m(scene, view, tier);
        double farthest_light = 0.0;
        int looked_at = 0;
        for (int x = 0; x < view.width; ++x) {
            const SeenPlace place = seen_place(traced, view, x, 32);
            const double from_foot = -0.5 - place.at[0];
            if (!place.found || place.at[1] > 1e-6 || from_foot < 0.0 || from_foot > 0.8) continue;
            ++looked_at;
            if (drawn.at(x, 32) > 0.01) farthest_light = std::max(farthest_light, from_foot);
        }
        EXPECT_GT(looked_at, 20);
        // Light creeps under a wall by what the filter sees beside its foot: 2.0 texels found at console, 1.3 at
        // reference, whose pixels here are as wide.
        EXPECT_LT(farthest_light, (tier == Tier::reference ? 3.0 : 4.0) * texel) << name(tier);
        EXPECT_LT(texel, 0.005) << "a pixel is 3 mm: texels must be seen";
    }
}

TEST_F(Shadow, ASphereIsNotStainedByItself) {
    Scene scene = sunny_ground({-0.5f, -1.0f, -0.3f});
    add_body(scene, content::sphere(1.0f), {0.0f, 3.0f, 0.0f});
    scene.surfaces.erase(scene.surfaces.begin());
    for (const Tier tier : kTiers) {
        const FloatPicture on = with_shadow(ground(), scene, slanted_view(), tier, Arithmetic::full, true);
        const FloatPicture off = with_shadow(ground(), scene, slanted_view(), tier, Arithmetic::full, false);
        double worst = 0.0;
        for (std::size_t i = 0; i < on.rgba.size(); ++i)
            worst = std::max(worst, double{off.rgba[i]} - double{on.rgba[i]});
        EXPECT_EQ(worst, 0.0) << name(tier);
    }
}

TEST_F(Shadow, HalfAndFullDifferByNoMoreThanTheirShading) {
    const Scene scene = floating_box({0.6f, -1.0f, 0.4f});
    for (const Tier tier : kTiers) {
        const FloatPicture half = with_shadow(ground(), scene, slanted_view(), tier, Arithmetic::half, true);
        const FloatPicture full = with_shadow(ground(), scene, slanted_view(), tier, Arithmetic::full, true);
        double worst = 0.0;
        for (std::size_t i = 0; i < half.rgba.size(); ++i)
            worst = std::max(worst, std::abs(double{half.rgba[i]} - double{full.rgba[i]}));
        EXPECT_GT(worst, 0.0);
        EXPECT_LT(worst, 3e-3) << name(tier);  // half rounds light near 1 to 5e-4; 36 sums: 1.5e-3 found
    }
}

/// A 2 x 2 picture whose left half is opaque.
Image half_opaque() {
    Image image{.name = "half", .width = 2, .height = 2, .srgb = false, .rgba = std::vector<std::uint8_t>(16, 255)};
    image.rgba[7] = image.rgba[15] = 0;
    return image;
}

TEST_F(Shadow, AMaskLetsTheSunThroughAndATranslucentAllOfIt) {
    Scene scene = sunny_ground({0.0f, -1.0f, 0.0f});
    Material masked = white();
    masked.alpha_mode = AlphaMode::mask;
    masked.base_color_texture = {.image = content::add_image(scene, half_opaque()), .linear = false, .mipmaps = false};
    content::add_surface(scene, "mask", content::add_mesh(scene, content::quad({2.0f, 2.0f}), "mask"),
                         content::add_material(scene, masked),
                         glm::rotate(glm::translate(glm::mat4(1.0f), {0.0f, 1.0f, 0.0f}),
                                     -0.5f * std::numbers::pi_v<float>, glm::vec3(1.0f, 0.0f, 0.0f)));
    // From below the mask's height, so that the ground under it is seen.
    const View view = view_of(camera_looking({0.0f, 0.9f, 6.0f}, {0.0f, 0.0f, 0.0f}, 0.6f,
                                             Box{glm::vec3(-10.0f, 0.0f, -10.0f), glm::vec3(10.0f, 3.0f, 10.0f)}),
                              128, 96);
    const auto share_at = [&](const Scene& drawn_scene, Tier tier, double ground_x) {
        const Shares drawn = shares(ground(), drawn_scene, view, tier, Arithmetic::full);
        const glm::dvec4 clip = glm::dmat4(view.clip_from_world()) * glm::dvec4(ground_x, 0.0, 0.0, 1.0);
        const int x = static_cast<int>((clip.x / clip.w * 0.5 + 0.5) * view.width);
        const int y = static_cast<int>((0.5 - clip.y / clip.w * 0.5) * view.height);
        return drawn.at(x, y);
    };
    for (const Tier tier : kTiers) {
        EXPECT_EQ(share_at(scene, tier, -0.5), 0.0) << "the opaque half";
        EXPECT_EQ(share_at(scene, tier, 0.5), 1.0) << "the half that is cut away";
        Scene solid = scene;
        solid.materials[1].alpha_mode = AlphaMode::opaque;
        EXPECT_EQ(share_at(solid, tier, 0.5), 0.0) << "an opaque material has no mask";
        Scene glass = scene;
        glass.materials[1].alpha_mode = AlphaMode::blend;
        add_body(glass, content::box(glm::vec3(0.1f)), {5.0f, 0.5f, -5.0f});  // calls for a map
        EXPECT_EQ(share_at(glass, tier, -0.5), 1.0) << "translucents cast nothing";
    }
}

}  // namespace
}  // namespace halfframe::tests
