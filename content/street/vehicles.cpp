// Parked hover vehicles: a lofted body on a glow, no wheels.
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "content/street/site.h"

namespace halfframe::content::street {

namespace {

/// A cross-section of the body: place along it, half width, floor, shoulder and roof [m].
struct Rib {
    float z, half_width, low, shoulder, roof, roof_half;
};

constexpr std::array<Rib, 8> kRibs{{{2.25f, 0.55f, 0.40f, 0.58f, 0.62f, 0.45f},
                                    {1.95f, 0.80f, 0.30f, 0.72f, 0.80f, 0.66f},
                                    {1.15f, 0.92f, 0.27f, 0.86f, 0.95f, 0.74f},
                                    {0.55f, 0.95f, 0.26f, 0.92f, 1.38f, 0.64f},
                                    {-0.45f, 0.95f, 0.26f, 0.94f, 1.46f, 0.64f},
                                    {-1.35f, 0.94f, 0.27f, 0.95f, 1.20f, 0.64f},
                                    {-2.00f, 0.86f, 0.32f, 0.90f, 0.98f, 0.66f},
                                    {-2.30f, 0.66f, 0.42f, 0.78f, 0.84f, 0.52f}}};

/// From the floor on the right over the roof to the floor on the left.
std::array<glm::vec3, 8> around(const Rib& rib) {
    const float waist = 0.45f * rib.low + 0.55f * rib.shoulder;
    return {glm::vec3(0.72f * rib.half_width, rib.low, rib.z),
            glm::vec3(rib.half_width, waist, rib.z),
            glm::vec3(0.95f * rib.half_width, rib.shoulder, rib.z),
            glm::vec3(rib.roof_half, rib.roof, rib.z),
            glm::vec3(-rib.roof_half, rib.roof, rib.z),
            glm::vec3(-0.95f * rib.half_width, rib.shoulder, rib.z),
            glm::vec3(-rib.half_width, waist, rib.z),
            glm::vec3(-0.72f * rib.half_width, rib.low, rib.z)};
}

void add_vehicle(Site& site, int paint, int glow, bool lit) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    for (std::size_t i = 0; i + 1 < kRibs.size(); ++i) {
        const auto front = around(kRibs[i]);
        const auto back = around(kRibs[i + 1]);
        for (std::size_t k = 0; k + 1 < front.size(); ++k) {
            // Between shoulder and roof stands glass, in the cabin.
            const bool cabin = i >= 2 && i <= 4 && (k == 2 || k == 4);
            const bool screen = (i == 2 || i == 5) && k == 3;
            builder.patch(cabin || screen ? of.rubber : paint, {front[k], back[k], back[k + 1], front[k + 1]});
        }
        builder.patch(of.iron, {front[7], back[7], back[0], front[0]});
    }
    const auto nose = around(kRibs.front());
    const auto tail = around(kRibs.back());
    for (std::size_t k = 1; k + 1 < nose.size(); ++k) {
        builder.triangle(paint, nose[0], nose[k], nose[k + 1]);
        builder.triangle(paint, tail[0], tail[k + 1], tail[k]);
    }
    for (const float side : {-1.0f, 1.0f}) {
        builder.box(lit ? of.lamp_cool : of.steel, {side * 0.55f - 0.16f, 0.60f, 2.02f},
                    {side * 0.55f + 0.16f, 0.66f, 2.22f});
        builder.box(of.glow_red, {side * 0.55f - 0.20f, 0.72f, -2.26f}, {side * 0.55f + 0.20f, 0.77f, -2.16f});
        // Lift rails.
        builder.box(of.iron, {side * 0.62f - 0.16f, 0.16f, -1.7f}, {side * 0.62f + 0.16f, 0.30f, 1.6f});
        builder.box(glow, {side * 0.62f - 0.07f, 0.115f, -1.5f}, {side * 0.62f + 0.07f, 0.16f, 1.4f});
        builder.box(of.steel, {side * 0.955f - 0.012f, 0.78f, -0.5f}, {side * 0.955f + 0.012f, 0.80f, -0.3f});
    }
    if (lit) add_lamp(site, "lift rails", {0.0f, 0.11f, 0.0f}, {0.10f, 0.30f, 0.42f}, 2.6f, 0.05f);
}

}  // namespace

void add_vehicles(Site& site) {
    const Materials& of = site.of;
    const auto parked = [&](float x, float z, const glm::vec3& outward, int paint, bool lit) {
        site.builder.place(facing({x, road_height_m(x), z}, outward));
        add_vehicle(site, paint, of.glow_cyan, lit);
    };
    const glm::vec3 toward(0.0f, 0.0f, 1.0f);
    parked(2.7f, -4.2f, toward, of.lacquer_blue, true);
    parked(2.75f, -20.5f, toward, of.lacquer_red, false);
    parked(-2.75f, -9.0f, -toward, of.lacquer_pale, false);
    parked(-2.7f, -27.0f, -toward, of.lacquer_blue, false);
    parked(2.7f, -60.0f, toward, of.lacquer_pale, true);
    parked(17.0f, -43.0f, {-1.0f, 0.0f, 0.0f}, of.lacquer_red, false);
}

}  // namespace halfframe::content::street
