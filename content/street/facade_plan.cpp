// Draws the tiles of a facade.
#include "content/street/facade_plan.h"

#include "content/street/textures.h"

namespace halfframe::content::street {

namespace {

int draw_window(Random& random) {
    const float of = random.unit();
    const Glow glow = of < 0.47f ? Glow::dark : of < 0.76f ? Glow::warm : of < 0.88f ? Glow::amber : Glow::cool;
    return static_cast<int>(glow) * kWindowsOfAGlow + random.below(kWindowsOfAGlow);
}

Balcony balcony_of(FacadeKind kind, int floor, int floors, Random& random) {
    if (kind == FacadeKind::stone) {
        if (floor == 1 || floor == floors - 1) return Balcony::along;
        return random.chance(0.55f) ? Balcony::small : Balcony::none;
    }
    if (kind == FacadeKind::plaster) return random.chance(0.35f) ? Balcony::small : Balcony::none;
    return random.chance(0.15f) ? Balcony::small : Balcony::none;
}

Shutters shutters_of(FacadeKind kind, Random& random) {
    if (kind == FacadeKind::brick) return Shutters::none;
    return static_cast<Shutters>(random.below(4));
}

Growth growth_of(FacadeKind kind, Random& random) {
    const float most = kind == FacadeKind::stone ? 0.30f : kind == FacadeKind::brick ? 0.42f : 0.55f;
    if (!random.chance(most)) return Growth::none;
    return static_cast<Growth>(1 + random.below(6));
}

/// Alike to somebody who walks past: the same window, or nothing but the light behind it different.
bool alike(const FacadeTile& a, const FacadeTile& b) {
    if (a.window == b.window) return true;
    return a.shutters == b.shutters && a.growth == b.growth && a.balcony == b.balcony &&
           a.window / kWindowsOfAGlow == b.window / kWindowsOfAGlow;
}

}  // namespace

FacadePlan plan_facade(FacadeKind kind, int columns, int floors, Random random) {
    FacadePlan plan{kind, columns, floors, {}};
    for (int floor = 0; floor < floors; ++floor) {
        for (int column = 0; column < columns; ++column) {
            FacadeTile tile;
            tile.balcony = balcony_of(kind, floor, floors, random);
            const auto repeats = [&] {
                return (column > 0 && alike(tile, plan.at(column - 1, floor))) ||
                       (floor > 0 && alike(tile, plan.at(column, floor - 1)));
            };
            // Ends: of 16 windows at most 8 are alike to a neighbour's.
            do {
                tile.window = draw_window(random);
                tile.shutters = shutters_of(kind, random);
                tile.growth = growth_of(kind, random);
                if (tile.shutters == Shutters::closed) tile.growth = Growth::none;
            } while (repeats());
            plan.tiles.push_back(tile);
        }
    }
    return plan;
}

}  // namespace halfframe::content::street
