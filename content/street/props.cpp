// Benches, bins, crates, planters, bollards, a kiosk.
#include <array>

#include "content/street/site.h"

namespace halfframe::content::street {

namespace {

void add_bench(Site& site) {
    Builder& builder = site.builder;
    for (int slat = 0; slat < 4; ++slat) {
        const float z = 0.12f * static_cast<float>(slat);
        builder.box(site.of.wood, {-0.9f, 0.43f, z}, {0.9f, 0.47f, z + 0.095f});
    }
    for (int slat = 0; slat < 3; ++slat) {
        const float y = 0.58f + 0.13f * static_cast<float>(slat);
        builder.box(site.of.wood, {-0.9f, y, -0.05f}, {0.9f, y + 0.10f, -0.01f});
    }
    for (const float x : {-0.7f, 0.7f}) {
        builder.box(site.of.iron, {x - 0.03f, 0.0f, 0.02f}, {x + 0.03f, 0.43f, 0.08f});
        builder.box(site.of.iron, {x - 0.03f, 0.0f, 0.36f}, {x + 0.03f, 0.43f, 0.42f});
        builder.box(site.of.iron, {x - 0.03f, 0.40f, -0.10f}, {x + 0.03f, 0.96f, -0.05f});
    }
}

void add_bin(Site& site) {
    constexpr std::array<glm::vec2, 6> kBody{
        {{0.0f, 1.02f}, {0.16f, 0.98f}, {0.27f, 0.86f}, {0.27f, 0.80f}, {0.23f, 0.04f}, {0.0f, 0.0f}}};
    site.builder.lathe(site.of.panels, glm::vec3(0.0f), kBody, 12);
    constexpr std::array<glm::vec2, 2> kBand{{{0.285f, 0.78f}, {0.285f, 0.72f}}};
    site.builder.lathe(site.of.glow_cyan, glm::vec3(0.0f), kBand, 12);
}

void add_crates(Site& site, Random& random, int count) {
    Builder& builder = site.builder;
    float x = 0.0f;
    for (int i = 0; i < count; ++i) {
        const float size = random.between(0.45f, 0.75f);
        const float high = random.between(0.40f, 0.65f);
        const int material = random.chance(0.5f) ? site.of.wood : site.of.panels;
        builder.box(material, {x, 0.0f, 0.0f}, {x + size, high, size}, kNotBottom);
        builder.box(site.of.iron, {x - 0.012f, high - 0.09f, -0.012f},
                    {x + size + 0.012f, high - 0.04f, size + 0.012f});
        if (random.chance(0.5f))
            builder.box(site.of.wood, {x + 0.06f, high, 0.05f}, {x + size - 0.05f, high + 0.36f, size - 0.08f},
                        kNotBottom);
        x += size + random.between(0.04f, 0.15f);
    }
    // A tarpaulin over the last.
    const int cloth = random.chance(0.5f) ? site.of.cloth_blue : site.of.cloth_purple;
    const glm::vec3 foot(x + 0.50f, 0.0f, 0.36f);
    const std::array<glm::vec2, 5> heap{{{0.0f, 0.62f}, {0.22f, 0.58f}, {0.36f, 0.40f}, {0.42f, 0.10f}, {0.50f, 0.0f}}};
    builder.lathe(cloth, foot, heap, 9);
}

void add_planter(Site& site, Random& random) {
    Builder& builder = site.builder;
    builder.box(site.of.panels, {-0.6f, 0.0f, -0.6f}, {0.6f, 0.55f, 0.6f}, kNotBottom & ~kTop);
    builder.quad(site.of.soil, {-0.6f, 0.52f, 0.6f}, {1.2f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.2f});
    builder.box(site.of.glow_blue, {-0.61f, 0.46f, -0.61f}, {0.61f, 0.48f, 0.61f}, kLeft | kRight | kFront | kBack);
    builder.bar(site.of.wood, {0.0f, 0.5f, 0.0f}, {0.06f, 2.5f, 0.03f}, 0.06f, 7);
    for (int i = 0; i < 7; ++i) {
        const glm::vec3 at(random.between(-0.5f, 0.5f), random.between(1.9f, 2.9f), random.between(-0.5f, 0.5f));
        const float r = random.between(0.35f, 0.55f);
        const std::array<glm::vec2, 5> bush{
            {{0.0f, 1.5f * r}, {0.7f * r, 1.15f * r}, {r, 0.7f * r}, {0.72f * r, 0.2f * r}, {0.0f, 0.0f}}};
        builder.lathe(site.of.leaves, at, bush, 7, true);
    }
}

void add_bollards(Site& site, float x, float from_z, float to_z) {
    Builder& builder = site.builder;
    constexpr std::array<glm::vec2, 6> kPost{
        {{0.0f, 1.0f}, {0.06f, 0.96f}, {0.045f, 0.86f}, {0.06f, 0.82f}, {0.07f, 0.06f}, {0.09f, 0.0f}}};
    for (float z = from_z; z > to_z; z -= 1.7f) {
        builder.place(facing({x, kPavement_m, z}, {0.0f, 0.0f, 1.0f}));
        builder.lathe(site.of.iron, glm::vec3(0.0f), kPost, 8, true);
    }
}

/// A newsagent's kiosk with the dome that Paris knows, and screens where posters were.
void add_kiosk(Site& site) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    builder.box(of.door, {-1.1f, 0.0f, -0.9f}, {1.1f, 2.5f, 0.9f}, kNotBottom);
    builder.box(of.iron, {-1.45f, 2.5f, -1.25f}, {1.45f, 2.68f, 1.25f});
    constexpr std::array<glm::vec2, 6> kDome{
        {{0.0f, 1.35f}, {0.05f, 1.0f}, {0.35f, 0.82f}, {0.85f, 0.42f}, {1.15f, 0.08f}, {1.2f, 0.0f}}};
    builder.lathe(of.door, {0.0f, 2.68f, 0.0f}, kDome, 16, true);
    const glm::vec2 size(0.5f, 0.25f);
    builder.picture(of.shop_window, {-0.95f, 0.95f, 0.912f}, {1.9f, 0.0f, 0.0f}, {0.0f, 1.25f, 0.0f},
                    glm::vec2(0.0f, 0.25f) + 0.002f, glm::vec2(0.0f, 0.25f) + size - 0.002f);
    builder.box(of.wood, {-1.1f, 0.86f, 0.9f}, {1.1f, 0.93f, 1.25f});
    builder.picture(of.shop_window, {1.112f, 0.5f, 0.8f}, {0.0f, 0.0f, -1.6f}, {0.0f, 1.8f, 0.0f}, {0.53f, 0.53f},
                    {0.72f, 0.72f});
    add_sign_across(site, 10, {0.0f, 2.38f, 0.96f}, 1.3f);
    add_lamp(site, "kiosk", {0.0f, 2.0f, 1.7f}, {1.5f, 1.05f, 0.62f}, 5.0f);
}

}  // namespace

void add_props(Site& site) {
    Builder& builder = site.builder;
    Random random = site.random(500);
    const glm::vec3 right(1.0f, 0.0f, 0.0f);
    const auto on_pavement = [&](float x, float z, const glm::vec3& outward) {
        builder.place(facing({x, kPavement_m, z}, outward));
    };
    for (const float z : {9.5f, -11.0f, -56.0f}) {
        on_pavement(-5.3f, z, right);
        add_bench(site);
    }
    on_pavement(9.6f, -22.5f, -right);
    add_bench(site);
    for (const glm::vec2 at : {glm::vec2(-4.7f, 7.0f), glm::vec2(4.7f, -5.0f), glm::vec2(-4.7f, -13.0f),
                               glm::vec2(4.75f, -28.0f), glm::vec2(-4.75f, -51.5f)}) {
        on_pavement(at.x, at.y, right);
        add_bin(site);
    }
    on_pavement(-6.4f, 1.8f, right);
    add_crates(site, random, 2);
    on_pavement(5.9f, 12.0f, -right);
    add_crates(site, random, 3);
    on_pavement(-19.0f, kAlleyFar + 0.15f, {0.0f, 0.0f, 1.0f});
    add_crates(site, random, 3);
    for (const glm::vec2 at : {glm::vec2(5.3f, 2.0f), glm::vec2(5.2f, -53.0f), glm::vec2(-5.3f, -26.6f),
                               glm::vec2(5.3f, -66.0f), glm::vec2(-5.3f, -78.0f)}) {
        on_pavement(at.x, at.y, right);
        add_planter(site, random);
    }
    on_pavement(5.5f, -13.0f, {-0.6f, 0.0f, 0.8f});
    add_kiosk(site);
    add_bollards(site, 4.55f, -14.0f + 13.0f, -5.0f);
    add_bollards(site, 4.55f, -28.5f, -36.5f);
    add_bollards(site, -4.55f, -19.6f, -24.6f);
}

}  // namespace halfframe::content::street
