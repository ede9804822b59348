// Balconies, pipes, cables, and the technology that grew over the stone.
#include <array>
#include <cmath>

#include "content/street/facade.h"

namespace halfframe::content::street {

void build_balcony(Builder& builder, const Materials& of, float x0, float x1, float y, float depth_m, bool left_side,
                   bool right_side) {
    constexpr float kSlab = 0.13f;
    constexpr float kRailing = 0.98f;
    unsigned sides = kFront | kTop | kBottom;
    if (left_side) sides |= kLeft;
    if (right_side) sides |= kRight;
    builder.box(of.trim, {x0, y - kSlab, 0.0f}, {x1, y, depth_m}, sides);
    const float inset = 0.05f;
    const float repeats = std::max(1.0f, std::round(x1 - x0));
    builder.picture(of.railing, {x0, y, depth_m - inset}, {x1 - x0, 0.0f, 0.0f}, {0.0f, kRailing, 0.0f}, {0.0f, 0.0f},
                    {repeats, 1.0f});
    const glm::vec3 back(0.0f, 0.0f, depth_m - inset);
    if (left_side)
        builder.picture(of.railing, {x0 + 0.02f, y, 0.0f}, back, {0.0f, kRailing, 0.0f}, {0.0f, 0.0f}, {depth_m, 1.0f});
    if (right_side)
        builder.picture(of.railing, {x1 - 0.02f, y, 0.0f}, back, {0.0f, kRailing, 0.0f}, {0.0f, 0.0f}, {depth_m, 1.0f});
    for (const float x : {x0 + 0.18f, x1 - 0.36f})
        builder.box(of.trim, {x, y - kSlab - 0.32f, 0.0f}, {x + 0.18f, y - kSlab, 0.62f * depth_m}, kNotBack & ~kTop);
}

void build_growth(Builder& builder, const Materials& of, Growth growth, float x0, float x1, float y, Random& random) {
    const float width = x1 - x0;
    if (width < 0.30f) return;
    switch (growth) {
        case Growth::none: return;
        case Growth::air_conditioner: {
            const float w = std::min(width, 0.85f);
            builder.box(of.panels, {x0, y - 0.05f, 0.02f}, {x0 + w, y + 0.55f, 0.36f});
            const glm::vec3 fan(x0 + 0.5f * w, y + 0.25f, 0.36f);
            builder.bar(of.iron, fan, fan + glm::vec3(0.0f, 0.0f, 0.02f), 0.20f, 10, true);
            return;
        }
        case Growth::cable_box: {
            const float w = std::min(width, 0.42f);
            builder.box(of.panels, {x0, y + 0.5f, 0.01f}, {x0 + w, y + 1.25f, 0.20f}, kNotBack);
            builder.box(random.chance(0.5f) ? of.glow_cyan : of.glow_red, {x0 + 0.06f, y + 1.10f, 0.20f},
                        {x0 + 0.11f, y + 1.15f, 0.206f}, kNotBack);
            builder.bar(of.rubber, {x0 + 0.5f * w, y + 0.52f, 0.08f}, {x0 + 0.5f * w, y - 1.6f, 0.08f}, 0.022f, 5);
            return;
        }
        case Growth::antenna: {
            const glm::vec3 foot(x0 + 0.2f, y + 1.2f, 0.0f);
            const glm::vec3 tip = foot + glm::vec3(0.0f, 0.15f, 0.55f);
            builder.bar(of.steel, foot, tip, 0.02f, 5, true);
            constexpr std::array<glm::vec2, 3> kDish{{{0.28f, 0.10f}, {0.18f, 0.03f}, {0.0f, 0.0f}}};
            builder.lathe(of.steel, tip, kDish, 10, true);
            builder.bar(of.steel, tip, tip + glm::vec3(0.0f, 0.5f, 0.0f), 0.012f, 4, true);
            return;
        }
        case Growth::pod: {
            const float w = std::min(width, 0.9f);
            builder.box(of.panels, {x0, y - 0.2f, 0.01f}, {x0 + w, y + 1.5f, 0.42f}, kNotBack);
            builder.box(of.iron, {x0 + 0.05f, y - 0.10f, 0.42f}, {x0 + w - 0.05f, y + 0.55f, 0.46f}, kNotBack);
            builder.box(of.glow_blue, {x0 + 0.05f, y + 1.34f, 0.42f}, {x0 + w - 0.05f, y + 1.38f, 0.44f}, kNotBack);
            return;
        }
        case Growth::screen: {
            const float w = std::min(width, 0.6f);
            builder.box(of.iron, {x0, y + 0.3f, 0.01f}, {x0 + w, y + 1.5f, 0.09f}, kNotBack);
            builder.box(random.chance(0.5f) ? of.glow_purple : of.glow_blue, {x0 + 0.06f, y + 0.36f, 0.09f},
                        {x0 + 0.09f, y + 1.44f, 0.10f}, kNotBack);
            return;
        }
        case Growth::plants: {
            const float w = std::min(width, 0.8f);
            builder.box(of.panels, {x0, y, 0.01f}, {x0 + w, y + 0.22f, 0.26f}, kNotBack);
            constexpr std::array<glm::vec2, 4> kBush{{{0.0f, 0.42f}, {0.16f, 0.30f}, {0.19f, 0.12f}, {0.10f, 0.0f}}};
            for (float x = x0 + 0.16f; x < x0 + w - 0.1f; x += 0.26f)
                builder.lathe(of.leaves, {x, y + 0.20f, 0.15f}, kBush, 5);
            return;
        }
    }
}

void build_pipes(Builder& builder, const Materials& of, float width_m, float foot_m, float top_m, Random& random) {
    // A rain pipe at each end, with collars, down to a shoe over the pavement.
    for (const float x : {0.22f, width_m - 0.22f}) {
        builder.bar(of.zinc, {x, 0.35f, 0.26f}, {x, top_m, 0.26f}, 0.065f, 8);
        builder.bar(of.zinc, {x, 0.36f, 0.26f}, {x, 0.20f, 0.42f}, 0.065f, 8, true);
        for (float y = 1.6f; y < top_m - 0.5f; y += 3.3f) {
            builder.bar(of.iron, {x, y, 0.26f}, {x, y + 0.07f, 0.26f}, 0.085f, 8, true);
            builder.box(of.iron, {x - 0.02f, y + 0.01f, 0.0f}, {x + 0.02f, y + 0.05f, 0.20f}, kNotBack);
        }
    }
    // A bundle of cables that climbs where two bays meet, and one that sags from end to end.
    const float climb = random.between(0.3f, 0.7f) * width_m;
    for (int i = 0; i < 3; ++i) {
        const float x = climb + 0.07f * static_cast<float>(i);
        builder.bar(i == 1 ? of.copper : of.rubber, {x, foot_m - 0.3f, 0.17f},
                    {x, top_m - random.between(0.2f, 4.0f), 0.17f}, i == 1 ? 0.028f : 0.020f, 5, true);
    }
    const float y = foot_m + random.between(0.2f, 0.5f);
    const int steps = std::max(4, static_cast<int>(width_m / 1.5f));
    std::vector<glm::vec3> sag;
    for (int i = 0; i <= steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        sag.emplace_back(t * width_m, y - 0.55f * 4.0f * t * (1.0f - t) * 0.5f, 0.30f);
    }
    builder.tube(of.rubber, sag, 0.024f, 5);
}

}  // namespace halfframe::content::street
