// Large textures, whose codes are remembered, against small ones, whose are not.
#include "perf/check/texels.h"

#include <random>

#include <gtest/gtest.h>

namespace halfframe::check {
namespace {

constexpr int kLarge = 288, kSmall = 32;  // 82944 texels are above the 65536 from which codes are remembered

Image noise(int side, std::uint32_t seed, bool srgb) {
    Image image{.name = "noise", .width = side, .height = side, .srgb = srgb, .rgba = {}};
    image.rgba.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
    std::mt19937 random(seed);
    for (std::uint8_t& byte : image.rgba) byte = static_cast<std::uint8_t>(random());
    return image;
}

Image cut(const Image& image, int x0, int y0) {
    Image part{.name = "part", .width = kSmall, .height = kSmall, .srgb = image.srgb, .rgba = {}};
    for (int y = y0; y < y0 + kSmall; ++y) {
        const auto row = image.rgba.begin() + 4 * (y * image.width + x0);
        part.rgba.insert(part.rgba.end(), row, row + 4 * kSmall);
    }
    return part;
}

void expect_same(const Texel& a, const Texel& b) {
    EXPECT_EQ(a.albedo_code, b.albedo_code);
    EXPECT_EQ(a.specular_code, b.specular_code);
    EXPECT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.smoothness, b.smoothness);
    EXPECT_EQ(a.alpha, b.alpha);
    EXPECT_EQ(a.shines, b.shines);
    EXPECT_EQ(a.metal, b.metal);
    EXPECT_EQ(a.between, b.between);
}

/// Every texture of every model, each its own noise.
Material material_of(MaterialModel model) {
    Material material;
    material.model = model;
    material.base_color = {0.9f, 0.8f, 0.7f, 0.6f};
    material.emissive = glm::vec3(0.1f);
    material.base_color_texture.image = 0;
    material.metallic_roughness_texture.image = 1;
    material.specular_smoothness_texture.image = 2;
    material.emissive_texture.image = 3;
    material.specular_color_texture.image = 4;
    return material;
}

TEST(MaterialTexels, AreThoseOfEachPartOfTheTexture) {
    Scene whole;
    for (std::uint32_t i = 0; i < 5; ++i) whole.images.push_back(noise(kLarge, 20131107 + i, i != 1));
    const Thresholds thresholds;
    for (const MaterialModel model : {MaterialModel::metallic_roughness, MaterialModel::specular_glossiness}) {
        const Material material = material_of(model);
        const MaterialTexels texels(whole, material, thresholds);
        for (int y0 = 0; y0 < kLarge; y0 += kSmall) {
            for (int x0 = 0; x0 < kLarge; x0 += kSmall) {
                Scene part;
                for (const Image& image : whole.images) part.images.push_back(cut(image, x0, y0));
                const MaterialTexels alone(part, material, thresholds);
                for (int y = 0; y < kSmall; ++y) {
                    for (int x = 0; x < kSmall; ++x) expect_same(texels.at(x0 + x, y0 + y), alone.at(x, y));
                }
            }
        }
    }
}

}  // namespace
}  // namespace halfframe::check
