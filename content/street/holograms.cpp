// Light in the air: holograms, haze between the houses, and the city behind them.
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "content/street/sign_textures.h"
#include "content/street/site.h"

namespace halfframe::content::street {

namespace {

void add_panel(Site& site, int material, int picture, const glm::vec3& centre, float width_m, float height_m) {
    const auto [low, high] = hologram_uv(picture);
    const glm::vec3 right(width_m, 0.0f, 0.0f);
    const glm::vec3 up(0.0f, height_m, 0.0f);
    site.builder.picture(material, centre - 0.5f * (right + up), right, up, low + 0.002f, high - 0.002f);
}

/// A drum of text that stands in the air, with the projector under it.
void add_ring(Site& site, int material, const glm::vec3& centre, float radius_m, float height_m) {
    constexpr int kSlices = 16;
    const auto [low, high] = hologram_uv(2);
    for (int i = 0; i < kSlices; ++i) {
        const auto at = [&](int k) {
            const double angle = glm::two_pi<double>() * (k % kSlices) / kSlices;
            return centre +
                   radius_m * glm::vec3(static_cast<float>(std::sin(angle)), 0.0f, static_cast<float>(std::cos(angle)));
        };
        const float step = (high.x - low.x) / 4.0f;
        const float u = low.x + step * static_cast<float>(i % 4);
        site.builder.picture(material, at(i), at(i + 1) - at(i), {0.0f, height_m, 0.0f}, {u, low.y + 0.002f},
                             {u + step, high.y - 0.002f});
    }
}

/// A veil of lit mist across the street: thin below, gone at the top.
void add_veil(Site& site, float z, float x0, float x1, float top_m, float strength) {
    constexpr std::array<glm::vec2, 4> kRows{{{0.05f, 0.75f}, {3.5f, 1.0f}, {9.0f, 0.55f}, {1.0f, 0.0f}}};
    for (std::size_t row = 0; row + 1 < kRows.size(); ++row) {
        const float y0 = kRows[row].x;
        const float y1 = row + 2 == kRows.size() ? top_m : kRows[row + 1].x;
        const glm::vec4 low(1.0f, 1.0f, 1.0f, strength * kRows[row].y);
        const glm::vec4 high(1.0f, 1.0f, 1.0f, strength * kRows[row + 1].y);
        site.builder.colored_patch(
            site.of.haze, {glm::vec3(x0, y0, z), glm::vec3(x1, y0, z), glm::vec3(x1, y1, z), glm::vec3(x0, y1, z)},
            {low, low, high, high});
    }
}

void add_tower(Site& site, float x, float z, float half, float top_m) {
    Builder& builder = site.builder;
    const float step = 0.62f * top_m;
    builder.box(site.of.skyline, {x - half, 0.0f, z - half}, {x + half, step, z + half}, kNotBottom & ~kBack);
    builder.box(site.of.skyline, {x - 0.7f * half, step, z - 0.7f * half}, {x + 0.7f * half, top_m, z + 0.7f * half},
                kNotBottom & ~kBack);
    builder.bar(site.of.iron, {x, top_m, z}, {x, top_m + 7.0f, z}, 0.18f, 5);
    builder.box(site.of.glow_red, {x - 0.25f, top_m + 7.0f, z - 0.25f}, {x + 0.25f, top_m + 7.5f, z + 0.25f});
}

/// The iron tower everybody knows, smaller and nearer than it is: four legs that curve together, three platforms.
void add_iron_tower(Site& site, const glm::vec3& foot, float height_m) {
    Builder& builder = site.builder;
    const auto half_at = [&](float t) { return height_m * (0.016f + 0.17f * std::pow(1.0f - t, 2.6f)); };
    constexpr int kSteps = 14;
    const auto knot = [&](int i, float sx, float sz) {
        const float t = static_cast<float>(i) / kSteps;
        return foot + glm::vec3(sx * half_at(t), height_m * t, sz * half_at(t));
    };
    constexpr std::array<glm::vec2, 4> kLegs{{{-1.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, -1.0f}, {-1.0f, -1.0f}}};
    for (int i = 0; i < kSteps; ++i) {
        const float thick = height_m * (0.0065f - 0.004f * static_cast<float>(i) / kSteps);
        for (std::size_t leg = 0; leg < 4; ++leg) {
            const glm::vec2 here = kLegs[leg];
            const glm::vec2 next = kLegs[(leg + 1) % 4];
            builder.bar(site.of.iron, knot(i, here.x, here.y), knot(i + 1, here.x, here.y), 1.5f * thick, 4);
            if (i > 2) builder.bar(site.of.iron, knot(i, here.x, here.y), knot(i + 1, next.x, next.y), 0.6f * thick, 4);
            if (i > 2) builder.bar(site.of.iron, knot(i + 1, here.x, here.y), knot(i, next.x, next.y), 0.6f * thick, 4);
            if (i % 2 == 0) builder.bar(site.of.copper, knot(i, here.x, here.y), knot(i, next.x, next.y), thick, 4);
        }
    }
    for (const int i : {3, 6, 13}) {
        const float half = half_at(static_cast<float>(i) / kSteps) + 0.012f * height_m;
        const float y = height_m * static_cast<float>(i) / kSteps;
        builder.box(site.of.iron, foot + glm::vec3(-half, y, -half),
                    foot + glm::vec3(half, y + 0.016f * height_m, half));
        builder.box(site.of.lamp_warm, foot + glm::vec3(-half, y + 0.004f * height_m, half),
                    foot + glm::vec3(half, y + 0.008f * height_m, half + 0.05f));
    }
    builder.bar(site.of.iron, foot + glm::vec3(0.0f, height_m, 0.0f), foot + glm::vec3(0.0f, 1.07f * height_m, 0.0f),
                0.2f, 5);
    builder.box(site.of.lamp_cool, foot + glm::vec3(-0.35f, 1.07f * height_m, -0.35f),
                foot + glm::vec3(0.35f, 1.07f * height_m + 0.7f, 0.35f));
}

}  // namespace

void add_holograms(Site& site) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    // A portrait over the crossing, leaning out from the corner.
    builder.place(facing({6.2f, 0.0f, -50.4f}, {-0.55f, 0.0f, 0.835165f}));
    add_panel(site, of.hologram_cyan, 0, {0.0f, 7.6f, 1.6f}, 6.4f, 6.4f);
    builder.box(of.steel, {-1.4f, 4.3f, 1.5f}, {1.4f, 4.4f, 1.7f});
    builder.bar(of.iron, {0.0f, 4.35f, 1.6f}, {0.0f, 4.35f, -1.0f}, 0.06f, 6);
    add_lamp(site, "portrait", {0.0f, 6.0f, 3.2f}, {0.8f, 3.0f, 3.6f}, 9.0f, 0.6f);
    builder.place(glm::mat4(1.0f));
    add_ring(site, of.hologram_purple, {0.0f, 6.2f, -45.0f}, 2.4f, 1.2f);
    add_ring(site, of.hologram_cyan, {0.0f, 7.9f, -45.0f}, 1.5f, 0.7f);
    builder.place(facing({-kFacadeX, 0.0f, -3.0f}, {1.0f, 0.0f, 0.0f}));
    add_panel(site, of.hologram_red, 2, {0.0f, 2.35f, 1.9f}, 1.1f, 1.1f);
    builder.place(facing({4.2f, 0.0f, -30.0f}, {-0.35f, 0.0f, 0.936750f}));
    add_panel(site, of.hologram_red, 1, {0.0f, 3.1f, 0.0f}, 2.2f, 2.2f);
    builder.place(facing({8.1f, 0.0f, -33.6f}, {-0.4f, 0.0f, 0.916515f}));
    add_panel(site, of.hologram_cyan, 3, {0.0f, 2.0f, 0.0f}, 1.3f, 1.3f);
    builder.place(facing({-6.0f, 0.0f, -62.0f}, {0.5f, 0.0f, 0.866025f}));
    add_panel(site, of.hologram_purple, 0, {0.0f, 8.5f, 1.5f}, 5.5f, 5.5f);
    builder.place(facing({-15.5f, 0.0f, -21.8f}, {1.0f, 0.0f, 0.0f}));
    add_panel(site, of.hologram_purple, 1, {0.5f, 3.0f, 0.0f}, 1.4f, 1.4f);
    builder.place(glm::mat4(1.0f));
    for (const float z : {-26.0f, -52.0f, -70.0f, -88.0f})
        add_veil(site, z, -kFacadeX + 0.01f, kFacadeX - 0.01f, 24.0f, 0.42f + 0.10f * -z / 50.0f);
}

void add_skyline(Site& site) {
    site.builder.place(glm::mat4(1.0f));
    Random random = site.random(900);
    add_iron_tower(site, {3.0f, 0.0f, -150.0f}, 62.0f);
    constexpr std::array<glm::vec4, 10> kTowers{{{-13.0f, -128.0f, 5.5f, 44.0f},
                                                 {17.0f, -122.0f, 5.0f, 36.0f},
                                                 {-30.0f, -118.0f, 7.0f, 34.0f},
                                                 {34.0f, -126.0f, 8.0f, 46.0f},
                                                 {-48.0f, -105.0f, 7.0f, 40.0f},
                                                 {52.0f, -100.0f, 7.0f, 38.0f},
                                                 {-44.0f, -72.0f, 7.0f, 36.0f},
                                                 {46.0f, -66.0f, 6.0f, 42.0f},
                                                 {-1.0f, -112.0f, 3.0f, 17.0f},
                                                 {30.0f, -78.0f, 5.0f, 34.0f}}};
    for (const glm::vec4& tower : kTowers)
        add_tower(site, tower.x, tower.y, tower.z, tower.w * random.between(0.95f, 1.05f));
    // Ground to stand on, out of sight.
    site.builder.quad(site.of.kerb, {-62.0f, -0.10f, -99.0f}, {124.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -58.0f});
}

}  // namespace halfframe::content::street
