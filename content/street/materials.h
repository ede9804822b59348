// What the street is made of: materials by name, as indices.
#pragma once

#include "content/street/builder.h"

namespace halfframe::content::street {

struct Materials {
    // Walls and ground.
    int stone = -1, trim = -1, brick = -1, plaster = -1, panels = -1, zinc = -1, wood = -1;
    int sheltered_stone = -1, sheltered_trim = -1;  ///< as stone and trim, where no rain falls
    int asphalt = -1, cobbles = -1, paving = -1;    ///< alpha of their vertices: shelter and puddles (vertex_water())
    int kerb = -1, paint = -1;
    // Openings.
    int window = -1, shop_window = -1, glass = -1, railing = -1, shutter_blue = -1, shutter_grey = -1, door = -1;
    // Things.
    int iron = -1, steel = -1, copper = -1, rubber = -1, leaves = -1, soil = -1;
    int cloth_red = -1, cloth_blue = -1, cloth_purple = -1;
    int lacquer_red = -1, lacquer_blue = -1, lacquer_pale = -1;
    // What shines by itself.
    int signs_across = -1, signs_down = -1, skyline = -1;
    int lamp_warm = -1, lamp_cool = -1, glow_red = -1, glow_blue = -1, glow_purple = -1, glow_cyan = -1;
    // What blends.
    int hologram_cyan = -1, hologram_red = -1, hologram_purple = -1;
    int haze = -1;       ///< colours: its alpha
    int warm_beam = -1;  ///< colours: its alpha
    int cool_beam = -1;
};

[[nodiscard]] Materials add_materials(Builder& builder, std::uint32_t seed);

}  // namespace halfframe::content::street
