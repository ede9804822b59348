// Road, gutters, kerbs, pavements, and where water would stand.
#include <array>
#include <cmath>

#include "content/noise.h"
#include "content/street/site.h"
#include "engine/effects/wet_surface/wet_surface.h"

namespace halfframe::content::street {

namespace {

constexpr float kGutterX = 3.5f;  // setts from here to the kerb
constexpr float kCamber_m = 0.09f;
constexpr float kCell_m = 0.5f;  // of the grid: puddles are drawn by its vertices, and the low tier lights them
constexpr float kKerbWidth_m = 0.18f;

/// A piece of ground, cut into cells; heights and puddles at its vertices.
void add_ground(Site& site, int material, float x0, float x1, float z0, float z1, float cell_m) {
    const int columns = std::max(1, static_cast<int>(std::lround((x1 - x0) / cell_m)));
    const int rows = std::max(1, static_cast<int>(std::lround((z1 - z0) / cell_m)));
    const auto vertex = [&](int column, int row) {
        const float x = x0 + (x1 - x0) * static_cast<float>(column) / static_cast<float>(columns);
        const float z = z0 + (z1 - z0) * static_cast<float>(row) / static_cast<float>(rows);
        return glm::vec3(x, road_height_m(x), z);
    };
    const auto water = [&](const glm::vec3& at) {
        return water_color(1.0f, puddle_depth_m(at.x, at.z, site.seed));
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::array<glm::vec3, 4> at{vertex(column, row + 1), vertex(column + 1, row + 1),
                                              vertex(column + 1, row), vertex(column, row)};
            site.builder.colored_patch(material, at, {water(at[0]), water(at[1]), water(at[2]), water(at[3])});
        }
    }
}

/// A pavement with a kerb on the sides named, over the rectangle.
void add_pavement(Site& site, float x0, float x1, float z0, float z1, unsigned kerbs) {
    Builder& builder = site.builder;
    constexpr float kTop = kPavement_m + 0.006f;
    constexpr float kFoot = -0.05f;
    const auto kerb = [&](float kx0, float kx1, float kz0, float kz1) {
        // In lengths of two metres with a joint between, so that lamps by vertex have vertices.
        const float length = std::max(kx1 - kx0, kz1 - kz0);
        const int stones = std::max(1, static_cast<int>(std::lround(length / 2.0f)));
        for (int i = 0; i < stones; ++i) {
            const float a = static_cast<float>(i) / static_cast<float>(stones);
            const float b = static_cast<float>(i + 1) / static_cast<float>(stones);
            const bool along_x = kx1 - kx0 > kz1 - kz0;
            const glm::vec3 low(along_x ? kx0 + a * (kx1 - kx0) + 0.008f : kx0, kFoot,
                                along_x ? kz0 : kz0 + a * (kz1 - kz0) + 0.008f);
            const glm::vec3 high(along_x ? kx0 + b * (kx1 - kx0) : kx1, kTop, along_x ? kz1 : kz0 + b * (kz1 - kz0));
            builder.box(site.of.kerb, low, high, kNotBottom);
        }
    };
    if (kerbs & kLeft) kerb(x0, x0 + kKerbWidth_m, z0, z1);
    if (kerbs & kRight) kerb(x1 - kKerbWidth_m, x1, z0, z1);
    if (kerbs & kBack) kerb(x0, x1, z0, z0 + kKerbWidth_m);
    if (kerbs & kFront) kerb(x0, x1, z1 - kKerbWidth_m, z1);
    const int columns = std::max(1, static_cast<int>(std::lround(x1 - x0)));
    const int rows = std::max(1, static_cast<int>(std::lround((z1 - z0) / 1.5f)));
    const glm::vec3 across((x1 - x0) / static_cast<float>(columns), 0.0f, 0.0f);
    const glm::vec3 along(0.0f, 0.0f, (z1 - z0) / static_cast<float>(rows));
    builder.color(water_color(1.0f, 0.0f));
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column)
            builder.quad(site.of.paving,
                         glm::vec3(x0, kPavement_m, z0) + across * static_cast<float>(column) +
                             along * static_cast<float>(row + 1),
                         across, -along);
    }
    builder.color(glm::vec4(1.0f));
}

void add_markings(Site& site) {
    Builder& builder = site.builder;
    // Stripes lie on the cells of the grid, so that they follow the camber to the bit.
    const auto stripe = [&](float x, float z0, float z1) {
        const auto at = [](float px, float z) { return glm::vec3(px, road_height_m(px) + 0.007f, z); };
        builder.patch(site.of.paint, {at(x, z1), at(x + kCell_m, z1), at(x + kCell_m, z0), at(x, z0)});
    };
    for (const float z : {-37.6f, -53.4f}) {
        for (float x = -3.0f; x < 3.0f; x += 1.0f) stripe(x, z - 2.6f, z);
    }
    const auto manhole = [&](float x, float z) {
        constexpr std::array<glm::vec2, 4> kCover{{{0.0f, 0.012f}, {0.27f, 0.012f}, {0.34f, 0.008f}, {0.36f, 0.0f}}};
        builder.lathe(site.of.iron, {x, road_height_m(x), z}, kCover, 20);
        constexpr std::array<glm::vec2, 2> kRing{{{0.0f, 0.017f}, {0.10f, 0.017f}}};
        builder.lathe(site.of.steel, {x, road_height_m(x), z}, kRing, 12);
    };
    manhole(0.9f, 2.6f);
    manhole(-0.8f, -17.0f);
    manhole(0.4f, -45.0f);
    for (float z = 12.0f; z > -90.0f; z -= 11.0f) {
        if (z < kCrossNear + 4.0f && z > kCrossFar - 4.0f) continue;
        for (const float side : {-1.0f, 1.0f}) {
            const float x = side * 3.74f;
            for (int bar = 0; bar < 6; ++bar) {
                const float at = z + 0.09f * static_cast<float>(bar);
                builder.box(site.of.iron, {x - 0.22f, -0.02f, at}, {x + 0.22f, 0.022f, at + 0.05f}, kNotBottom);
            }
        }
    }
}

}  // namespace

glm::vec4 water_color(float open, float depth_m) {
    return {1.0f, 1.0f, 1.0f, vertex_alpha({open, depth_m / kDeepestPuddle_m})};
}

float road_height_m(float x) {
    const float share = std::min(std::abs(x) / kKerbX, 1.0f);
    return kCamber_m * (1.0f - share * share);
}

float puddle_depth_m(float x, float z, std::uint32_t seed) {
    // Hollows a few metres wide; the camber drains the middle into the gutters, where water stands along the kerb.
    const float hollow = smooth_noise(x * 0.45f + 32.0f, z * 0.32f + 64.0f, 4096, seed + 71u);
    const float small = smooth_noise(x * 1.3f + 32.0f, z * 1.1f + 64.0f, 4096, seed + 72u);
    const float gutter = smooth_step(2.9f, 3.9f, std::abs(x)) * (std::abs(x) < kKerbX + 0.1f ? 1.0f : 0.0f);
    const float level = 0.75f * hollow + 0.25f * small + 0.22f * gutter;
    return kDeepestPuddle_m * smooth_step(0.58f, 0.92f, level);
}

void add_road(Site& site) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    builder.place(glm::mat4(1.0f));
    add_ground(site, of.asphalt, -kGutterX, kGutterX, kFarEnd - 3.0f, kNearEnd, kCell_m);
    constexpr float kCrossKerbNear = kCrossNear - 1.5f;
    constexpr float kCrossKerbFar = kCrossFar + 1.5f;
    for (const float side : {-1.0f, 1.0f}) {
        const auto ground = [&](int material, float a, float b, float z0, float z1, float cell) {
            add_ground(site, material, side > 0.0f ? a : -b, side > 0.0f ? b : -a, z0, z1, cell);
        };
        const auto pavement = [&](float a, float b, float z0, float z1, bool toward_road, unsigned across) {
            const unsigned road_side = toward_road ? (side > 0.0f ? kLeft : kRight) : 0u;
            add_pavement(site, side > 0.0f ? a : -b, side > 0.0f ? b : -a, z0, z1, road_side | across);
        };
        ground(of.cobbles, kGutterX, kKerbX, kCrossKerbNear, kNearEnd, kCell_m);
        ground(of.cobbles, kGutterX, kKerbX, kFarEnd - 3.0f, kCrossKerbFar, kCell_m);
        ground(of.asphalt, kGutterX, 14.0f, kCrossKerbFar, kCrossKerbNear, kCell_m);
        ground(of.asphalt, 14.0f, kCrossHalf, kCrossKerbFar, kCrossKerbNear, 1.0f);
        pavement(kKerbX, kFacadeX, kCrossKerbNear, kNearEnd, true, kBack);
        pavement(kKerbX, kFacadeX, kFarEnd - 3.0f, kCrossKerbFar, true, kFront);
        pavement(kFacadeX, kCrossHalf, kCrossKerbNear, kCrossNear, false, kBack);
        pavement(kFacadeX, kCrossHalf, kCrossFar, kCrossKerbFar, false, kFront);
    }
    // The alley: setts at the height of the pavement.
    for (float x = kAlleyEnd; x < -kFacadeX - 0.1f; x += 1.0f) {
        for (float z = kAlleyFar; z < kAlleyNear - 0.1f; z += 1.2f) {
            const auto water = [&](float px, float pz) {
                return water_color(1.0f, puddle_depth_m(px, pz, site.seed));
            };
            builder.colored_patch(of.cobbles,
                                  {glm::vec3(x, kPavement_m, z + 1.2f), glm::vec3(x + 1.0f, kPavement_m, z + 1.2f),
                                   glm::vec3(x + 1.0f, kPavement_m, z), glm::vec3(x, kPavement_m, z)},
                                  {water(x, z + 1.2f), water(x + 1.0f, z + 1.2f), water(x + 1.0f, z), water(x, z)});
        }
    }
    add_markings(site);
}

}  // namespace halfframe::content::street
