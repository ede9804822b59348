// What stands where on a facade, before any geometry: a grid of tiles, no two alike side by side or one over the other.
#pragma once

#include <vector>

#include "content/random.h"

namespace halfframe::content::street {

enum class FacadeKind : std::uint8_t {
    stone,    ///< Haussmann's: ashlar, cornices, iron balconies on the second and the top floor, zinc roof
    brick,    ///< workshops: wide steel windows, brick arches, ducts and stairs
    plaster,  ///< render, panels and pods that grew on it
};
enum class Shutters : std::uint8_t { none, open, one_open, closed };
enum class Balcony : std::uint8_t { none, small, along };  ///< along: joins that of its neighbours
enum class Growth : std::uint8_t { none, air_conditioner, cable_box, antenna, pod, screen, plants };

struct FacadeTile {
    int window = 0;  ///< kind of window (textures.h)
    Shutters shutters = Shutters::none;
    Balcony balcony = Balcony::none;
    Growth growth = Growth::none;
    bool operator==(const FacadeTile&) const = default;
};

struct FacadePlan {
    FacadeKind kind = FacadeKind::stone;
    int columns = 0;
    int floors = 0;  ///< above the ground floor
    std::vector<FacadeTile> tiles;
    [[nodiscard]] const FacadeTile& at(int column, int floor) const {
        return tiles[static_cast<std::size_t>(floor * columns + column)];
    }
};

/// A tile differs from those left of it and below it in its window, and in one thing more that stands out.
[[nodiscard]] FacadePlan plan_facade(FacadeKind kind, int columns, int floors, Random random);

}  // namespace halfframe::content::street
