// Shops, roller shutters and doors along a ground floor.
#include <array>
#include <cmath>

#include "content/street/facade.h"
#include "content/street/site.h"
#include "content/street/textures.h"

namespace halfframe::content::street {

namespace {

constexpr float kPier_m = 0.5f;
constexpr float kGlassZ = -0.30f;  // shop windows lie this far behind the wall

/// What may stand over a shop: the metro and the taxis have their own places.
int shop_sign(Random& random) {
    constexpr std::array<int, 13> kSigns{0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 12, 13, 15};
    return kSigns[static_cast<std::size_t>(random.below(static_cast<int>(kSigns.size())))];
}

void add_awning(Site& site, int cloth, float x0, float x1) {
    Builder& builder = site.builder;
    const glm::vec3 a(x0, 3.02f, 0.14f);
    const glm::vec3 b(x1, 3.02f, 0.14f);
    const glm::vec3 out(0.0f, -0.50f, 1.15f);
    const glm::vec3 hem(0.0f, -0.24f, 0.0f);
    const glm::vec3 thick(0.0f, -0.025f, -0.01f);
    builder.patch(cloth, {a + out, b + out, b, a});
    builder.patch(cloth, {a + thick, b + thick, b + out + thick, a + out + thick});
    builder.patch(cloth, {a + out + hem, b + out + hem, b + out, a + out});
    builder.patch(cloth, {b + out + hem + thick, a + out + hem + thick, a + out + thick, b + out + thick});
    builder.triangle(cloth, a, glm::vec3(x0, 2.52f, 0.14f), a + out);
    builder.triangle(cloth, b, b + out, glm::vec3(x1, 2.52f, 0.14f));
    for (const float x : {x0 + 0.05f, x1 - 0.05f})
        builder.bar(site.of.iron, {x, 2.45f, 0.10f}, {x, 2.50f, 1.22f}, 0.015f, 4);
}

void add_door(Site& site, float x0, float x1, bool lit) {
    Builder& builder = site.builder;
    // A leaf of 2.2 m with a pane, a fanlight over it, a handle.
    builder.box(site.of.door, {x0, kPavement_m, kGlassZ - 0.05f}, {x1, kPavement_m + 2.2f, kGlassZ}, kFront);
    const int kind = lit ? 4 : 0;
    const glm::vec2 low = 0.25f * glm::vec2(kind % 4, kind / 4);
    builder.picture(site.of.window, {x0 + 0.16f, 1.10f, kGlassZ + 0.006f}, {x1 - x0 - 0.32f, 0.0f, 0.0f},
                    {0.0f, 1.05f, 0.0f}, low + 0.002f, low + 0.248f);
    builder.picture(site.of.window, {x0, kPavement_m + 2.2f, kGlassZ}, {x1 - x0, 0.0f, 0.0f},
                    {0.0f, 3.05f - kPavement_m - 2.2f, 0.0f}, low + 0.002f, low + 0.1f);
    builder.bar(site.of.copper, {x1 - 0.12f, 1.0f, kGlassZ + 0.05f}, {x1 - 0.12f, 1.35f, kGlassZ + 0.05f}, 0.018f, 5,
                true);
    builder.box(site.of.kerb, {x0, 0.0f, kGlassZ}, {x1, kPavement_m + 0.03f, 0.10f}, kFront | kTop);
}

void add_shop(Site& site, float x0, float x1, Random& random, bool lamp) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    const bool door_left = random.chance(0.5f);
    const bool closed = random.chance(0.14f);
    const float door0 = door_left ? x0 : x1 - 1.05f;
    const float show0 = door_left ? x0 + 1.15f : x0;
    const float show1 = door_left ? x1 : x1 - 1.15f;
    const int frame = random.chance(0.5f) ? of.lacquer_blue : of.door;
    builder.box(frame, {show0, 0.0f, kGlassZ}, {show1, 0.68f, kGlassZ + 0.14f}, kFront | kTop | kLeft | kRight);
    builder.box(frame, {door_left ? x0 + 1.05f : x1 - 1.15f, 0.0f, kGlassZ},
                {door_left ? x0 + 1.15f : x1 - 1.05f, 3.05f, kGlassZ + 0.14f}, kNotBack);
    const int kind = random.below(kShopKinds);
    if (closed) {
        builder.quad(of.zinc, {show0, 0.68f, kGlassZ + 0.05f}, {show1 - show0, 0.0f, 0.0f}, {0.0f, 2.37f, 0.0f});
    } else {
        const glm::vec2 size(1.0f / kShopColumns, static_cast<float>(kShopColumns) / kShopKinds);
        const glm::vec2 low = size * glm::vec2(kind % kShopColumns, kind / kShopColumns);
        builder.picture(of.shop_window, {show0, 0.68f, kGlassZ}, {show1 - show0, 0.0f, 0.0f}, {0.0f, 2.37f, 0.0f},
                        low + 0.002f, low + size - 0.002f);
    }
    add_door(site, door0, door0 + 1.05f, !closed);
    builder.box(frame, {x0, 3.05f, kGlassZ}, {x1, 3.80f, 0.13f}, kFront | kTop | kBottom);
    add_sign_across(site, shop_sign(random), {0.5f * (x0 + x1), 3.42f, 0.15f}, std::min(2.75f, x1 - x0 - 0.2f));
    const std::array<int, 3> cloths{of.cloth_red, of.cloth_blue, of.cloth_purple};
    if (lamp && !closed && random.chance(0.55f))
        add_awning(site, cloths[static_cast<std::size_t>(random.below(3))], x0 + 0.05f, x1 - 0.05f);
    if (lamp && !closed && random.chance(0.75f))
        add_lamp(site, "shop", {0.5f * (show0 + show1), 2.2f, 0.85f},
                 kind % 2 == 0 ? glm::vec3(2.4f, 1.65f, 1.0f) : glm::vec3(1.1f, 1.55f, 2.2f), 6.0f);
}

void add_house_door(Site& site, int wall, float x0, float x1) {
    Builder& builder = site.builder;
    const float middle = 0.5f * (x0 + x1);
    const float half = 0.65f;
    builder.quad(wall, {x0, 0.0f, 0.0f}, {middle - half - x0, 0.0f, 0.0f}, {0.0f, 3.80f, 0.0f});
    builder.quad(wall, {middle + half, 0.0f, 0.0f}, {x1 - middle - half, 0.0f, 0.0f}, {0.0f, 3.80f, 0.0f});
    builder.quad(wall, {middle - half, 3.05f, 0.0f}, {2.0f * half, 0.0f, 0.0f}, {0.0f, 0.75f, 0.0f});
    builder.quad(wall, {middle - half, 0.0f, 0.0f}, {0.0f, 0.0f, kGlassZ}, {0.0f, 3.05f, 0.0f});
    builder.quad(wall, {middle + half, 0.0f, kGlassZ}, {0.0f, 0.0f, -kGlassZ}, {0.0f, 3.05f, 0.0f});
    builder.quad(wall, {middle - half, 3.05f, kGlassZ}, {2.0f * half, 0.0f, 0.0f}, {0.0f, 0.0f, -kGlassZ});
    add_door(site, middle - half, middle + half, true);
    builder.box(site.of.trim, {middle - half - 0.25f, 3.10f, 0.0f}, {middle + half + 0.25f, 3.32f, 0.22f}, kNotBack);
    builder.box(site.of.lamp_warm, {middle - 0.12f, 3.36f, 0.06f}, {middle + 0.12f, 3.60f, 0.26f});
}

}  // namespace

void add_ground_floor(Site& site, float width_m, float top_m, Random random, bool lamps) {
    Builder& builder = site.builder;
    const int units = std::max(1, static_cast<int>(std::lround(width_m / 4.4f)));
    const float unit = width_m / static_cast<float>(units);
    const int house_door = random.below(units);
    const int wall = site.of.stone;
    for (int i = 0; i < units; ++i) {
        const float x0 = unit * static_cast<float>(i);
        const float x1 = x0 + unit;
        const float in0 = x0 + 0.5f * kPier_m;
        const float in1 = x1 - 0.5f * kPier_m;
        if (i == house_door && units > 1) add_house_door(site, wall, in0, in1);
        else add_shop(site, in0, in1, random, lamps);
        builder.quad(wall, {in0, 3.80f, 0.0f}, {in1 - in0, 0.0f, 0.0f}, {0.0f, top_m - 3.80f, 0.0f});
        // Piers reach before the wall, so that each unit has an edge of its own.
        builder.box(wall, {x0, 0.0f, kGlassZ}, {in0, top_m, 0.06f}, kFront | kRight | kLeft);
        builder.box(wall, {in1, 0.0f, kGlassZ}, {x1, top_m, 0.06f}, kFront | kRight | kLeft);
        builder.box(site.of.trim, {x0, 0.0f, 0.0f}, {in0, 0.75f, 0.12f}, kNotBack);
        builder.box(site.of.trim, {in1, 0.0f, 0.0f}, {x1, 0.75f, 0.12f}, kNotBack);
    }
}

}  // namespace halfframe::content::street
