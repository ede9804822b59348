// Windows by day's end, shop windows, wrought iron and a far skyline.
#include <cmath>

#include "content/street/textures.h"

namespace halfframe::content::street {

namespace {

/// Distance of a point from a segment.
float from_segment(const glm::vec2& at, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 along = b - a;
    const float t = std::clamp(glm::dot(at - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    const glm::vec2 away = at - (a + t * along);
    return std::sqrt(glm::dot(away, away));
}

/// What is seen through a window of `kind` at (u, v), v downwards: emission in sRGB codes.
glm::vec3 room_light(int kind, float u, float v, std::uint32_t seed) {
    const auto glow = static_cast<Glow>(kind / kWindowsOfAGlow);
    const int variant = kind % kWindowsOfAGlow;
    if (glow == Glow::dark) {
        // A glimmer of a screen somewhere behind two of them.
        const float screen =
            variant == 1 ? 1.0f - smooth_step(0.0f, 0.45f, std::abs(u - 0.35f) + std::abs(v - 0.7f)) : 0.0f;
        return glm::vec3(20.0f, 34.0f, 54.0f) * screen;
    }
    const glm::vec3 tint = glow == Glow::warm    ? glm::vec3(255.0f, 214.0f, 160.0f)
                           : glow == Glow::amber ? glm::vec3(255.0f, 176.0f, 104.0f)
                                                 : glm::vec3(178.0f, 218.0f, 255.0f);
    // Brightest round the lamp, darker into the corners.
    const float lamp_x = 0.3f + 0.4f * hash_noise(kind, 5, seed);
    const float away = (u - lamp_x) * (u - lamp_x) + (v - 0.25f) * (v - 0.25f);
    float light = 0.42f + 0.58f / (1.0f + 7.0f * away);
    const float folds = 0.5f + 0.5f * smooth_noise(u * 24.0f, 0.0f, 24, seed + static_cast<std::uint32_t>(kind));
    const float side = std::abs(u - 0.5f);
    if (variant == 0) light *= side > 0.24f ? 0.30f + 0.45f * folds : 1.0f;  // curtains aside
    if (variant == 1) light *= 0.45f + 0.45f * folds;                        // curtains drawn
    if (variant == 2)
        light *= v < 0.55f ? (std::fmod(v * 44.0f, 2.0f) < 1.2f ? 0.30f : 0.9f) : 1.0f;  // blinds half down
    if (variant == 3) {
        // Somebody stands there; a shelf behind.
        const float head = glm::length(glm::vec2(u - 0.62f, v - 0.42f));
        const bool body = head < 0.07f || (std::abs(u - 0.62f) < 0.12f - 0.10f * std::max(0.55f - v, 0.0f) && v > 0.5f);
        light *= body ? 0.10f : (u < 0.35f && std::fmod(v * 7.0f, 1.0f) < 0.12f ? 0.35f : 1.0f);
    }
    return tint * light;
}

}  // namespace

TextureSet window_textures(std::uint32_t seed) {
    constexpr int kSize = 512;
    constexpr int kCell = kSize / kWindowColumns;
    return texture_set(
        "windows", kSize, 1.0f,
        [seed](int x, int y) {
            const int kind = (y / kCell) * kWindowColumns + x / kCell;
            const float u = (static_cast<float>(x % kCell) + 0.5f) / kCell;
            const float v = (static_cast<float>(y % kCell) + 0.5f) / kCell;
            // Two leaves of four panes: a frame round all, a post between, three bars across.
            const float border = std::min({u, 1.0f - u, v, 1.0f - v});
            const float post = std::abs(u - 0.5f);
            const float bar = std::min({std::abs(v - 0.26f), std::abs(v - 0.52f), std::abs(v - 0.77f)});
            const bool frame = border < 0.055f || post < 0.035f || bar < 0.016f;
            const float grime = layered_noise(u, v, 5, 4, seed + static_cast<std::uint32_t>(kind));
            Texel texel;
            if (frame) {
                texel.srgb = glm::vec3(92.0f, 96.0f, 100.0f) * (0.8f + 0.3f * grime);
                texel.height_m = 0.004f;
                texel.roughness = 0.6f;
                return texel;
            }
            texel.srgb = glm::vec3(34.0f, 37.0f, 42.0f) * (1.0f + 0.2f * grime);
            texel.roughness = 0.10f + 0.14f * grime;
            texel.emissive = room_light(kind, u, v, seed) * (0.88f + 0.12f * grime);
            return texel;
        },
        true);
}

Image shop_picture(std::uint32_t seed) {
    constexpr int kSize = 512;
    constexpr int kWide = kSize / kShopColumns;
    constexpr int kHigh = kSize / (kShopKinds / kShopColumns);
    Image image = blank("shop windows", kSize, kSize, true);
    constexpr std::array<glm::vec3, kShopKinds> kLights{{{255, 222, 178},
                                                         {206, 226, 255},
                                                         {255, 200, 148},
                                                         {188, 216, 255},
                                                         {255, 232, 206},
                                                         {226, 200, 255},
                                                         {255, 184, 170},
                                                         {180, 246, 255}}};
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const int kind = (y / kHigh) * kShopColumns + x / kWide;
            const float u = (static_cast<float>(x % kWide) + 0.5f) / kWide;
            const float v = (static_cast<float>(y % kHigh) + 0.5f) / kHigh;
            // Shelves at the back, wares on them, a counter and lamps before: darker between, so that they read.
            const int shelves = 4 + kind % 3;
            const float down = v * static_cast<float>(shelves);
            const int shelf = static_cast<int>(down);
            const float inside = down - static_cast<float>(shelf);
            const int goods = 14 + 5 * ((kind + shelf) % 4);
            const int good = static_cast<int>(u * static_cast<float>(goods));
            const float tall = 0.20f + 0.62f * hash_noise(good, shelf + 7 * kind, seed);
            const float across = std::abs(u * static_cast<float>(goods) - static_cast<float>(good) - 0.5f);
            const float wide = 0.22f + 0.25f * hash_noise(good, shelf + 7 * kind, seed + 1u);
            const float lamp = std::abs(std::fmod(u * 4.0f + 0.5f, 1.0f) - 0.5f);
            const float pool = 1.0f / (1.0f + 14.0f * lamp * lamp + 2.2f * v * v);
            const float wall = 0.24f + 0.30f * (1.0f - inside) * (1.0f - inside) + 0.50f * pool;
            glm::vec3 light = kLights[static_cast<std::size_t>(kind)] * wall;
            if (inside > 0.92f) {
                light *= 0.30f;
            } else if (inside > 1.0f - tall && across < wide && hash_noise(good, shelf + 7 * kind, seed + 3u) > 0.12f) {
                const float hue = hash_noise(good, shelf + 7 * kind, seed + 2u);
                const glm::vec3 ware = hue < 0.28f   ? glm::vec3(0.34f, 0.42f, 0.62f)
                                       : hue < 0.42f ? glm::vec3(0.70f, 0.26f, 0.22f)
                                       : hue < 0.56f ? glm::vec3(0.52f, 0.36f, 0.66f)
                                       : hue < 0.78f ? glm::vec3(0.60f, 0.56f, 0.50f)
                                                     : glm::vec3(0.24f, 0.25f, 0.28f);
                light *= ware * (0.75f + 0.4f * (1.0f - across / wide));
            }
            // Lamps over the wares: the brightest that is seen.
            if (v > 0.02f && v < 0.07f && lamp < 0.09f) light = kLights[static_cast<std::size_t>(kind)];
            // Somebody at the counter.
            const float person = 0.25f + 0.5f * hash_noise(kind, 31, seed);
            const float head = glm::length(glm::vec2(1.2f * (u - person), v - 0.43f));
            if (kind % 3 != 2 &&
                (head < 0.058f || (std::abs(u - person) < 0.05f + 0.12f * std::min(v - 0.49f, 0.35f) && v > 0.49f)))
                light *= 0.16f;
            if (v > 0.80f) light *= v < 0.83f ? 0.8f : 0.22f + 0.1f * inside;
            // Posts of the window itself, and its frame.
            const float post = std::abs(std::fmod(u * 3.0f, 1.0f) - 0.5f);
            const float border = std::min({u, 1.0f - u, 0.5f * v, 0.5f * (1.0f - v)});
            if (post > 0.487f || border < 0.012f) light *= 0.06f;
            set_texel(image, x, y, light);
        }
    }
    return image;
}

Image railing_picture() {
    constexpr int kSize = 256;
    Image image = blank("railing", kSize, kSize, true);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const glm::vec2 at((static_cast<float>(x) + 0.5f) / kSize, (static_cast<float>(y) + 0.5f) / kSize);
            // Four equal panels: bars, a rail above and below, and a lozenge with a ring in each second one.
            const float panel = std::fmod(at.x * 4.0f, 1.0f);
            float nearest =
                std::min({std::abs(at.y - 0.03f) - 0.016f, std::abs(at.y - 0.20f), std::abs(at.y - 0.95f) - 0.006f});
            nearest = std::min(nearest, 0.25f * std::min(panel, 1.0f - panel));
            const glm::vec2 here(0.25f * panel, at.y);
            if (static_cast<int>(at.x * 4.0f) % 2 == 0) {
                const std::array<glm::vec2, 4> lozenge{
                    {{0.125f, 0.22f}, {0.235f, 0.575f}, {0.125f, 0.93f}, {0.015f, 0.575f}}};
                for (std::size_t i = 0; i < 4; ++i)
                    nearest = std::min(nearest, from_segment(here, lozenge[i], lozenge[(i + 1) % 4]));
                nearest = std::min(nearest, std::abs(glm::length(here - glm::vec2(0.125f, 0.575f)) - 0.055f));
            } else {
                nearest = std::min(
                    {nearest, std::abs(here.x - 0.0625f), std::abs(here.x - 0.125f), std::abs(here.x - 0.1875f)});
            }
            const float alpha = 1.0f - smooth_step(0.009f, 0.017f, nearest);
            set_texel(image, x, y, {46.0f, 49.0f, 54.0f}, alpha);
        }
    }
    return image;
}

Image skyline_picture(std::uint32_t seed) {
    constexpr int kSize = 256;
    constexpr int kCell = 8;
    Image image = blank("skyline", kSize, kSize, true);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const int column = x / kCell;
            const int row = y / kCell;
            const float lit = hash_noise(column, row, seed) * (0.6f + 0.8f * hash_noise(row, 77, seed));
            const bool glass = x % kCell > 0 && x % kCell < 7 && y % kCell > 2 && y % kCell < 6;
            const glm::vec3 tint = hash_noise(column, row, seed + 1u) < 0.55f ? glm::vec3(150.0f, 190.0f, 235.0f)
                                                                              : glm::vec3(245.0f, 204.0f, 150.0f);
            const float level = lit > 0.86f ? 0.95f : lit > 0.70f ? 0.42f : 0.05f;
            set_texel(image, x, y, glass ? tint * level : glm::vec3(6.0f, 8.0f, 12.0f));
        }
    }
    return image;
}

}  // namespace halfframe::content::street
