// Noise that repeats, and pictures made of it. Sums, products, divisions and square roots only: the same bits
// everywhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "content/random.h"
#include "engine/frame/scene.h"

namespace halfframe::content {

/// 0..1, smooth, one knot a unit; repeats after `period` units in x and y.
[[nodiscard]] float smooth_noise(float x, float y, int period, std::uint32_t seed);
/// 0..1: `octaves` of smooth_noise, each of twice the frequency and half the height; `u` and `v` run 0..1 over the
/// picture, which has `cells` knots of the first octave.
[[nodiscard]] float layered_noise(float u, float v, int cells, int octaves, std::uint32_t seed);
/// 0..1, one value a place, and one a place and seed.
[[nodiscard]] inline float hash_noise(int x, int y) {
    return static_cast<float>(mixed(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) >> 8u) *
           (1.0f / 16777215.0f);
}
[[nodiscard]] inline float hash_noise(int x, int y, std::uint32_t seed) {
    return static_cast<float>(mixed(mixed(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), seed) >> 8u) *
           (1.0f / 16777215.0f);
}
[[nodiscard]] inline float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// What a surface is at a texel.
struct Texel {
    glm::vec3 srgb{128.0f};    ///< codes 0..255; albedo of a dielectric is kept within the talk's 32..243
    float height_m = 0.0f;     ///< over the plane
    float roughness = 0.8f;    ///< 0..1
    float metallic = 0.0f;     ///< 0 or 1
    glm::vec3 emissive{0.0f};  ///< sRGB codes
    float alpha = 1.0f;
};

/// One picture for each texture slot.
struct TextureSet {
    Image base_color;
    Image normal;
    Image metallic_roughness;
    Image emissive;
};

[[nodiscard]] Image blank(const std::string& name, int width, int height, bool srgb);
void set_texel(Image& image, int x, int y, const glm::vec3& codes, float alpha = 1.0f);

/// Pictures of `size` texels a side of what `texel(x, y)` says; normals from its heights, which repeat, over a picture
/// `side_m` wide. `emissive` stays empty unless `glows`.
template <typename Function>
TextureSet texture_set(const std::string& name, int size, float side_m, Function&& texel, bool glows = false) {
    TextureSet set{blank(name + " base color", size, size, true),
                   blank(name + " normal", size, size, false),
                   blank(name + " metallic roughness", size, size, false),
                   {}};
    if (glows) set.emissive = blank(name + " emissive", size, size, true);
    std::vector<float> heights(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Texel each = texel(x, y);
            heights[static_cast<std::size_t>(y * size + x)] = each.height_m;
            const bool dielectric = each.metallic < 0.5f;
            set_texel(set.base_color, x, y,
                      dielectric ? glm::clamp(each.srgb, glm::vec3(32.0f), glm::vec3(243.0f))
                                 : glm::clamp(each.srgb, glm::vec3(186.0f), glm::vec3(255.0f)),
                      each.alpha);
            set_texel(set.metallic_roughness, x, y, {255.0f, 255.0f * each.roughness, dielectric ? 0.0f : 255.0f});
            if (glows) set_texel(set.emissive, x, y, each.emissive);
        }
    }
    const auto height = [&](int x, int y) {
        return heights[static_cast<std::size_t>(((y + size) % size) * size + (x + size) % size)];
    };
    const float per_m = static_cast<float>(size) / (2.0f * side_m);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float slope_x = (height(x - 1, y) - height(x + 1, y)) * per_m;
            const float slope_y = (height(x, y + 1) - height(x, y - 1)) * per_m;  // +Y is up, rows count downwards
            const float length = std::sqrt(slope_x * slope_x + slope_y * slope_y + 1.0f);
            set_texel(set.normal, x, y,
                      glm::vec3(127.5f) + 127.5f * glm::vec3(slope_x / length, slope_y / length, 1.0f / length));
        }
    }
    return set;
}

}  // namespace halfframe::content
