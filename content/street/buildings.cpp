// Plots along the streets: facades before bodies with roofs.
#include <array>
#include <cmath>

#include "content/street/facade.h"
#include "content/street/site.h"

namespace halfframe::content::street {

namespace {

struct Plot {
    glm::vec3 origin;   ///< lower left corner of its facade, seen from the street
    glm::vec3 outward;  ///< unit, out of its facade
    float width_m;
    FacadeKind kind;
    int floors;
    bool left_facade = false;  ///< its side looks on a street too
    bool right_facade = false;
    bool shops = true;
    bool arcade = false;  ///< its ground floor is the arcade's
    bool fine = true;
};

constexpr float kFloor_m = 3.3f;
constexpr float kMansard_m = 2.8f;

void add_chimneys(Site& site, float x, float top, Random& random) {
    Builder& builder = site.builder;
    const float z = -kDepth_m * 0.5f + random.between(-2.0f, 1.5f);
    const float high = top + 1.1f;
    builder.box(site.of.brick, {x - 0.35f, top - 1.5f, z - 1.2f}, {x + 0.35f, high, z + 1.2f}, kNotBottom);
    builder.box(site.of.trim, {x - 0.42f, high, z - 1.27f}, {x + 0.42f, high + 0.12f, z + 1.27f});
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 pot(x, high + 0.12f, z - 0.9f + 0.6f * static_cast<float>(i));
        builder.bar(site.of.brick, pot, pot + glm::vec3(0.0f, random.between(0.35f, 0.7f), 0.0f), 0.12f, 7, true);
    }
}

void add_dormer(Site& site, float x, float y, float z, Random& random) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    constexpr float kHalf = 0.62f;
    constexpr float kHigh = 1.5f;
    builder.box(of.zinc, {x - kHalf, y, z - 1.3f}, {x + kHalf, y + kHigh, z}, kLeft | kRight | kTop);
    const int kind = random.chance(0.4f) ? 4 + random.below(12) : random.below(4);
    const glm::vec2 low = 0.25f * glm::vec2(kind % 4, kind / 4);
    builder.picture(of.window, {x - kHalf, y, z}, {2.0f * kHalf, 0.0f, 0.0f}, {0.0f, kHigh, 0.0f}, low + 0.002f,
                    low + 0.248f);
    // A small gable over it.
    const glm::vec3 ridge(x, y + kHigh + 0.42f, z + 0.10f);
    const glm::vec3 back(0.0f, 0.0f, -1.4f);
    const glm::vec3 left(x - kHalf - 0.1f, y + kHigh, z + 0.10f);
    const glm::vec3 right(x + kHalf + 0.1f, y + kHigh, z + 0.10f);
    builder.triangle(of.trim, left, right, ridge);
    builder.patch(of.zinc, {right, right + back, ridge + back, ridge});
    builder.patch(of.zinc, {left + back, left, ridge, ridge + back});
}

void add_mansard(Site& site, const Plot& plot, float top, Random& random) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    const float w = plot.width_m;
    const float high = top + kMansard_m;
    const float d = kDepth_m;
    builder.box(of.trim, {0.0f, top - 0.45f, 0.0f}, {w, top - 0.05f, 0.30f}, kNotBack);
    builder.box(of.trim, {0.0f, top - 0.05f, -0.3f}, {w, top + 0.22f, 0.62f}, kAllSides);
    builder.patch(of.zinc, {glm::vec3(0.0f, top, -0.25f), glm::vec3(w, top, -0.25f), glm::vec3(w, high, -1.5f),
                            glm::vec3(0.0f, high, -1.5f)});
    builder.patch(of.zinc, {glm::vec3(w, top, -d), glm::vec3(0.0f, top, -d), glm::vec3(0.0f, high, -d + 1.3f),
                            glm::vec3(w, high, -d + 1.3f)});
    builder.patch(of.zinc, {glm::vec3(0.0f, high, -1.5f), glm::vec3(w, high, -1.5f),
                            glm::vec3(w, high + 0.7f, -0.5f * d), glm::vec3(0.0f, high + 0.7f, -0.5f * d)});
    builder.patch(of.zinc, {glm::vec3(w, high, -d + 1.3f), glm::vec3(0.0f, high, -d + 1.3f),
                            glm::vec3(0.0f, high + 0.7f, -0.5f * d), glm::vec3(w, high + 0.7f, -0.5f * d)});
    for (const bool right : {false, true}) {
        const float x = right ? w : 0.0f;
        std::array<glm::vec3, 4> gable{glm::vec3(x, top, -0.25f), glm::vec3(x, top, -d), glm::vec3(x, high, -d + 1.3f),
                                       glm::vec3(x, high, -1.5f)};
        std::array<glm::vec3, 3> tip{gable[3], gable[2], glm::vec3(x, high + 0.7f, -0.5f * d)};
        if (!right) {
            std::swap(gable[0], gable[1]);
            std::swap(gable[2], gable[3]);
            std::swap(tip[0], tip[1]);
        }
        builder.patch(of.plaster, gable);
        builder.triangle(of.plaster, tip[0], tip[1], tip[2]);
    }
    const int dormers = std::max(2, static_cast<int>(w / 3.2f));
    for (int i = 0; i < dormers; ++i)
        add_dormer(site, w * (static_cast<float>(i) + 0.5f) / static_cast<float>(dormers), top + 0.55f, -0.35f, random);
    add_chimneys(site, 0.5f, high + 0.6f, random);
    if (random.chance(0.6f)) add_chimneys(site, w - 0.5f, high + 0.6f, random);
}

void add_flat_roof(Site& site, const Plot& plot, float top, Random& random) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    const float w = plot.width_m;
    const int wall = plot.kind == FacadeKind::brick ? of.brick : of.panels;
    constexpr float kParapet = 0.9f;
    builder.quad(of.zinc, {0.0f, top, 0.0f}, {w, 0.0f, 0.0f}, {0.0f, 0.0f, -kDepth_m});
    builder.box(wall, {0.0f, top - 0.2f, -0.3f}, {w, top + kParapet, 0.05f});
    builder.box(of.trim, {-0.02f, top + kParapet, -0.36f}, {w + 0.02f, top + kParapet + 0.14f, 0.14f});
    for (const float x : {0.0f, w - 0.3f})
        builder.box(wall, {x, top, -kDepth_m}, {x + 0.3f, top + kParapet, -0.3f}, kNotBottom & ~kFront);
    // A stair head, machines, a tank on legs.
    builder.box(of.panels, {0.30f * w, top, -7.5f}, {0.30f * w + 3.0f, top + 2.6f, -4.5f}, kNotBottom);
    builder.box(of.glow_red, {0.30f * w + 1.2f, top + 2.62f, -5.0f}, {0.30f * w + 1.35f, top + 2.8f, -4.85f});
    for (int i = 0; i < 3; ++i) {
        const float x = random.between(0.08f, 0.85f) * w;
        builder.box(of.panels, {x, top + 0.15f, -3.4f - static_cast<float>(i)},
                    {x + 1.3f, top + 1.1f, -2.6f - static_cast<float>(i)});
    }
    const glm::vec3 tank(0.78f * w, top + 1.6f, -7.0f);
    constexpr std::array<glm::vec2, 4> kTank{{{0.0f, 2.6f}, {1.25f, 2.1f}, {1.25f, 0.0f}, {0.0f, 0.0f}}};
    builder.lathe(of.wood, tank, kTank, 14);
    for (const glm::vec2 leg :
         {glm::vec2(-0.8f, -0.8f), glm::vec2(0.8f, -0.8f), glm::vec2(-0.8f, 0.8f), glm::vec2(0.8f, 0.8f)})
        builder.bar(of.iron, {tank.x + leg.x, top, tank.z + leg.y}, {tank.x + leg.x, tank.y, tank.z + leg.y}, 0.08f, 5);
    // Masts.
    for (int i = 0; i < 2; ++i) {
        const glm::vec3 foot(random.between(0.1f, 0.9f) * w, top, -random.between(2.0f, 6.0f));
        const float high = random.between(3.0f, 6.0f);
        builder.bar(of.iron, foot, foot + glm::vec3(0.0f, high, 0.0f), 0.05f, 5, true);
        for (float y = 0.55f * high; y < high; y += 0.7f)
            builder.bar(of.iron, foot + glm::vec3(-0.5f, y, 0.0f), foot + glm::vec3(0.5f, y, 0.0f), 0.02f, 4, true);
        builder.box(of.glow_red, foot + glm::vec3(-0.07f, high, -0.07f), foot + glm::vec3(0.07f, high + 0.16f, 0.07f));
    }
}

/// One facade of a building in the builder's frame.
void add_face(Site& site, const Plot& plot, float width_m, float foot, Random random, bool pipes) {
    const float bay = plot.kind == FacadeKind::brick ? 3.4f : plot.kind == FacadeKind::stone ? 2.5f : 2.9f;
    const int columns = std::max(1, static_cast<int>(std::lround(width_m / bay)));
    const FacadePlan plan = plan_facade(plot.kind, columns, plot.floors, random.fork(1));
    build_facade(site.builder, site.of, plan, {width_m, foot, kFloor_m, plot.fine}, random.fork(2));
    site.street.facades.push_back(plan);
    Random pipe_random = random.fork(3);
    const float top = foot + kFloor_m * static_cast<float>(plot.floors);
    if (pipes) build_pipes(site.builder, site.of, width_m, foot, top - 0.5f, pipe_random);
}

void add_building(Site& site, const Plot& plot, std::uint32_t key) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    Random random = site.random(1000 + key);
    const glm::mat4 frame = facing(plot.origin, plot.outward);
    const float foot = plot.arcade ? kArcadeTop_m : kShopFloor_m;
    const float top = foot + kFloor_m * static_cast<float>(plot.floors);
    builder.place(frame);
    add_face(site, plot, plot.width_m, foot, random.fork(10), plot.fine && !plot.arcade);
    if (!plot.arcade) add_ground_floor(site, plot.width_m, foot, random.fork(11), plot.shops);
    for (const bool right : {false, true}) {
        builder.place(frame);
        const float x = right ? plot.width_m : 0.0f;
        if (right ? plot.right_facade : plot.left_facade) {
            const glm::vec3 outward = glm::mat3(frame) * glm::vec3(right ? 1.0f : -1.0f, 0.0f, 0.0f);
            const float foot_z = right ? 0.0f : -kDepth_m;
            builder.place(facing(builder.world({x, 0.0f, foot_z}), outward));
            add_face(site, plot, kDepth_m, foot, random.fork(right ? 12 : 13), false);
            if (!plot.arcade) add_ground_floor(site, kDepth_m, foot, random.fork(right ? 14 : 15), false);
        } else {
            const float low = plot.arcade ? foot : 0.0f;  // one walks through under an arcade's floors
            const glm::vec3 up(0.0f, top - low, 0.0f);
            if (right) builder.quad(of.plaster, {x, low, 0.0f}, {0.0f, 0.0f, -kDepth_m}, up);
            else builder.quad(of.plaster, {x, low, -kDepth_m}, {0.0f, 0.0f, kDepth_m}, up);
        }
    }
    builder.place(frame);
    builder.quad(of.plaster, {plot.width_m, 0.0f, -kDepth_m}, {-plot.width_m, 0.0f, 0.0f}, {0.0f, top, 0.0f});
    Random roof = random.fork(16);
    if (plot.kind == FacadeKind::stone) add_mansard(site, plot, top, roof);
    else add_flat_roof(site, plot, top, roof);
}

}  // namespace

void add_buildings(Site& site) {
    using enum FacadeKind;
    const glm::vec3 to_right(1.0f, 0.0f, 0.0f);
    const glm::vec3 to_left(-1.0f, 0.0f, 0.0f);
    const glm::vec3 to_near(0.0f, 0.0f, 1.0f);
    const glm::vec3 to_far(0.0f, 0.0f, -1.0f);
    const float x = kFacadeX;
    // Origins are lower left corners seen from the street: the near end on the left side, the far end on the right.
    const std::vector<Plot> plots{
        {{-x, 0, 20}, to_right, 14, stone, 5},
        {{-x, 0, 6}, to_right, 12, plaster, 4},
        {{-x, 0, -6}, to_right, 14, stone, 5, false, true},
        {{-x, 0, kAlleyFar}, to_right, kAlleyFar - kCrossNear, brick, 4, true, true},
        {{-x, 0, kCrossFar}, to_right, 14, plaster, 5, true, false, false},
        {{-x, 0, -64}, to_right, 16, stone, 5, false, false, false},
        {{-x, 0, -80}, to_right, 16, brick, 4, false, false, false},
        {{x, 0, -2}, to_left, 22, brick, 4},
        {{x, 0, -20}, to_left, 18, stone, 5, false, false, false, true},
        {{x, 0, kCrossNear}, to_left, 20, stone, 4, true, false, false, true},
        {{x, 0, -66}, to_left, 16, stone, 5, false, true, false},
        {{x, 0, -82}, to_left, 16, plaster, 5, false, false, false},
        {{x, 0, kFarEnd}, to_left, 14, stone, 4, false, false, false},
        // The crossing street, and what closes it.
        {{-x - kDepth_m, 0, kCrossNear}, to_far, 16, stone, 4, false, false, true, false, false},
        {{-kCrossHalf + 1, 0, kCrossFar}, to_near, 16, stone, 5, false, false, true, false, false},
        {{kCrossHalf - 1, 0, kCrossNear}, to_far, 16, plaster, 5, false, false, true, false, false},
        {{x + kDepth_m, 0, kCrossFar}, to_near, 16, brick, 4, false, false, true, false, false},
        {{-kCrossHalf, 0, kCrossNear + 1}, to_right, 12, plaster, 6, false, false, true, false, false},
        {{kCrossHalf, 0, kCrossFar - 1}, to_left, 12, stone, 6, false, false, true, false, false},
        // The alley's back.
        {{-x - kDepth_m, 0, kAlleyNear}, to_far, 10.5f, brick, 4, false, false, false, false, true},
        {{kAlleyEnd - 0.5f, 0, kAlleyFar}, to_near, 10.5f, plaster, 4, false, false, false, false, true},
        {{kAlleyEnd, 0, kAlleyNear + 2.0f}, to_right, 7.6f, stone, 5, false, false, false, false, true},
    };
    for (std::size_t i = 0; i < plots.size(); ++i) add_building(site, plots[i], static_cast<std::uint32_t>(i));
}

}  // namespace halfframe::content::street
