// The arcade: piers, arches, groin vaults, lamps, and shops that stay dry.
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "content/street/site.h"

namespace halfframe::content::street {

namespace {

constexpr int kBays = 10;
constexpr float kBay_m = (kArcadeNear - kArcadeFar) / kBays;
constexpr float kPierHalf = 0.36f;
constexpr float kSpring_m = 3.0f;  // where arches begin
constexpr float kRise_m = 1.65f;
constexpr float kWallDepth_m = 0.72f;  // of piers and arches
constexpr int kArchSegments = 10;

float arch_y(float t) { return kSpring_m + kRise_m * std::sqrt(std::max(0.0f, 1.0f - t * t)); }

/// A bay of the outer wall in a frame whose x runs along it from the middle of a pier, z outwards to the street.
void add_arch(Site& site) {
    Builder& builder = site.builder;
    const int stone = site.of.stone;
    const float x0 = kPierHalf;
    const float x1 = kBay_m - kPierHalf;
    std::vector<glm::vec3> outer;
    std::vector<glm::vec3> inner;
    std::vector<glm::vec3> normals;
    for (int i = 0; i <= kArchSegments; ++i) {
        const double angle = glm::pi<double>() * i / kArchSegments;
        const float t = static_cast<float>(-std::cos(angle));
        const float x = 0.5f * (x0 + x1) + 0.5f * (x1 - x0) * t;
        outer.emplace_back(x, arch_y(t), 0.0f);
        inner.emplace_back(x, arch_y(t), -kWallDepth_m);
        normals.push_back(glm::normalize(glm::vec3(-t, -static_cast<float>(std::sin(angle)), 0.0f)));
    }
    builder.strip(stone, inner, outer, normals);
    for (std::size_t i = 0; i + 1 < outer.size(); ++i) {
        const auto over = [](const glm::vec3& at) { return glm::vec3(at.x, kArcadeTop_m, at.z); };
        builder.patch(stone, {outer[i], outer[i + 1], over(outer[i + 1]), over(outer[i])});
        builder.patch(stone, {inner[i + 1], inner[i], over(inner[i]), over(inner[i + 1])});
    }
    // Keystone, and a moulding where the floors begin.
    const float middle = 0.5f * kBay_m;
    builder.box(site.of.trim, {middle - 0.16f, kSpring_m + kRise_m - 0.06f, -0.05f},
                {middle + 0.16f, kArcadeTop_m - 0.1f, 0.14f});
}

void add_pier(Site& site) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    builder.box(of.stone, {-kPierHalf, kPavement_m, -kWallDepth_m}, {kPierHalf, kArcadeTop_m, 0.0f},
                kNotBottom & ~kTop);
    builder.box(of.trim, {-kPierHalf - 0.07f, kPavement_m, -kWallDepth_m - 0.07f}, {kPierHalf + 0.07f, 0.75f, 0.07f},
                kNotBottom);
    builder.box(of.trim, {-kPierHalf - 0.10f, kSpring_m - 0.28f, -kWallDepth_m - 0.10f},
                {kPierHalf + 0.10f, kSpring_m, 0.10f});
    builder.box(of.trim, {-kPierHalf - 0.05f, kSpring_m - 0.42f, -kWallDepth_m - 0.05f},
                {kPierHalf + 0.05f, kSpring_m - 0.28f, 0.05f});
    // A bracket lamp towards the street.
    builder.bar(of.iron, {0.0f, 2.45f, 0.0f}, {0.0f, 2.62f, 0.42f}, 0.022f, 5);
    builder.box(of.iron, {-0.09f, 2.60f, 0.33f}, {0.09f, 2.66f, 0.51f});
    builder.box(of.lamp_warm, {-0.07f, 2.34f, 0.35f}, {0.07f, 2.60f, 0.49f});
}

/// Two barrels that cross: the height is the greater of theirs, the crease lies on the diagonals.
void add_vault(Site& site) {
    Builder& builder = site.builder;
    constexpr int kCells = 8;
    const float near_z = -kWallDepth_m;
    const float far_z = -(kArcadeWall - kFacadeX);
    const auto place = [&](float s, float t, bool along) {
        const float y = arch_y(along ? t : s) + 0.02f;
        return glm::vec3((0.5f + 0.5f * s) * kBay_m, y, near_z + (0.5f + 0.5f * t) * (far_z - near_z));
    };
    const auto knot = [](int i) { return static_cast<float>(-std::cos(glm::pi<double>() * i / kCells)); };
    for (int row = 0; row < kCells; ++row) {
        for (int column = 0; column < kCells; ++column) {
            const std::array<glm::vec2, 4> at{
                glm::vec2(knot(column), knot(row)), glm::vec2(knot(column + 1), knot(row)),
                glm::vec2(knot(column + 1), knot(row + 1)), glm::vec2(knot(column), knot(row + 1))};
            const auto corner = [&](std::size_t i, bool along) { return place(at[i].x, at[i].y, along); };
            const auto face = [&](std::size_t a, std::size_t b, std::size_t c) {
                const glm::vec2 middle = (at[a] + at[b] + at[c]) / 3.0f;
                const bool along = std::abs(middle.y) < std::abs(middle.x);
                builder.triangle(site.of.stone, corner(a, along), corner(c, along), corner(b, along));
            };
            const bool rising = (column < kCells / 2) == (row < kCells / 2);
            if (rising) {
                face(0, 1, 2);
                face(0, 2, 3);
            } else {
                face(0, 1, 3);
                face(1, 2, 3);
            }
        }
    }
}

void add_hanging_lamp(Site& site, bool light) {
    Builder& builder = site.builder;
    const glm::vec3 at(0.5f * kBay_m, 0.0f, -0.5f * (kWallDepth_m + kArcadeWall - kFacadeX));
    const float y = 3.25f;
    builder.bar(site.of.iron, {at.x, y + 0.40f, at.z}, {at.x, kSpring_m + kRise_m, at.z}, 0.015f, 4);
    constexpr std::array<glm::vec2, 4> kCap{{{0.0f, 0.42f}, {0.08f, 0.38f}, {0.26f, 0.20f}, {0.26f, 0.16f}}};
    constexpr std::array<glm::vec2, 5> kBowl{
        {{0.22f, 0.18f}, {0.22f, 0.08f}, {0.16f, -0.04f}, {0.08f, -0.09f}, {0.0f, -0.10f}}};
    builder.lathe(site.of.iron, {at.x, y, at.z}, kCap, 12);
    builder.lathe(site.of.lamp_warm, {at.x, y, at.z}, kBowl, 12, true);
    if (light) add_lamp(site, "arcade lamp", {at.x, y - 0.25f, at.z}, {5.2f, 3.5f, 2.1f}, 7.5f, 0.22f);
}

}  // namespace

void add_arcade(Site& site) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    Materials under_cover = of;
    under_cover.stone = of.sheltered_stone;
    under_cover.trim = of.sheltered_trim;
    Site inside{builder, under_cover, site.street, site.seed};
    const glm::vec3 to_road(-1.0f, 0.0f, 0.0f);
    for (int bay = 0; bay < kBays; ++bay) {
        builder.place(facing({kFacadeX, 0.0f, kArcadeFar + kBay_m * static_cast<float>(bay)}, to_road));
        add_arch(site);
        add_pier(site);
        add_vault(inside);
        add_hanging_lamp(site, bay % 2 == 0);
    }
    builder.place(facing({kFacadeX, 0.0f, kArcadeNear}, to_road));
    add_pier(site);
    // Shops behind, and the wall over them up into the vaults.
    const float length = kArcadeNear - kArcadeFar;
    builder.place(facing({kArcadeWall, 0.0f, kArcadeFar}, to_road));
    add_ground_floor(inside, length, kArcadeTop_m, site.random(77), false);
    // Its ends: the near one is closed by the next house, the far one opens to the crossing through an arch of its own.
    builder.place(glm::mat4(1.0f));
    builder.quad(under_cover.stone, {kArcadeWall, 0.0f, kArcadeNear}, {kFacadeX - kArcadeWall, 0.0f, 0.0f},
                 {0.0f, kArcadeTop_m, 0.0f});
    builder.place(facing({kFacadeX + kDepth_m, 0.0f, kArcadeFar}, {0.0f, 0.0f, -1.0f}));
    add_ground_floor(site, kFacadeX + kDepth_m - kArcadeWall, kArcadeTop_m, site.random(78), false);
    builder.place(facing({kArcadeWall, 0.0f, kArcadeFar}, {0.0f, 0.0f, -1.0f}));
    builder.quad(of.stone, {0.0f, kSpring_m + kRise_m, 0.0f}, {kArcadeWall - kFacadeX, 0.0f, 0.0f},
                 {0.0f, kArcadeTop_m - kSpring_m - kRise_m, 0.0f});
    builder.place(glm::mat4(1.0f));
    const int columns = 4;
    const int rows = 26;
    const glm::vec3 across((kArcadeWall - kFacadeX) / columns, 0.0f, 0.0f);
    const glm::vec3 along(0.0f, 0.0f, length / rows);
    // Rain blows in between the piers and no farther than a step.
    const auto open = [&](int column) { return column == 0 ? 1.0f : column == 1 ? 0.25f : 0.0f; };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const glm::vec3 corner = glm::vec3(kFacadeX, kPavement_m, kArcadeFar) +
                                     across * static_cast<float>(column) + along * static_cast<float>(row + 1);
            const glm::vec4 outer = water_color(open(column), 0.0f), inner = water_color(open(column + 1), 0.0f);
            builder.colored_patch(of.paving, {corner, corner + across, corner + across - along, corner - along},
                                  {outer, inner, inner, outer});
        }
    }
}

}  // namespace halfframe::content::street
