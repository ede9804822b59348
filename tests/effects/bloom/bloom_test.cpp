// bloom against its reference: where light goes, how much of it, what must never enter, and what it adds to a picture.
#include "engine/effects/bloom/bloom.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/effects/bloom/bloom_reference.h"
#include "engine/effects/tone_map/tone_map_reference.h"
#include "perf/measure/planted_effect.h"
#include "shaders_es/bloom/bloom_limits.h"
#include "tests/effects/pixel_scene.h"

namespace halfframe::tests {
namespace {

using gl::PixelFormat;

constexpr int kSize = 128;  // pixels; the glow of a pixel in the middle ends 45 pixels away

class Bloom : public harness::GlFixture {};

Scene with_bloom(Scene scene, float strength = 0.25f) {
    scene.bloom = halfframe::Bloom{strength};
    return scene;
}

int divisor_of(Tier tier) {
    return tier == Tier::low       ? BLOOM_LOW_DIVISOR
           : tier == Tier::console ? BLOOM_CONSOLE_DIVISOR
                                   : BLOOM_REFERENCE_DIVISOR;
}

/// `channel` of the glow at the centre of pixel (x, y) of the frame, as linear magnification gives it, in double.
double glow_at(const FloatPicture& glow, int divisor, int x, int y, std::size_t channel = 0) {
    const double u = (x + 0.5) / divisor - 0.5, v = (y + 0.5) / divisor - 0.5;
    const auto texel = [&](double column, double row) {
        const int i = std::clamp(static_cast<int>(column), 0, glow.width - 1);
        const int j = std::clamp(static_cast<int>(row), 0, glow.height - 1);
        return double{glow.rgba[static_cast<std::size_t>(j * glow.width + i) * 4 + channel]};
    };
    const double left = std::floor(u), top = std::floor(v), s = u - left, t = v - top;
    return (1.0 - t) * ((1.0 - s) * texel(left, top) + s * texel(left + 1, top)) +
           t * ((1.0 - s) * texel(left, top + 1) + s * texel(left + 1, top + 1));
}

double sum_of(const FloatPicture& glow, std::size_t channel) {
    double sum = 0.0;
    for (std::size_t i = channel; i < glow.rgba.size(); i += 4) sum += double{glow.rgba[i]};
    return sum;
}

TEST_F(Bloom, SpreadsOnePixelAsTheReference) {
    const double excess = reference::blooming_light({5.0, 5.0, 5.0})[0];
    for (const Tier tier : {Tier::console, Tier::reference}) {
        const int divisor = divisor_of(tier);
        std::vector<double> mean(2 * 40 + 1, 0.0);  // across the middle, all places in a block together
        double worst = 0.0, worst_of_wrong = 0.0;
        for (int phase = 0; phase < divisor; ++phase) {
            LightPicture picture(kSize, kSize);
            const int middle = kSize / 2 + phase;
            picture.at(middle, middle) = glm::vec3(5.0f);
            const FloatPicture glow =
                target_after(ground(), with_bloom(pixel_scene(picture)), pixel_view(kSize, kSize),
                             {.tier = tier, .arithmetic = Arithmetic::full, .storage = PixelFormat::rgba32f}, "bloom");
            for (int y = -40; y <= 40; ++y) {
                for (int x = -40; x <= 40; ++x) {
                    const double got = glow_at(glow, divisor, middle + x, middle + y) / excess;
                    worst = std::max(worst, std::abs(got - reference::glow_share(x, y)));
                    // The same glow, a quarter narrower.
                    const double wrong = reference::glow_share(x * 5 / 4, y * 5 / 4) * 25.0 / 16.0;
                    worst_of_wrong = std::max(worst_of_wrong, std::abs(got - wrong));
                    mean[static_cast<std::size_t>(x + 40)] += got / divisor;
                }
            }
        }
        const double peak = reference::glow_share(0, 0);
        // 0.15 of the peak: a light in the corner of its block glows round the block's centre, 1.5 pixels away in both
        // directions, over a slope of up to 0.05 of the peak a pixel; measured 0.12 (console) and 0.05 (reference).
        EXPECT_LE(worst, 0.15 * peak) << name(tier);
        EXPECT_GE(worst_of_wrong, 0.3 * peak) << "the check cannot tell a narrower glow";
        // 2.5: beyond 40 pixels lies 0.1 % of the light, at 12 times the mean square distance.
        EXPECT_NEAR(reference::spread(mean), BLOOM_SIGMA * BLOOM_SIGMA, 2.5) << name(tier);
    }
}

TEST_F(Bloom, KeepsTheLightThatEntered) {
    struct Storage {
        PixelFormat format;
        double tolerance;  ///< relative
    };
    // RGBA32F: weights rounded to 7 digits. RGBA16F and R11G11B10F: llvmpipe stores by truncation, three times in a
    // row, 2^-11 and 2^-7 on average (2^-6 for blue). RGB10_A2: it truncates codes of the square root, and the blue of
    // this glow has codes of 10: measured 0.15.
    const Storage storages[] = {{PixelFormat::rgba32f, 1e-4},
                                {PixelFormat::rgba16f, 3e-3},
                                {PixelFormat::r11g11b10f, 0.06},
                                {PixelFormat::rgb10_a2, 0.3}};
    const glm::vec3 light(6.0f, 3.0f, 0.5f);
    const auto excess = reference::blooming_light({6.0, 3.0, 0.5});
    for (const Tier tier : {Tier::console, Tier::reference}) {
        for (const Storage& storage : storages) {
            if (!caps().renders[static_cast<std::size_t>(storage.format)]) continue;
            LightPicture picture(kSize, kSize);
            for (int i = 0; i < 6; ++i) picture.at(61 + i, 58 + 2 * i) = light;
            const FloatPicture glow =
                target_after(ground(), with_bloom(pixel_scene(picture)), pixel_view(kSize, kSize),
                             {.tier = tier, .arithmetic = Arithmetic::full, .storage = storage.format}, "bloom");
            for (std::size_t channel = 0; channel < 3; ++channel) {
                double sum = sum_of(glow, channel);
                if (storage.format == PixelFormat::rgb10_a2) {
                    sum = 0.0;
                    for (std::size_t i = channel; i < glow.rgba.size(); i += 4)
                        sum += 8.0 * double{glow.rgba[i]} * double{glow.rgba[i]};
                }
                const double expected = 6.0 * excess[channel] / (divisor_of(tier) * divisor_of(tier));
                EXPECT_NEAR(sum, expected, storage.tolerance * expected)
                    << name(tier) << ' ' << name(storage.format) << ' ' << channel;
            }
        }
    }
}

TEST_F(Bloom, LightAtTheThresholdAddsNothing) {
    LightPicture picture(64, 64);
    for (int y = 16; y < 48; ++y) {
        for (int x = 16; x < 48; ++x) picture.at(x, y) = glm::vec3(1.0f);
    }
    LightPicture brighter = picture;
    for (glm::vec3& light : brighter.light) light *= 1.1f;
    const View view = pixel_view(64, 64);
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
            const Wishes on{.tier = tier, .arithmetic = arithmetic};
            Wishes off = on;
            off.effect_switches = {{"bloom", false}};
            const Scene at_threshold = with_bloom(pixel_scene(picture), 1.0f);
            EXPECT_EQ(display_after(ground(), at_threshold, view, on).rgba,
                      display_after(ground(), at_threshold, view, off).rgba)
                << name(tier) << ' ' << name(arithmetic);
            const Scene above = with_bloom(pixel_scene(brighter), 1.0f);
            EXPECT_NE(display_after(ground(), above, view, on).rgba, display_after(ground(), above, view, off).rgba)
                << name(tier) << ' ' << name(arithmetic);
        }
    }
}

/// What a wall of light adds to the dark beside it is known: the Gaussian's tail.
TEST_F(Bloom, AWallOfLightGlowsAsTheTailOfTheGaussian) {
    constexpr double kDark = 0.05, kBright = 4.0, kStrength = 0.25;
    LightPicture picture(kSize, 32, glm::vec3(static_cast<float>(kDark)));
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < kSize / 2; ++x) picture.at(x, y) = glm::vec3(static_cast<float>(kBright));
    }
    const Scene scene = with_bloom(pixel_scene(picture), static_cast<float>(kStrength));
    // 3 codes: rounding to a code, and straight lines between texels for a smooth glow; measured 1.5, in half 1.7. 12
    // at the low tier: 8 bits of display values hold a light of 4 to 0.1, and screening is not adding light;
    // measured 5.8.
    for (const auto& [tier, arithmetic, tolerance] : {std::tuple{Tier::console, Arithmetic::full, 3.0},
                                                      {Tier::console, Arithmetic::half, 3.0},
                                                      {Tier::reference, Arithmetic::full, 3.0},
                                                      {Tier::low, Arithmetic::full, 12.0},
                                                      {Tier::low, Arithmetic::half, 12.0}}) {
        const Picture got =
            display_after(ground(), scene, pixel_view(kSize, 32),
                          {.tier = tier, .effect_switches = {{"anti_alias", false}}, .arithmetic = arithmetic});
        double worst = 0.0, least_gain = 255.0;
        for (int x = kSize / 2; x < kSize - 24; ++x) {
            const double distance = x + 0.5 - kSize / 2;
            const double tail = 0.5 * std::erfc(distance / (BLOOM_SIGMA * std::numbers::sqrt2));
            const double expected = 255.0 * reference::tone_curve(kDark + kStrength * (kBright - 1.0) * tail);
            const double code = got.rgba[static_cast<std::size_t>(16 * kSize + x) * 4];
            worst = std::max(worst, std::abs(code - expected));
            if (distance < 8.0) least_gain = std::min(least_gain, code - 255.0 * reference::tone_curve(kDark));
        }
        EXPECT_LE(worst, tolerance) << name(tier) << ' ' << name(arithmetic);
        EXPECT_GE(least_gain, 40.0) << name(tier) << ": nothing glows";
    }
}

/// Spoils the light of every material whose alpha is under 0.75 in the way that `code` says.
struct Spoiler {
    gl::Insertion insertion[1];
    const char* what;
};
constexpr Spoiler kSpoilers[] = {
    {{{"surface.color", nullptr, "if (base_color.a < 0.75) color *= (color.r - color.r) / (color.r - color.r);"}},
     "nan"},
    {{{"surface.color", nullptr, "if (base_color.a < 0.75) color *= 1e30 * base_color.a * 1e30;"}}, "inf"},
    {{{"surface.color", nullptr, "if (base_color.a < 0.75) color = -color;"}}, "negative"}};
const Spoiler* spoiler_in_force = nullptr;  // cards are plain functions: they cannot carry which one
const EffectCard kSpoilt = perf::planted_effect(
    [](const PlanContext&) { return std::span<const gl::Insertion>(spoiler_in_force->insertion); });

TEST_F(Bloom, WhatIsNoLightDoesNotSpread) {
    const std::vector<const EffectCard*> cards = perf::all_effects_and(kSpoilt);
    LightPicture picture(kSize, kSize);
    picture.at(64, 64) = glm::vec3(3.0f);
    Scene scene = with_bloom(pixel_scene(picture));
    scene.materials[0].base_color = {0.5f, 0.5f, 0.5f, 1.0f};  // the dark: light of a half, which does not bloom
    Mesh mesh = scene.meshes[1];                               // the light, once more beside it, spoilt
    for (glm::vec3& position : mesh.positions) position += glm::vec3(2.0f, 0.0f, 0.1f);
    scene.meshes.push_back(mesh);
    scene.materials.push_back({.base_color = {3.0f, 3.0f, 3.0f, 0.5f}});
    scene.surfaces.push_back(
        {.name = "spoilt", .mesh = 2, .material = 2, .world_from_local = glm::mat4(1.0f), .dynamic = false});
    const double alone = reference::blooming_light({3.0, 3.0, 3.0})[0];
    for (const Tier tier : {Tier::console, Tier::reference}) {
        for (const Spoiler& spoiler : kSpoilers) {
            spoiler_in_force = &spoiler;
            const auto [census, glow] = draw_and_read(
                ground(), scene, pixel_view(kSize, kSize),
                {.tier = tier,
                 .effect_switches = {{"anti_alias", false}},
                 .arithmetic = Arithmetic::full,
                 .census = true},
                [](Renderer& renderer) {
                    return std::pair{renderer.census(), renderer.read_target(renderer.plan().target_index("bloom"))};
                },
                cards);
            for (const CensusRow& row : census) {
                const std::string what = spoiler.what;
                const std::uint64_t found = what == "nan" ? row.nan : what == "inf" ? row.inf : row.negative;
                if (row.target == "scene_color") {
                    EXPECT_GT(found, 0u) << "nothing was planted: " << what;
                } else {
                    EXPECT_EQ(row.nan + row.inf + row.negative, 0u) << row.target << ' ' << what;
                }
            }
            const double entered = sum_of(glow, 0) * divisor_of(tier) * divisor_of(tier);
            // An infinite light counts as one of 8; NaN and negatives as none.
            const double expected = alone + (std::string(spoiler.what) == "inf" ? 7.0 : 0.0);
            EXPECT_NEAR(entered, expected, 1e-3) << spoiler.what;
        }
    }
}

TEST_F(Bloom, FramesOfOddSizesGlowToo) {
    for (const auto& [width, height] : {std::pair{1, 1}, {4096, 1}, {3, 5}, {130, 67}}) {
        const LightPicture picture(width, height, glm::vec3(3.0f));
        const Scene scene = with_bloom(pixel_scene(picture));
        for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
            const Picture got = display_after(ground(), scene, pixel_view(width, height),
                                              {.tier = tier, .arithmetic = Arithmetic::full});
            // Light everywhere: the glow is the excess itself, also beyond the border. Low screens it over the display,
            // and holds the light of 3 as a code of 244: 4 codes.
            const double expected =
                tier == Tier::low
                    ? 255.0 * (1.0 - (1.0 - reference::tone_curve(3.0)) * (1.0 - reference::tone_curve(0.5)))
                    : 255.0 * reference::tone_curve(3.5);
            for (std::size_t i = 0; i < got.rgba.size(); i += 4)
                ASSERT_NEAR(got.rgba[i], expected, tier == Tier::low ? 4.0 : 1.0)
                    << width << 'x' << height << ' ' << name(tier) << " at " << i / 4;
        }
    }
}

TEST_F(Bloom, HalfIsWithinTwoCodesOfFull) {
    LightPicture picture(kSize, kSize, glm::vec3(0.02f));
    for (int i = 0; i < kSize; i += 7) picture.at(i, (i * 5) % kSize) = {7.0f, 3.0f, 1.0f};
    for (int y = 40; y < 52; ++y) {
        for (int x = 80; x < 96; ++x) picture.at(x, y) = {1.1f, 0.7f, 3.2f};
    }
    const Scene scene = with_bloom(pixel_scene(picture), 1.0f);
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        const Picture half =
            display_after(ground(), scene, pixel_view(kSize, kSize),
                          {.tier = tier, .effect_switches = {{"anti_alias", false}}, .arithmetic = Arithmetic::half});
        const Picture full =
            display_after(ground(), scene, pixel_view(kSize, kSize),
                          {.tier = tier, .effect_switches = {{"anti_alias", false}}, .arithmetic = Arithmetic::full});
        int worst = 0;
        for (std::size_t i = 0; i < half.rgba.size(); ++i)
            worst = std::max(worst, std::abs(half.rgba[i] - full.rgba[i]));
        // 2 codes: 11 bits in each of 17 taps and in the tone curve. 8 at the low tier: on the way back to light the
        // curve has slopes up to 299, which multiply the rounding of bright codes; measured 4.
        EXPECT_LE(worst, tier == Tier::low ? 8 : 2) << name(tier);
    }
}

TEST(BloomPlan, IsCalledForByWhatShinesAboveOneAndByNothingElse) {
    Scene scene = square_scene();
    EXPECT_FALSE(plan(scene).find("bloom")->in);
    EXPECT_EQ(plan(scene).target_index("bloom"), -1);
    scene.materials[0].emissive = glm::vec3(1.0f);
    EXPECT_FALSE(plan(scene).find("bloom")->in) << plan(scene).find("bloom")->why;
    scene.materials[0].emissive = {0.2f, 1.5f, 0.2f};
    EXPECT_TRUE(plan(scene).find("bloom")->in);
    EXPECT_NE(plan(scene).find("bloom")->why.find("1.5"), std::string::npos) << plan(scene).find("bloom")->why;
    View dimmed = square_view();
    dimmed.exposure = 0.5f;
    EXPECT_FALSE(plan_frame(scene, dimmed, {}, able_caps(), all_effects()).find("bloom")->in);
    scene.bloom = halfframe::Bloom{.strength = 0.0f};
    EXPECT_FALSE(plan(scene).find("bloom")->in);
    scene.materials[0].emissive = glm::vec3(0.0f);
    scene.bloom = halfframe::Bloom{};
    EXPECT_TRUE(plan(scene).find("bloom")->in);
    scene.bloom.reset();
    scene.sky = Sky{};
    EXPECT_FALSE(plan(scene).find("bloom")->in);
    scene.sky->horizon = glm::vec3(0.85f);
    EXPECT_TRUE(plan(scene).find("bloom")->in) << "display code 217 is above 214";
    Scene unused = square_scene();
    unused.materials.push_back({.emissive = glm::vec3(5.0f)});
    EXPECT_FALSE(plan(unused).find("bloom")->in) << "no surface has that material";
}

TEST(BloomPlan, AddsNoPassOfFullSizeWhereLightIsStored) {
    const FramePlan frame = plan(with_bloom(square_scene()), {.effect_switches = {{"anti_alias", false}}});
    EXPECT_EQ(pass_names(frame),
              (std::vector<std::string>{"surface", "bloom_bright", "bloom_across", "bloom_down", "tone_map"}));
    for (const Pass& pass : frame.passes) {
        if (pass.effect != "bloom") continue;
        EXPECT_EQ(frame.targets[static_cast<std::size_t>(*pass.color)].width, 16);
    }
    EXPECT_DOUBLE_EQ(frame.bytes_per_pixel(), 17.0) << "16 without bloom, two RGBA16F targets of a sixteenth";
    const FramePlan low = plan(with_bloom(square_scene()), {.tier = Tier::low}, poor_caps());
    EXPECT_EQ(pass_names(low),
              (std::vector<std::string>{"surface", "bloom_bright", "bloom_across", "bloom_down", "bloom_display"}));
    EXPECT_EQ(broken_rule(low, poor_caps()), std::nullopt);
}

}  // namespace
}  // namespace halfframe::tests
