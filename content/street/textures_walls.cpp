// Ashlar, brick, render, panels, boards and zinc.
#include <cmath>

#include "content/street/textures.h"

namespace halfframe::content::street {

namespace {

/// Distance of `at` from the nearest end of its piece, for pieces of `length`.
float from_edge(float at, float length) {
    const float inside = at - length * std::floor(at / length);
    return std::min(inside, length - inside);
}

/// Pieces in rows, every other row moved by half a piece.
struct Masonry {
    float tone;    ///< 0..1, one a piece
    float edge_m;  ///< from the nearest edge of the piece
};

/// `pieces` in a row before it repeats.
Masonry masonry_at(const glm::vec2& at_m, const glm::vec2& piece_m, int pieces, std::uint32_t seed) {
    const int row = static_cast<int>(at_m.y / piece_m.y);
    const float along_m = at_m.x + (row % 2 == 0 ? 0.0f : 0.5f * piece_m.x);
    const int piece = static_cast<int>(along_m / piece_m.x) % pieces;
    return {hash_noise(piece, row, seed), std::min(from_edge(at_m.y, piece_m.y), from_edge(along_m, piece_m.x))};
}

/// Rain's dark trails: noise drawn out downwards. 0 clean, 1 dirty.
float trails(float u, float v, std::uint32_t seed) {
    const float thin = smooth_noise(u * 64.0f, v * 4.0f, 64, seed);
    const float broad = smooth_noise(u * 16.0f, v * 2.0f, 16, seed + 1u);
    return smooth_step(0.45f, 0.95f, 0.5f * thin + 0.5f * broad);
}

}  // namespace

TextureSet stone_texture(std::uint32_t seed) {
    constexpr int kSize = 512;
    return texture_set("stone", kSize, kStoneSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const auto [tone, edge_m] = masonry_at(glm::vec2(u, v) * kStoneSide_m, {1.0f, 0.5f}, 4, seed);
        const float grain = layered_noise(u, v, 32, 4, seed + 2u);
        const float patch = layered_noise(u, v, 4, 3, seed + 3u);
        const float face = smooth_step(0.004f, 0.020f, edge_m);
        const float dirt = 0.6f * trails(u, v, seed + 4u) + 0.4f * (1.0f - face);
        const float value = 128.0f + 26.0f * (tone - 0.5f) + 34.0f * (grain - 0.5f) + 34.0f * (patch - 0.5f);
        Texel texel;
        texel.srgb = glm::vec3(1.02f, 1.0f, 0.965f) * value * (1.0f - 0.38f * dirt);
        texel.height_m = 0.010f * face + 0.004f * grain + 0.003f * tone;
        texel.roughness = 0.82f - 0.16f * dirt + 0.14f * (grain - 0.5f);
        return texel;
    });
}

TextureSet brick_texture(std::uint32_t seed) {
    constexpr int kSize = 256;
    return texture_set("brick", kSize, kBrickSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const auto [tone, edge_m] = masonry_at(glm::vec2(u, v) * kBrickSide_m, {0.25f, 0.0625f}, 8, seed);
        const float grain = layered_noise(u, v, 32, 3, seed + 2u);
        const float soot = layered_noise(u, v, 3, 4, seed + 3u);
        const float face = smooth_step(0.003f, 0.010f, edge_m);
        const glm::vec3 burnt = glm::mix(glm::vec3(88.0f, 66.0f, 62.0f), glm::vec3(124.0f, 88.0f, 78.0f), tone);
        const glm::vec3 mortar(104.0f, 104.0f, 106.0f);
        Texel texel;
        texel.srgb =
            glm::mix(mortar, burnt, face) * (0.72f + 0.5f * grain) * (1.0f - 0.35f * smooth_step(0.4f, 0.8f, soot));
        texel.height_m = 0.006f * face + 0.003f * tone * face + 0.002f * grain;
        texel.roughness = 0.85f - 0.2f * face * tone;
        return texel;
    });
}

TextureSet plaster_texture(std::uint32_t seed) {
    constexpr int kSize = 512;
    return texture_set("plaster", kSize, kPlasterSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const float patch = layered_noise(u, v, 3, 5, seed);
        const float grain = layered_noise(u, v, 64, 3, seed + 1u);
        const float dirt = trails(u, v, seed + 2u);
        // Where the render has come off, grey and lower: the inside of a level line of the noise.
        const float off = smooth_step(0.63f, 0.66f, layered_noise(u, v, 5, 5, seed + 3u));
        const float crack = 1.0f - smooth_step(0.0f, 0.012f, std::abs(layered_noise(u, v, 4, 5, seed + 4u) - 0.5f));
        const glm::vec3 paint = glm::vec3(122.0f, 128.0f, 136.0f) + glm::vec3(46.0f * (patch - 0.5f));
        Texel texel;
        texel.srgb = glm::mix(paint, glm::vec3(92.0f, 88.0f, 84.0f), off) * (1.0f - 0.42f * dirt) *
                     (1.0f - 0.3f * crack) * (0.9f + 0.2f * grain);
        texel.height_m = 0.012f * (1.0f - off) - 0.004f * crack + 0.003f * grain + 0.008f * patch;
        texel.roughness = 0.78f + 0.12f * off - 0.2f * dirt;
        return texel;
    });
}

TextureSet panel_texture(std::uint32_t seed) {
    constexpr int kSize = 256;
    return texture_set("panels", kSize, kPanelSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const float x_m = u * kPanelSide_m;
        const float y_m = v * kPanelSide_m;
        const float seam = std::min(from_edge(x_m, 1.0f), from_edge(y_m, 0.5f));
        const float face = smooth_step(0.004f, 0.014f, seam);
        const float rivet_x = from_edge(x_m + 0.06f, 0.25f) - 0.06f;
        const float rivet_y = from_edge(y_m, 0.5f) - 0.05f;
        const float rivet = 1.0f - smooth_step(0.008f, 0.016f, std::sqrt(rivet_x * rivet_x + rivet_y * rivet_y));
        const float wear = smooth_step(0.55f, 0.75f, layered_noise(u, v, 4, 5, seed));
        const float tone = hash_noise(static_cast<int>(x_m), static_cast<int>(y_m * 2.0f), seed + 1u);
        Texel texel;
        texel.srgb = glm::mix(glm::vec3(66.0f, 73.0f, 82.0f), glm::vec3(84.0f, 74.0f, 66.0f), wear) *
                     (0.86f + 0.28f * tone) * (0.6f + 0.4f * face);
        texel.height_m = 0.006f * face + 0.004f * rivet;
        texel.roughness = 0.38f + 0.35f * wear + 0.1f * tone;
        return texel;
    });
}

TextureSet wood_texture(std::uint32_t seed) {
    constexpr int kSize = 256;
    constexpr float kBoard_m = 0.125f;
    return texture_set("boards", kSize, kWoodSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const float y_m = v * kWoodSide_m;
        const int board = static_cast<int>(y_m / kBoard_m);
        const float tone = hash_noise(board, 3, seed);
        const float along = smooth_noise(u * 8.0f, v * 128.0f, 128, seed + static_cast<std::uint32_t>(board));
        const float fine = smooth_noise(u * 32.0f, v * 128.0f, 128, seed + 99u);
        const float face = smooth_step(0.003f, 0.012f, from_edge(y_m, kBoard_m));
        Texel texel;
        texel.srgb = glm::mix(glm::vec3(74.0f, 62.0f, 54.0f), glm::vec3(112.0f, 92.0f, 76.0f),
                              0.5f * along + 0.3f * tone + 0.2f * fine) *
                     (0.55f + 0.45f * face);
        texel.height_m = 0.006f * face + 0.002f * along;
        texel.roughness = 0.62f + 0.2f * along;
        return texel;
    });
}

TextureSet zinc_texture(std::uint32_t seed) {
    constexpr int kSize = 256;
    return texture_set("zinc", kSize, kZincSide_m, [seed](int x, int y) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        const float v = (static_cast<float>(y) + 0.5f) / kSize;
        const float seam = 1.0f - smooth_step(0.010f, 0.022f, from_edge(u * kZincSide_m, 0.5f));
        const float patina = layered_noise(u, v, 4, 5, seed);
        const float tone = hash_noise(static_cast<int>(u * 4.0f), static_cast<int>(v * 2.0f), seed + 1u);
        Texel texel;
        // Weathered zinc is a carbonate, a dielectric: blue-grey albedo, no metal.
        texel.srgb = glm::vec3(92.0f, 100.0f, 112.0f) * (0.72f + 0.4f * patina + 0.16f * tone);
        texel.height_m = 0.022f * seam + 0.003f * patina;
        texel.roughness = 0.42f + 0.3f * patina;
        return texel;
    });
}

}  // namespace halfframe::content::street
