// Neon tubes by distance from the strokes of letters; holograms of lines.
#include "content/street/sign_textures.h"

#include <cmath>
#include <span>
#include <vector>

#include "content/noise.h"
#include "content/street/letters.h"

namespace halfframe::content::street {

namespace {

constexpr glm::vec3 kRed{1.0f, 0.13f, 0.10f};
constexpr glm::vec3 kBlue{0.12f, 0.48f, 1.0f};
constexpr glm::vec3 kCyan{0.22f, 0.86f, 1.0f};
constexpr glm::vec3 kPurple{0.66f, 0.22f, 1.0f};
constexpr glm::vec3 kWarm{1.0f, 0.74f, 0.42f};
constexpr glm::vec3 kWhite{0.86f, 0.93f, 1.0f};
constexpr glm::vec3 kGreen{0.16f, 1.0f, 0.55f};

/// A rectangle in the picture, and how the strokes lie in it.
struct Cell {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

float from_stroke(const glm::vec2& at, const Stroke& stroke) {
    const glm::vec2 along = stroke.to - stroke.from;
    const float t = std::clamp(glm::dot(at - stroke.from, along) / glm::dot(along, along), 0.0f, 1.0f);
    const glm::vec2 away = at - (stroke.from + t * along);
    return std::sqrt(glm::dot(away, away));
}

/// Strokes moved and scaled into the middle of a cell, in texels; returns the scale.
float fit(std::vector<Stroke>& strokes, const Cell& cell, float margin) {
    glm::vec2 low(1e9f);
    glm::vec2 high(-1e9f);
    for (const Stroke& stroke : strokes) {
        low = glm::min(low, glm::min(stroke.from, stroke.to));
        high = glm::max(high, glm::max(stroke.from, stroke.to));
    }
    const glm::vec2 room(static_cast<float>(cell.width) - 2.0f * margin,
                         static_cast<float>(cell.height) - 2.0f * margin);
    const glm::vec2 size = glm::max(high - low, glm::vec2(1.0f));
    const float scale = std::min(room.x / size.x, room.y / size.y);
    const glm::vec2 offset = 0.5f * glm::vec2(cell.width, cell.height) - 0.5f * scale * (low + high);
    for (Stroke& stroke : strokes) {
        stroke.from = stroke.from * scale + offset;
        stroke.to = stroke.to * scale + offset;
    }
    return scale;
}

/// sRGB codes of a linear colour, by the root of it: near enough for light, and the same bits everywhere.
glm::vec3 codes(const glm::vec3& linear) {
    return 255.0f * glm::vec3(std::sqrt(std::min(linear.r, 1.0f)), std::sqrt(std::min(linear.g, 1.0f)),
                              std::sqrt(std::min(linear.b, 1.0f)));
}

void draw_sign(Image& image, const Cell& cell, const SignText& sign, std::vector<Stroke> strokes) {
    const bool neon = sign.style == SignStyle::neon;
    const float scale = fit(strokes, cell, neon ? 11.0f : 9.0f);
    const float tube = std::clamp((neon ? 0.36f : 0.50f) * scale, 1.6f, neon ? 4.2f : 4.8f);
    for (int y = 0; y < cell.height; ++y) {
        for (int x = 0; x < cell.width; ++x) {
            const glm::vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            float nearest = 1e9f;
            for (const Stroke& stroke : strokes) nearest = std::min(nearest, from_stroke(at, stroke));
            const float border =
                std::min({at.x, at.y, static_cast<float>(cell.width) - at.x, static_cast<float>(cell.height) - at.y});
            glm::vec3 light;
            if (neon) {
                const float frame = std::abs(border - 4.0f);
                const float core = 1.0f - smooth_step(0.55f * tube, 1.25f * tube, nearest);
                const float halo = 0.24f / (1.0f + 0.08f * nearest * nearest);
                const float rim = 0.55f * (1.0f - smooth_step(0.6f, 1.6f, frame));
                // The middle of a tube is nearly white, whatever its gas.
                light = glm::mix(sign.tint, glm::vec3(1.0f), 0.55f * core) * core + sign.tint * (halo + rim);
            } else {
                const float letter = 1.0f - smooth_step(tube, tube + 1.5f, nearest);
                const float pane = smooth_step(1.0f, 3.0f, border);
                light = sign.tint * (0.04f + 0.52f * pane) * (1.0f - 0.93f * letter);
            }
            if (border < 1.0f) light = glm::vec3(0.0f);
            set_texel(image, cell.x + x, cell.y + y, codes(light));
        }
    }
}

/// The light of one of the floating pictures; its brightest channel is its alpha.
float hologram_line(int picture, const glm::vec2& at, std::span<const Stroke> text, std::uint32_t seed) {
    const glm::vec2 middle = at - glm::vec2(0.5f);
    const float round = glm::length(middle);
    float light = 0.0f;
    const auto line = [&](float distance, float width) {
        light = std::max(light, 1.0f - smooth_step(width, 2.5f * width, distance));
    };
    if (picture == 0) {  // a head and shoulders, drawn as contour lines
        const float head = glm::length(middle * glm::vec2(1.25f, 1.0f) - glm::vec2(0.0f, -0.14f));
        const float neck = std::max(std::abs(middle.x) - 0.07f, std::abs(middle.y - 0.12f) - 0.08f);
        const float shoulders = glm::length((middle - glm::vec2(0.0f, 0.48f)) * glm::vec2(0.8f, 1.0f));
        const float body = std::min({head - 0.21f, neck, shoulders - 0.30f});
        const float rows = std::fmod(at.y * 40.0f + 0.8f * layered_noise(at.x, at.y, 4, 3, seed), 1.0f);
        if (body < 0.0f) light = (rows < 0.5f ? 0.75f : 0.28f) * (0.55f + 0.45f * std::min(1.0f, -body * 12.0f));
        line(std::abs(body), 0.006f);
        const float eyes =
            std::min(glm::length(middle - glm::vec2(-0.075f, -0.15f)), glm::length(middle - glm::vec2(0.075f, -0.15f)));
        line(eyes, 0.012f);
    } else if (picture == 1) {  // rings
        line(std::abs(round - 0.44f), 0.006f);
        line(std::abs(round - 0.30f), 0.004f);
        if (round > 0.33f && round < 0.41f && std::fmod((middle.x + middle.y) * 23.0f + 50.0f, 1.0f) < 0.55f)
            light = 0.8f;
        line(std::abs(middle.x) + std::abs(middle.y) - 0.10f, 0.012f);
    } else if (picture == 2) {  // a framed word
        const float border = std::min({at.x, at.y, 1.0f - at.x, 1.0f - at.y});
        line(std::abs(border - 0.04f), 0.006f);
        if (at.y > 0.72f && at.y < 0.88f && at.x > 0.12f && at.x < 0.88f &&
            std::fmod(at.x * 30.0f, 1.0f) < 0.35f + 0.4f * hash_noise(static_cast<int>(at.x * 30.0f), 0, seed))
            light = 0.7f;
    } else {  // a map: streets and a place on them
        const float streets = std::min(std::abs(layered_noise(at.x, at.y, 3, 2, seed) - 0.5f),
                                       std::abs(layered_noise(at.x, at.y, 5, 2, seed + 9u) - 0.5f) * 1.6f);
        line(streets, 0.012f);
        line(std::abs(round - 0.08f), 0.012f);
        line(round, 0.02f);
    }
    for (const Stroke& stroke : text) line(from_stroke(at, stroke), 0.012f);
    return light;
}

}  // namespace

const std::array<SignText, kAcrossColumns * kAcrossRows> kSignsAcross{{
    {"CAFe 2084", SignStyle::neon, kWarm},
    {"SOUVENIRS", SignStyle::neon, kPurple},
    {"PHARMACIE", SignStyle::neon, kGreen},
    {"TABAC", SignStyle::box, kRed},
    {"OPTIQUE", SignStyle::box, kWhite},
    {"CINeMA", SignStyle::neon, kRed},
    {"LIBRAIRIE", SignStyle::box, kWarm},
    {"NEURO-BAR", SignStyle::neon, kCyan},
    {"METRO", SignStyle::neon, kBlue},
    {"OUBLI", SignStyle::neon, kPurple},
    {"PAIN", SignStyle::box, kWarm},
    {"ROBOTS", SignStyle::neon, kCyan},
    {"REVES", SignStyle::box, kCyan},
    {"NUIT 24:7", SignStyle::neon, kRed},
    {"TAXI >", SignStyle::box, kWhite},
    {"GALERIE", SignStyle::neon, kBlue},
}};

const std::array<SignText, kDownColumns> kSignsDown{{
    {"HOTEL", SignStyle::neon, kRed},
    {"MeMOIRE", SignStyle::neon, kCyan},
    {"BAR", SignStyle::neon, kPurple},
    {"CINeMA", SignStyle::box, kWhite},
    {"DINER", SignStyle::neon, kWarm},
    {"OPeRA", SignStyle::neon, kBlue},
    {"KARAOKE", SignStyle::neon, kPurple},
    {"DOCKS", SignStyle::box, kRed},
}};

Image signs_across_picture() {
    constexpr int kSize = 512;
    Image image = blank("signs across", kSize, kSize, true);
    constexpr int kWidth = kSize / kAcrossColumns;
    constexpr int kHeight = kSize / kAcrossRows;
    for (int i = 0; i < kAcrossColumns * kAcrossRows; ++i) {
        const SignText& sign = kSignsAcross[static_cast<std::size_t>(i)];
        draw_sign(image, {(i % kAcrossColumns) * kWidth, (i / kAcrossColumns) * kHeight, kWidth, kHeight}, sign,
                  strokes_across(sign.text));
    }
    return image;
}

Image signs_down_picture() {
    constexpr int kSize = 512;
    Image image = blank("signs down", kSize, kSize, true);
    constexpr int kWidth = kSize / kDownColumns;
    for (int i = 0; i < kDownColumns; ++i) {
        const SignText& sign = kSignsDown[static_cast<std::size_t>(i)];
        draw_sign(image, {i * kWidth, 0, kWidth, kSize}, sign, strokes_down(sign.text));
    }
    return image;
}

std::array<glm::vec2, 2> across_uv(int sign) {
    const glm::vec2 size(1.0f / kAcrossColumns, 1.0f / kAcrossRows);
    const glm::vec2 low = size * glm::vec2(sign % kAcrossColumns, sign / kAcrossColumns);
    return {low, low + size};
}

std::array<glm::vec2, 2> down_uv(int sign) {
    const float width = 1.0f / kDownColumns;
    const glm::vec2 low(width * static_cast<float>(sign), 0.0f);
    return {low, low + glm::vec2(width, 1.0f)};
}

Image hologram_picture(std::uint32_t seed) {
    constexpr int kSize = 512;
    constexpr int kCell = kSize / 2;
    Image image = blank("holograms", kSize, kSize, true);
    for (int picture = 0; picture < 4; ++picture) {
        std::vector<Stroke> text = strokes_across(picture == 0   ? "REVES"
                                                  : picture == 1 ? "OUBLI"
                                                  : picture == 2 ? "-20*"
                                                                 : "ICI");
        (void)fit(text, {0, 0, kCell, kCell}, picture == 2 ? 46.0f : 84.0f);
        for (Stroke& stroke : text) {
            const glm::vec2 down(0.0f, picture == 0 ? 104.0f : picture == 2 ? -16.0f : picture == 3 ? -92.0f : 0.0f);
            stroke.from = (stroke.from + down) / static_cast<float>(kCell);
            stroke.to = (stroke.to + down) / static_cast<float>(kCell);
        }
        for (int y = 0; y < kCell; ++y) {
            for (int x = 0; x < kCell; ++x) {
                const glm::vec2 at((static_cast<float>(x) + 0.5f) / kCell, (static_cast<float>(y) + 0.5f) / kCell);
                const float light = hologram_line(picture, at, text, seed);
                const float rows = y % 4 < 2 ? 1.0f : 0.72f;
                const float glow = 0.14f * (1.0f - smooth_step(0.25f, 0.5f, glm::length(at - glm::vec2(0.5f))));
                set_texel(image, (picture % 2) * kCell + x, (picture / 2) * kCell + y, glm::vec3(255.0f),
                          std::min(1.0f, (light + glow) * rows));
            }
        }
    }
    return image;
}

std::array<glm::vec2, 2> hologram_uv(int picture) {
    const glm::vec2 low = 0.5f * glm::vec2(picture % 2, picture / 2);
    return {low, low + glm::vec2(0.5f)};
}

}  // namespace halfframe::content::street
