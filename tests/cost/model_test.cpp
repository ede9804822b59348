// What the model has to satisfy: published counts, and properties over random passes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "perf/cost/model.h"
#include "tests/cost/count.h"

namespace halfframe::cost {
namespace {

constexpr int kRandomPasses = 10000;
constexpr double kPixels720p = 1280.0 * 720.0;

FragmentWork fragment_of(const ShaderCounts& counts) {
    FragmentWork fragment{.work = counts.weighted.work};
    for (const double count : counts.weighted.fetches) fragment.fetches.push_back({.count = count});
    return fragment;
}

// NVShaderPerf's listings for RSX in the header of NVIDIA's FXAA 3.11 are hand counts: whole cycles, all slots filled.
TEST(Model, TheTwoPublishedListings) {
    const Profile ps3 = load_profile("ps3");
    const FragmentWork first{.work = {.slots = 16.0, .normalizes = 1.0}, .fetches = {{.count = 8}}};
    EXPECT_DOUBLE_EQ(rsx_passes(first, ps3, 1.0), 12.25);
    EXPECT_EQ(std::ceil(rsx_passes(first, ps3, 1.0)), 13.0);
    const FragmentWork second{.work = {.slots = 19.0, .normalizes = 1.0}, .fetches = {{.count = 9}}};
    EXPECT_DOUBLE_EQ(rsx_passes(second, ps3, 1.0), 14.25);
    EXPECT_EQ(std::ceil(rsx_passes(second, ps3, 1.0)), 15.0);
}

// The same mix from text to cycles: eight fetches, sixteen slots, one mediump normalize.
TEST(Model, AShaderOfTheSameMixTakesThirteenCycles) {
    const ShaderCounts counts = counts_of(
        "in vec2 at; uniform vec4 u; uniform sampler2D image; out vec4 color;\nvoid main() {\n"
        "  vec4 a = texture(image, at); vec4 b = texture(image, a.xy); vec4 c = texture(image, a.zw);\n"
        "  vec4 d = texture(image, b.xy); vec4 e = texture(image, b.zw); vec4 f = texture(image, c.xy);\n"
        "  vec4 g = texture(image, c.zw); vec4 h = texture(image, d.xy);\n"
        "  vec4 s = a + b; s = s * c + d; s = s * e + f; s = s * g + h;\n"  // 4 slots
        "  s = s * a + c; s = s * b + d; s = s * f + e; s = s * h + g;\n"   // 4
        "  s = max(s, a); s = min(s, u); s = s * s + b; s = s * d + e;\n"   // 4
        "  s = s * f + g; s.xyz = normalize(s.xyz); s = s * u; s += a;\n"   // 2, and u * s + a is one multiply-add
        "  s = max(s, h); color = min(s, c);\n}\n",                         // 2
        true);
    EXPECT_DOUBLE_EQ(counts.weighted.work.normalizes, 1.0);
    EXPECT_DOUBLE_EQ(counts.weighted.fetch_count(), 8.0);
    EXPECT_DOUBLE_EQ(counts.weighted.work.slots, 16.0);
    EXPECT_EQ(std::ceil(rsx_passes(fragment_of(counts), load_profile("ps3"), 1.0)), 13.0);
}

TEST(Model, EdramTilesOf720p) {
    const Profile x360 = load_profile("x360");
    const auto tiles = [&](int samples, int bytes) { return edram_tiles(1280, 720, samples, bytes, x360); };
    EXPECT_EQ(tiles(1, 4), 720);
    EXPECT_EQ(tiles(1, 4) + tiles(1, 4), 1440);                      // colour and depth
    EXPECT_EQ(tiles(1, 8) + tiles(1, 4), 2160);                      // fp16 and depth
    EXPECT_EQ(tiles(2, 4) + tiles(2, 4), 2880);                      // two samples
    EXPECT_NEAR(resolve_ms(kPixels720p, 4.0, x360), 0.230, 0.0005);  // published to three digits
}

TEST(Model, TilingReplaysCommands) {
    const Profile x360 = load_profile("x360");
    PassWork pass{.name = "surface",
                  .draws = {DrawWork{.vertices = 1e6, .triangles = 1e6, .vertex = {.vector_ops = 8}}}};
    pass.color = TargetWork{.width = 1280, .height = 720, .format = gl::PixelFormat::rgba8};
    pass.depth = TargetWork{.width = 1280, .height = 720, .format = gl::PixelFormat::depth24};
    const PassCost once = cost_of(pass, x360);
    EXPECT_EQ(once.edram_tiles, 1440);
    EXPECT_EQ(once.edram_replays, 1);
    pass.color->samples = pass.depth->samples = 2;
    const PassCost twice = cost_of(pass, x360);
    EXPECT_EQ(twice.edram_replays, 2);
    EXPECT_NEAR(twice.ms - twice.fixed_ms, 2.0 * (once.ms - once.fixed_ms), 1e-9);
}

// Section 4 of the model's source: four naive alpha-blended layers over the screen.
TEST(Model, FourBlendedLayersOnTheRsx) {
    const Profile ps3 = load_profile("ps3");
    const auto layers_ms = [&](gl::PixelFormat format) {
        DrawWork layer{
            .fragments_shaded = kPixels720p, .fragments_written = kPixels720p, .triangles = 2, .blends = true};
        PassWork pass{.name = "rain", .draws = {4, layer}, .color = TargetWork{.format = format}};
        return cost_of(pass, ps3).ms;
    };
    // 1.84 ms of ROPs and 1.77 of memory; the source's 3.1 and 5.1 also hold a shader and depth, which it does not
    // list.
    EXPECT_NEAR(layers_ms(gl::PixelFormat::rgba8), 2.16, 0.02);
    EXPECT_NEAR(layers_ms(gl::PixelFormat::rgba16f), 4.30, 0.02);
}

class RandomPasses : public testing::Test {
protected:
    double number(double lowest, double highest) {
        return std::uniform_real_distribution<double>(lowest, highest)(random_);
    }
    int whole(int lowest, int highest) { return std::uniform_int_distribution<int>(lowest, highest)(random_); }

    FragmentWork fragment() {
        FragmentWork made{.work = {.slots = number(0, 80),
                                   .vector_ops = number(0, 80),
                                   .scalar_ops = number(0, 40),
                                   .mads = number(0, 200),
                                   .normalizes = static_cast<double>(whole(0, 4))}};
        for (int i = whole(0, 4); i > 0; --i) {
            made.fetches.push_back({.count = number(0, 9),
                                    .format = static_cast<TexelFormat>(whole(0, 4)),
                                    .shape = static_cast<SamplerUse::Shape>(whole(0, 3)),
                                    .trilinear = whole(0, 1) == 1,
                                    .target = whole(0, 1) == 1});
        }
        return made;
    }

    PassWork pass() {
        PassWork made{.name = "random", .texture_bytes = number(0, 3e7)};
        made.color = TargetWork{.width = whole(1, 1280),
                                .height = whole(1, 720),
                                .samples = 1 << whole(0, 2),
                                .format = static_cast<gl::PixelFormat>(whole(0, 4)),
                                .resolved = whole(0, 1) == 1};
        if (whole(0, 1) == 1) {
            made.depth = made.color;
            made.depth->format = gl::PixelFormat::depth24;
        }
        for (int i = whole(1, 5); i > 0; --i) {
            DrawWork draw{.fragments_shaded = number(0, 2e6), .vertices = number(0, 1e5), .triangles = number(0, 1e5)};
            draw.fragments_written = draw.fragments_shaded * number(0, 1);
            draw.fragment = {fragment(), fragment(), fragment()};
            draw.temporaries = {whole(0, 20), whole(0, 20)};
            draw.vertex = {.vector_ops = number(0, 60), .scalar_ops = number(0, 30)};
            draw.attributes = whole(1, 8);
            draw.blends = whole(0, 1) == 1;
            draw.writes_depth = draw.tests_depth = whole(0, 1) == 1;
            made.draws.push_back(draw);
        }
        return made;
    }

    /// One count more, somewhere.
    PassWork with_more(PassWork pass) {
        DrawWork& draw = pass.draws[static_cast<std::size_t>(whole(0, static_cast<int>(pass.draws.size()) - 1))];
        FragmentWork& fragment = draw.fragment[0];
        const double more = number(0.1, 1000.0);
        switch (whole(0, 14)) {
            case 0: draw.fragments_shaded += more; break;
            case 1: draw.fragments_written += more; break;
            case 2: draw.vertices += more; break;
            case 3: draw.triangles += more; break;
            case 4: fragment.work += {1.0, 1.0, 1.0, 1.0, 1.0}; break;
            case 5: fragment.fetches.push_back({.count = 1.0}); break;
            case 6: draw.temporaries.full += 1; break;
            case 7: draw.vertex += {1.0, 1.0, 1.0, 1.0, 0.0}; break;
            case 8: pass.texture_bytes += more; break;
            case 9: pass.draws.push_back(draw); break;
            case 10: draw.blends = true; break;
            case 11: pass.color->resolved = true; break;
            case 12: pass.color->loaded = true; break;
            case 13: {  // tiles of EDRAM, and with them replays
                pass.color->samples *= 2;
                if (pass.depth) pass.depth->samples *= 2;
                break;
            }
            default: draw.temporaries.half += 1; break;
        }
        return pass;
    }

    std::mt19937 random_{20130819};
};

TEST_F(RandomPasses, MoreWorkIsNeverCheaperAndTheBandIsInOrder) {
    const std::vector<Profile> profiles = built_in_profiles();
    for (int i = 0; i < kRandomPasses; ++i) {
        const PassWork one = pass();
        const PassWork more = with_more(one);
        for (const Profile& profile : profiles) {
            const PassCost cost = cost_of(one, profile);
            const PassCost dearer = cost_of(more, profile);
            ASSERT_TRUE(std::isfinite(cost.ms)) << i;
            // 1e-12: the norm is a power of a sum of powers, each rounded.
            ASSERT_GE(dearer.ms, cost.ms * (1.0 - 1e-12)) << profile.name << ", pass " << i;
            ASSERT_LE(cost.low_ms, cost.ms) << profile.name << ", pass " << i;
            ASSERT_LE(cost.ms, cost.high_ms) << profile.name << ", pass " << i;
            ASSERT_GT(cost.ms, 0.0);
        }
    }
}

TEST_F(RandomPasses, HalfIsNeverDearerOnTheRsxAndEqualOnXenos) {
    const Profile ps3 = load_profile("ps3"), x360 = load_profile("x360");
    for (int i = 0; i < kRandomPasses; ++i) {
        PassWork full = pass();
        PassWork half = full;
        for (std::size_t d = 0; d < full.draws.size(); ++d) {
            DrawWork& wide = full.draws[d];
            DrawWork& narrow = half.draws[d];
            wide.temporaries = {narrow.temporaries.full + narrow.temporaries.half, 0};
            for (FragmentWork& fragment : wide.fragment) {  // a highp normalize: dot, reciprocal root, product
                fragment.work.slots += 2.0 * fragment.work.normalizes;
                fragment.work.normalizes = 0.0;
            }
        }
        ASSERT_LE(cost_of(half, ps3).ms, cost_of(full, ps3).ms * (1.0 + 1e-12)) << "pass " << i;
        ASSERT_DOUBLE_EQ(cost_of(half, x360).ms, cost_of(full, x360).ms) << "pass " << i;
    }
}

TEST(Model, HalfThePixelsOfAShaderBoundPassTakeHalfTheTime) {
    for (const Profile& profile : built_in_profiles()) {
        DrawWork draw{.fragments_shaded = kPixels720p, .fragments_written = kPixels720p, .vertices = 3, .triangles = 1};
        draw.fragment.fill({.work = {.slots = 60, .vector_ops = 60, .scalar_ops = 20, .mads = 200}});
        PassWork pass{.name = "full", .draws = {draw}, .color = TargetWork{.width = 1280, .height = 720}};
        const PassCost whole = cost_of(pass, profile);
        pass.draws[0].fragments_shaded /= 2.0;
        pass.draws[0].fragments_written /= 2.0;
        pass.color->height /= 2;
        const PassCost half = cost_of(pass, profile);
        EXPECT_TRUE(whole.bound == "shader" || whole.bound == "arithmetic") << whole.bound;
        const double ratio = (half.ms - half.fixed_ms) / (whole.ms - whole.fixed_ms);
        EXPECT_NEAR(ratio, 0.5, 0.025) << profile.name;  // 5 % of a half: the bound that the model's source sets
    }
}

TEST(Model, WhatBindsIsNamed) {
    const Profile ps3 = load_profile("ps3");
    PassWork pass{.name = "depth", .color = TargetWork{.width = 8, .height = 8}};
    EXPECT_EQ(cost_of(pass, ps3).bound, "draws and switches");
    pass.draws.push_back({.triangles = 1e6});
    EXPECT_EQ(cost_of(pass, ps3).bound, "triangles");
    pass.texture_bytes = 1e9;
    EXPECT_EQ(cost_of(pass, ps3).bound, "memory");
}

}  // namespace
}  // namespace halfframe::cost
