// Mip levels in linear light, masks that keep their share, maps packed into one, DXT, and a budget of bytes.
#include "engine/frame/texture_storage.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace halfframe {
namespace {

Image image_of(int width, int height, auto texel) {
    Image image{.name = "image", .width = width, .height = height, .srgb = true, .rgba = {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::array<int, 4> values = texel(x, y);
            for (const int value : values) image.rgba.push_back(static_cast<std::uint8_t>(value));
        }
    }
    return image;
}

TEST(TextureStorage, LevelsAreMeansOfLight) {
    const Image checker = image_of(8, 8, [](int x, int y) {
        const int v = (x + y) % 2 * 255;
        return std::array{v, v, v, v};
    });
    const auto levels = mip_chain(checker, TexelKind::color, std::nullopt);
    ASSERT_EQ(levels.size(), 4u);
    EXPECT_EQ(levels[1].rgba[0], 188) << "half of white's light; a mean of codes would be 128";
    EXPECT_EQ(levels[1].rgba[3], 128) << "alpha is linear";
    EXPECT_EQ(levels[3].rgba[0], 188);
    EXPECT_EQ(mip_chain(checker, TexelKind::data, std::nullopt)[1].rgba[0], 128);
}

TEST(TextureStorage, OddSizesLoseNoTexel) {
    const Image bar = image_of(5, 3, [](int x, int) { return std::array{x == 4 ? 255 : 0, 0, 0, 255}; });
    const auto levels = mip_chain(bar, TexelKind::data, std::nullopt);
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(levels[1].width, 2);
    EXPECT_EQ(levels[1].height, 1);
    EXPECT_EQ(levels[1].rgba[0], 0);
    EXPECT_EQ(levels[1].rgba[4], 102) << "the last of 2.5 texels: 255 / 2.5";
    EXPECT_EQ(levels[2].rgba[0], 51) << "a fifth of 255";
}

/// Leaves: discs of alpha that thin out when averaged.
Image leaves() {
    return image_of(64, 64, [](int x, int y) {
        const double dx = x % 8 - 3.5, dy = y % 8 - 3.5;
        return std::array{30, 90, 20, static_cast<int>(std::clamp(300.0 - 90.0 * std::hypot(dx, dy), 0.0, 255.0))};
    });
}

TEST(TextureStorage, MasksKeepTheirShare) {
    constexpr float kCutoff = 0.5f;
    const double wanted = alpha_coverage(leaves(), kCutoff);
    const auto kept = mip_chain(leaves(), TexelKind::color, kCutoff);
    const auto plain = mip_chain(leaves(), TexelKind::color, std::nullopt);
    double worst_plain = 0.0;
    for (std::size_t level = 1; level < kept.size(); ++level) {
        // Texels that are alike pass together. The discs repeat every 8 texels: at level 1 four kinds are left of 16,
        // so that the share goes in quarters at worst; from level 2 on all are alike, and 0 or 1 is all there is.
        const double best = level < 2 ? 0.125 : std::max(wanted, 1.0 - wanted);
        EXPECT_LE(std::abs(alpha_coverage(kept[level], kCutoff) - wanted), best) << "level " << level;
        worst_plain = std::max(worst_plain, std::abs(alpha_coverage(plain[level], kCutoff) - wanted));
    }
    EXPECT_GT(worst_plain, 0.12) << "without scaling the share drifts, else this test could not fail";
}

double degrees_between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    double dot = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        dot += a[c] * b[c];
        aa += a[c] * a[c];
        bb += b[c] * b[c];
    }
    return std::acos(std::min(dot / std::sqrt(aa * bb), 1.0)) * 57.29578;
}

TEST(TextureStorage, PackingKeepsNormalsAndFactors) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit;
    // Up to 60 degrees off the surface, as steep as normal maps go.
    const Image normals = image_of(64, 64, [&](int, int) {
        const double tilt = unit(random) * 1.0472, turn = unit(random) * 6.2832;
        const auto code = [](double v) { return static_cast<int>(std::lround((v * 0.5 + 0.5) * 255.0)); };
        return std::array{code(std::sin(tilt) * std::cos(turn)), code(std::sin(tilt) * std::sin(turn)),
                          code(std::cos(tilt)), 255};
    });
    const Image factors = image_of(64, 64, [](int x, int y) { return std::array{7, 4 * x, 4 * y, 255}; });
    const Image packed = packed_surface_map(normals, factors);
    double worst = 0.0;
    for (std::size_t i = 0; i < packed.rgba.size(); i += 4) {
        EXPECT_EQ(packed.rgba[i + 2], factors.rgba[i + 2]);
        EXPECT_EQ(packed.rgba[i + 3], factors.rgba[i + 1]);
        std::array<double, 3> exact{}, back{};
        for (std::size_t c = 0; c < 3; ++c) exact[c] = normals.rgba[i + c] / 127.5 - 1.0;
        for (std::size_t c = 0; c < 2; ++c) back[c] = packed.rgba[i + c] / 127.5 - 1.0;
        back[2] = std::sqrt(std::max(1.0 - back[0] * back[0] - back[1] * back[1], 0.0));
        worst = std::max(worst, degrees_between(exact, back));
    }
    // Half a step of 1/255 in x and in y is 0.32 degrees along the surface; at 60 degrees the missing z doubles it.
    EXPECT_LE(worst, 0.65);
    EXPECT_GT(worst, 0.2);
}

TEST(TextureStorage, LevelsOfPackedNormalsPointTheMeanWay) {
    // Two slopes that face each other: their mean stands upright, not short.
    const Image packed = image_of(2, 1, [](int x, int) { return std::array{x == 0 ? 217 : 38, 128, 0, 64}; });
    const auto levels = mip_chain(packed, TexelKind::packed_surface, std::nullopt);
    EXPECT_EQ(levels[1].rgba[0], 128);
    EXPECT_EQ(levels[1].rgba[1], 128);
    EXPECT_EQ(levels[1].rgba[3], 64);
    // One slope and one flat texel: half way between by angle, 22.2 of 44.5 degrees, where a mean of x alone says 20.5.
    const Image half = image_of(2, 1, [](int x, int) { return std::array{x == 0 ? 217 : 128, 128, 0, 0}; });
    const double x = mip_chain(half, TexelKind::packed_surface, std::nullopt)[1].rgba[0] / 127.5 - 1.0;
    EXPECT_NEAR(std::asin(x) * 57.29578, 22.2, 0.5);  // 0.5: a step of 1/127.5
}

TEST(TextureStorage, OcclusionComesWithTheColourUnchanged) {
    const Image color = image_of(16, 16, [](int x, int y) { return std::array{16 * x, 16 * y, x * y, 77}; });
    const Image occlusion = image_of(16, 16, [](int x, int y) { return std::array{255 - x * y, 1, 2, 3}; });
    const Image packed = color_with_occlusion(color, occlusion);
    // Of one size, both are what they were: a step of 1/255 is all that the storage costs.
    for (std::size_t i = 0; i < packed.rgba.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(packed.rgba[i + c], color.rgba[i + c]);
        EXPECT_EQ(packed.rgba[i + 3], occlusion.rgba[i]);
    }
    // A smaller map of occlusion is filtered as the device would: a quarter of the way from 0 to 200.
    const Image small = image_of(8, 8, [](int x, int) { return std::array{x % 2 == 0 ? 0 : 200, 0, 0, 255}; });
    EXPECT_EQ(color_with_occlusion(color, small).rgba[4 * 1 + 3], 50);
    // A smaller colour is filtered in light: a quarter of the way from black to white is a quarter of the light.
    const Image edge = image_of(2, 2, [](int x, int) { return std::array{255 * x, 255 * x, 255 * x, 255}; });
    const Image large = image_of(4, 4, [](int, int) { return std::array{9, 0, 0, 255}; });
    EXPECT_EQ(color_with_occlusion(edge, large).rgba[4 * 1], 137) << "the code of a light of 0.25";
}

using Code = std::array<int, 4>;

/// Half of `on`, half of `other`.
Image lamps(const Code& on, const Code& other) {
    return image_of(8, 8, [&](int x, int) { return x % 2 == 0 ? other : on; });
}

TEST(TextureStorage, OneColourOnOrOffIsAMask) {
    const Code lamp{230, 102, 26, 255}, off{0, 0, 0, 255};
    const auto mask = emission_mask(lamps(lamp, off));
    ASSERT_TRUE(mask.has_value());
    EXPECT_NEAR(mask->r, 0.7913, 1e-4) << "the light of code 230";
    EXPECT_NEAR(mask->g, 0.1329, 1e-4);
    EXPECT_NEAR(mask->b, 0.0103, 1e-4);
    EXPECT_EQ(emission_mask(lamps(off, lamp)), mask) << "whichever comes first";
    EXPECT_EQ(emission_mask(lamps(lamp, {0, 0, 0, 9})), mask) << "an emission has no alpha";
    EXPECT_EQ(emission_mask(lamps(off, off)), glm::vec3(0.0f));
    // Of one hue: 169, 74 and 18 are the codes of half that light, 169 too at half a step of alpha.
    EXPECT_EQ(emission_mask(lamps(lamp, {169, 74, 18, 255})), mask);
}

TEST(TextureStorage, WhatErrsByThreeCodesIsNoMask) {
    const Code white{255, 255, 255, 255};
    EXPECT_FALSE(emission_mask(lamps({230, 0, 0, 255}, {0, 230, 0, 255})));
    EXPECT_FALSE(emission_mask(lamps({230, 102, 26, 255}, {169, 77, 18, 255}))) << "green is 3 codes off";
    EXPECT_TRUE(emission_mask(lamps({230, 102, 26, 255}, {169, 75, 18, 255})));
    // The first step of alpha has the light of code 13: codes 3 to 10 are farther than 2 from it and from black.
    for (int code = 0; code <= 11; ++code) {
        const bool is_mask = emission_mask(lamps(white, {code, code, code, 255})).has_value();
        EXPECT_EQ(is_mask, code <= 2 || code == 11) << code;
    }
    // A gradient into the dark stays what it is; one of bright codes is held by steps of alpha.
    EXPECT_FALSE(emission_mask(image_of(256, 1, [](int x, int) { return std::array{x, x, x, 255}; })));
    EXPECT_TRUE(emission_mask(image_of(256, 1, [](int x, int) { return std::array{std::max(x, 80), 0, 0, 255}; })));
}

TEST(TextureStorage, AMaskedEmissionComesWithTheColourUnchanged) {
    const Image color = image_of(8, 8, [](int x, int y) { return std::array{32 * x, 32 * y, x * y, 77}; });
    const Image emission = lamps({230, 102, 26, 255}, {169, 74, 18, 255});
    const Image packed = color_with_emission(color, emission, *emission_mask(emission));
    for (std::size_t i = 0; i < packed.rgba.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(packed.rgba[i + c], color.rgba[i + c]);
        EXPECT_EQ(packed.rgba[i + 3], i % 8 == 0 ? 128 : 255) << "the code of half the light, at the share of half";
    }
    // Of another size it is filtered in light: a quarter of the way from off to on is a quarter of the light.
    const Image edge = image_of(2, 2, [](int x, int) { return std::array{230 * x, 102 * x, 26 * x, 255}; });
    const Image large = image_of(4, 4, [](int, int) { return std::array{9, 0, 0, 255}; });
    EXPECT_EQ(color_with_emission(large, edge, *emission_mask(edge)).rgba[4 * 1 + 3], 64);
    EXPECT_EQ(color_with_emission(edge, emission, *emission_mask(emission)).width, 8);
    const Image dark = lamps({0, 0, 0, 255}, {0, 0, 0, 255});
    EXPECT_EQ(color_with_emission(color, dark, glm::vec3(0.0f)).rgba[3], 0) << "nothing is a share of black";
}

TEST(TextureStorage, DxtKeepsWhatIsOnOrOff) {
    std::mt19937 random(5);
    const auto noise = [&](int, int) {
        const auto next = [&] { return static_cast<int>(random() % 256); };
        return std::array{next(), next(), next(), next()};
    };
    Image image = image_of(64, 64, noise);
    const auto worst_alpha = [&] {
        const Image back = decompressed(compressed(image, true));
        int worst = 0;
        for (std::size_t i = 3; i < image.rgba.size(); i += 4)
            worst = std::max(worst, std::abs(back.rgba[i] - image.rgba[i]));
        return worst;
    };
    // Eight shares lie between the least and the largest of a block: half of a seventh, and a rounding.
    EXPECT_LE(worst_alpha(), 255 / 14 + 1);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = image.rgba[i] < 128 ? 0 : 255;
    EXPECT_EQ(worst_alpha(), 0);
}

TEST(TextureStorage, AMapOfAnotherSizeIsFiltered) {
    const Image normals = image_of(4, 4, [](int, int) { return std::array{128, 128, 255, 255}; });
    const Image factors = image_of(2, 2, [](int x, int) { return std::array{0, 100 * x, 50, 255}; });
    const Image packed = packed_surface_map(normals, factors);
    EXPECT_EQ(packed.width, 4);
    EXPECT_EQ(packed.rgba[4 * 1 + 3], 25) << "a quarter of the way from 0 to 100";
    EXPECT_EQ(packed.rgba[2], 50);
}

TEST(TextureStorage, DxtComesBack) {
    const Image ramp = image_of(18, 9, [](int x, int y) { return std::array{10 * x, 20 * y, 128, 255}; });
    const Image back = decompressed(compressed(ramp, false));
    EXPECT_EQ(back.width, 18);
    const TexelError error = texel_error(ramp, back);
    // Four colours on a line of 5:6:5 stand for 16 on a plane: half of the span of a block is the worst.
    EXPECT_LT(error.worst_codes, 30.0);
    EXPECT_LT(error.rms_codes, 10.0);
    EXPECT_GT(error.rms_codes, 0.5);
    const Image flat = image_of(4, 4, [](int, int) { return std::array{255, 0, 132, 255}; });
    EXPECT_LE(texel_error(flat, decompressed(compressed(flat, false))).worst_codes, 1.0);
}

TEST(TextureStorage, DxtKeepsAlphaWhenAsked) {
    const Image image = leaves();
    ASSERT_TRUE(has_alpha(image));
    const Image back = decompressed(compressed(image, true));
    int worst = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        worst = std::max(worst, std::abs(back.rgba[i] - image.rgba[i]));
    EXPECT_LE(worst, 19) << "half of a seventh of 255";
}

TEST(TextureStorage, GreyNeedsOneChannel) {
    const Image grey = image_of(2, 2, [](int x, int) { return std::array{9 * x, 9 * x, 9 * x, 255}; });
    EXPECT_EQ(channels_needed(grey), 1);
    const Image tinted = image_of(2, 2, [](int x, int) { return std::array{9 * x, 9 * x, 8, 255}; });
    EXPECT_EQ(channels_needed(tinted), 4);
}

TEST(TextureStorage, TheLargestImagesGiveFirst) {
    Scene scene;
    for (const int size : {1024, 256, 64}) scene.images.push_back({.name = "image", .width = size, .height = size});
    scene.images.push_back({.name = "unused", .width = 4096, .height = 4096});
    for (int i = 0; i < 3; ++i) {
        Material material;
        material.base_color_texture.image = i;
        scene.materials.push_back(material);
    }
    EXPECT_EQ(levels_to_drop(scene, 100u << 20), (std::vector<int>{0, 0, 0, 0}));
    EXPECT_EQ(levels_to_drop(scene, 2u << 20), (std::vector<int>{1, 0, 0, 0}));
    EXPECT_EQ(levels_to_drop(scene, 300u << 10), (std::vector<int>{3, 1, 0, 0}));
    EXPECT_EQ(levels_to_drop(scene, 0), (std::vector<int>{10, 8, 6, 0})) << "one texel stays";
}

}  // namespace
}  // namespace halfframe
