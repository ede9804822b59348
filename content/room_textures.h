// Procedural images of the test room. Same bits on every machine: integers, square roots and divisions only.
#pragma once

#include "engine/frame/scene.h"

namespace halfframe::content {

/// Two by two floor tiles with joints, one picture for each texture slot.
struct TileImages {
    Image base_color;
    Image normal;
    Image metallic_roughness;
};
[[nodiscard]] TileImages floor_tiles(int size);

/// A grille of square holes: alpha 0 in the holes, 1 on the bars, with a step of one texel between.
[[nodiscard]] Image grille(int size, int holes);

}  // namespace halfframe::content
