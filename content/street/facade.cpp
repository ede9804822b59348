// Walls, windows and shutters.
#include "content/street/facade.h"

#include "content/street/textures.h"

namespace halfframe::content::street {

namespace {

struct Opening {
    float left, right, bottom, top;
};

Opening opening_of(FacadeKind kind, float x0, float x1, float y0, float floor_m, int floor, int floors) {
    const float middle = 0.5f * (x0 + x1);
    if (kind == FacadeKind::brick) {
        const float half = std::min(0.36f * (x1 - x0), 1.05f);
        return {middle - half, middle + half, y0 + 0.85f, y0 + floor_m - 0.55f};
    }
    if (kind == FacadeKind::plaster) return {middle - 0.55f, middle + 0.55f, y0 + 0.75f, y0 + floor_m - 0.65f};
    // Haussmann's windows reach the floor and grow lower upwards.
    const float lower = floors > 1 ? 0.35f * static_cast<float>(floor) / static_cast<float>(floors - 1) : 0.0f;
    return {middle - 0.58f, middle + 0.58f, y0 + 0.22f, y0 + floor_m - 0.62f - lower};
}

/// A wall with a hole: nine cells but the middle one, so that neighbours share corners and nothing shines through.
void wall_round(Builder& builder, int wall, float x0, float x1, float y0, float y1, const Opening& hole) {
    const float xs[4] = {x0, hole.left, hole.right, x1};
    const float ys[4] = {y0, hole.bottom, hole.top, y1};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            if (row == 1 && column == 1) continue;
            builder.quad(wall, {xs[column], ys[row], 0.0f}, {xs[column + 1] - xs[column], 0.0f, 0.0f},
                         {0.0f, ys[row + 1] - ys[row], 0.0f});
        }
    }
}

void window_in(Builder& builder, const Materials& of, int wall, const Opening& hole, int window) {
    const float width = hole.right - hole.left;
    const float height = hole.top - hole.bottom;
    const glm::vec3 in(0.0f, 0.0f, -kReveal_m);
    const glm::vec3 up(0.0f, height, 0.0f);
    const glm::vec3 across(width, 0.0f, 0.0f);
    builder.quad(wall, glm::vec3(hole.left, hole.bottom, 0.0f), in, up);
    builder.quad(wall, glm::vec3(hole.right, hole.bottom, -kReveal_m), -in, up);
    builder.quad(wall, glm::vec3(hole.left, hole.bottom, 0.0f), across, in);
    builder.quad(wall, glm::vec3(hole.left, hole.top, -kReveal_m), across, -in);
    // Half a texel in from the borders of its square, so that neighbours do not bleed in.
    const glm::vec2 size(1.0f / kWindowColumns);
    const glm::vec2 low = size * glm::vec2(window % kWindowColumns, window / kWindowColumns);
    const glm::vec2 air(1.0f / 512.0f);
    builder.picture(of.window, glm::vec3(hole.left, hole.bottom, -kReveal_m), across, up, low + air, low + size - air);
}

void shutters_beside(Builder& builder, int material, const Opening& hole, Shutters shutters) {
    if (shutters == Shutters::none) return;
    const float leaf = 0.5f * (hole.right - hole.left);
    constexpr float kThick = 0.045f;
    constexpr float kOff = 0.012f;  // of the wall: in its plane the two would fight
    const auto leaf_at = [&](float x, float z) {
        builder.box(material, {x, hole.bottom + 0.02f, z}, {x + leaf, hole.top - 0.02f, z + kThick}, kNotBack);
    };
    const bool left_closed = shutters == Shutters::closed;
    const bool right_closed = shutters != Shutters::open;
    leaf_at(left_closed ? hole.left + 0.004f : hole.left - leaf - 0.03f, left_closed ? -0.14f : kOff);
    leaf_at(right_closed ? hole.right - leaf - 0.004f : hole.right + 0.03f, right_closed ? -0.14f : kOff);
}

void stone_trim(Builder& builder, const Materials& of, const Opening& hole) {
    // Architrave, and a hood on two consoles.
    builder.box(of.trim, {hole.left - 0.16f, hole.top + 0.06f, 0.0f}, {hole.right + 0.16f, hole.top + 0.22f, 0.07f},
                kNotBack);
    builder.box(of.trim, {hole.left - 0.26f, hole.top + 0.22f, 0.0f}, {hole.right + 0.26f, hole.top + 0.32f, 0.20f},
                kNotBack);
}

struct TileBox {
    float x0, x1, y0, y1;
};

void build_tile(Builder& builder, const Materials& of, const FacadePlan& plan, int column, int floor,
                const TileBox& box, bool fine, Random& random) {
    const FacadeTile& tile = plan.at(column, floor);
    const Opening hole = opening_of(plan.kind, box.x0, box.x1, box.y0, box.y1 - box.y0, floor, plan.floors);
    const int wall = plan.kind == FacadeKind::stone ? of.stone : plan.kind == FacadeKind::brick ? of.brick : of.plaster;
    wall_round(builder, wall, box.x0, box.x1, box.y0, box.y1, hole);
    window_in(builder, of, wall, hole, tile.window);
    shutters_beside(builder, plan.kind == FacadeKind::stone ? of.shutter_grey : of.shutter_blue, hole, tile.shutters);
    if (plan.kind == FacadeKind::stone && fine) stone_trim(builder, of, hole);
    if (plan.kind != FacadeKind::stone) {
        const int sill = plan.kind == FacadeKind::brick ? of.trim : of.panels;
        builder.box(sill, {hole.left - 0.10f, hole.bottom - 0.12f, 0.0f}, {hole.right + 0.10f, hole.bottom, 0.14f},
                    kNotBack);
        if (fine)
            builder.box(sill, {hole.left - 0.10f, hole.top, 0.0f}, {hole.right + 0.10f, hole.top + 0.16f, 0.06f},
                        kNotBack);
    }
    if (tile.balcony == Balcony::small)
        build_balcony(builder, of, hole.left - 0.20f, hole.right + 0.20f, hole.bottom - 0.02f, 0.45f, true, true);
    if (tile.balcony == Balcony::along)
        build_balcony(builder, of, box.x0, box.x1, hole.bottom - 0.02f, 0.75f, column == 0, column == plan.columns - 1);
    if (fine && tile.balcony != Balcony::along)
        build_growth(builder, of, tile.growth, hole.right + 0.08f, box.x1 - 0.06f, hole.bottom, random);
}

}  // namespace

void build_facade(Builder& builder, const Materials& of, const FacadePlan& plan, const FacadePlace& place,
                  Random random) {
    const float bay = place.width_m / static_cast<float>(plan.columns);
    const auto x_of = [&](int column) { return bay * static_cast<float>(column); };
    const auto y_of = [&](int floor) { return place.foot_m + place.floor_m * static_cast<float>(floor); };
    for (int floor = 0; floor < plan.floors; ++floor) {
        for (int column = 0; column < plan.columns; ++column) {
            build_tile(builder, of, plan, column, floor, {x_of(column), x_of(column + 1), y_of(floor), y_of(floor + 1)},
                       place.fine, random);
        }
        // A string course under each floor.
        const float y = y_of(floor);
        if (plan.kind == FacadeKind::stone)
            builder.box(of.trim, {0.0f, y - 0.14f, 0.0f}, {place.width_m, y + 0.06f, 0.12f}, kNotBack);
        else if (floor == 0)
            builder.box(of.panels, {0.0f, y - 0.18f, 0.0f}, {place.width_m, y + 0.10f, 0.16f}, kNotBack);
    }
}

}  // namespace halfframe::content::street
