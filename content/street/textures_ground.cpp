// Asphalt, cobbles and paving, damp as after rain: smooth where they lie low.
#include <cmath>

#include "content/street/textures.h"

namespace halfframe::content::street {

TextureSet asphalt_texture(std::uint32_t seed) {
    constexpr int kSize = 512;
    return texture_set("asphalt", kSize, kAsphaltSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const float chips = hash_noise(x, y, seed);
        const float stones = smooth_noise(u * 128.0f, v * 128.0f, 128, seed + 1u);
        const float patch = layered_noise(u, v, 3, 5, seed + 2u);
        const float worn = layered_noise(u, v, 6, 3, seed + 3u);
        const float crack = 1.0f - smooth_step(0.0f, 0.010f, std::abs(layered_noise(u, v, 3, 6, seed + 4u) - 0.5f));
        const float damp = smooth_step(0.36f, 0.60f, patch);
        const float value = 80.0f + 30.0f * (stones - 0.5f) + 22.0f * (chips - 0.5f) + 18.0f * (worn - 0.5f);
        Texel texel;
        texel.srgb = glm::vec3(0.95f, 0.99f, 1.06f) * value * (1.0f - 0.28f * damp) * (1.0f - 0.35f * crack);
        texel.height_m = (0.0035f * stones + 0.001f * chips) * (1.0f - 0.65f * damp) - 0.004f * crack;
        texel.roughness = 0.64f - 0.48f * damp + 0.10f * (stones - 0.5f);
        return texel;
    });
}

TextureSet cobble_texture(std::uint32_t seed) {
    constexpr int kSize = 256;
    constexpr int kStones = 16;  // a side: setts of 12.5 cm
    return texture_set("cobbles", kSize, kCobbleSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const int row = static_cast<int>(v * kStones);
        const float shifted = u * kStones + (row % 2 == 0 ? 0.0f : 0.5f);
        const int column = static_cast<int>(shifted) % kStones;
        const float inside_x = shifted - std::floor(shifted) - 0.5f;
        const float inside_y = v * kStones - std::floor(v * kStones) - 0.5f;
        const float tone = hash_noise(column, row, seed);
        const float corner = std::max(std::abs(inside_x), std::abs(inside_y));
        const float round = std::sqrt(inside_x * inside_x + inside_y * inside_y);
        const float face = 1.0f - smooth_step(0.34f, 0.49f, 0.7f * corner + 0.3f * round);
        const float grain = layered_noise(u, v, 64, 2, seed + 1u);
        Texel texel;
        texel.srgb = glm::vec3(0.97f, 0.99f, 1.04f) * (84.0f + 30.0f * (tone - 0.5f) + 30.0f * (grain - 0.5f)) *
                     (0.52f + 0.48f * face);
        texel.height_m = 0.014f * face * (0.8f + 0.2f * tone) + 0.002f * grain;
        texel.roughness = 0.30f + 0.25f * grain + 0.30f * (1.0f - face);
        return texel;
    });
}

TextureSet paving_texture(std::uint32_t seed) {
    constexpr int kSize = 256;
    return texture_set("paving", kSize, kPavingSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const int row = static_cast<int>(v * 4.0f);
        const float along = u * 2.0f + (row % 2 == 0 ? 0.0f : 0.5f);
        const int slab = static_cast<int>(along) % 2;
        const float edge_x = std::min(along - std::floor(along), 1.0f - (along - std::floor(along)));
        const float down = v * 4.0f - std::floor(v * 4.0f);
        const float edge_m = std::min(edge_x, 0.5f * std::min(down, 1.0f - down));
        const float face = smooth_step(0.006f, 0.016f, edge_m);
        const float tone = hash_noise(slab, row, seed);
        const float grain = layered_noise(u, v, 32, 3, seed + 1u);
        const float stain = smooth_step(0.45f, 0.7f, layered_noise(u, v, 3, 4, seed + 2u));
        Texel texel;
        texel.srgb = glm::vec3(1.0f, 1.0f, 1.01f) * (96.0f + 20.0f * (tone - 0.5f) + 30.0f * (grain - 0.5f)) *
                     (1.0f - 0.25f * stain) * (0.6f + 0.4f * face);
        texel.height_m = 0.006f * face + 0.0015f * grain + 0.002f * tone;
        texel.roughness = 0.56f - 0.30f * stain + 0.2f * (grain - 0.5f);
        return texel;
    });
}

}  // namespace halfframe::content::street
