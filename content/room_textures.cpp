// Floor tiles and a grille.
#include "content/room_textures.h"

#include <algorithm>
#include <cmath>

#include "content/noise.h"

namespace halfframe::content {
namespace {

Image square(const char* name, int size, bool srgb) { return blank(name, size, size, srgb); }

/// Height of the tiled floor at a texel, 0 in the joints, 1 on the tiles, with a bevel between; repeats.
float tile_height(int x, int y, int size) {
    const int tile = size / 2;
    const auto from_joint = [&](int at) {
        const int inside = ((at % tile) + tile) % tile;
        return std::min(inside, tile - 1 - inside);
    };
    const float joint = static_cast<float>(size) / 128.0f;
    const float bevel = static_cast<float>(size) / 64.0f;
    const float nearest = static_cast<float>(std::min(from_joint(x), from_joint(y)));
    return std::clamp((nearest - joint) / bevel, 0.0f, 1.0f);
}

}  // namespace

TileImages floor_tiles(int size) {
    TileImages images{square("floor base colour", size, true), square("floor normal", size, false),
                      square("floor metallic roughness", size, false)};
    const int tile = size / 2;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float height = tile_height(x, y, size);
            const float of_tile = hash_noise(x / tile + 17, y / tile + 31);
            const float grain = hash_noise(x, y) - 0.5f;
            // Albedo in sRGB, blue-grey and inside the talk's range of 32..243.
            const float value = height > 0.5f ? 0.43f + 0.08f * of_tile + 0.03f * grain : 0.22f + 0.04f * grain;
            set_texel(images.base_color, x, y, 255.0f * value * glm::vec3(0.92f, 0.98f, 1.10f));
            // Slope of the bevel, +Y up in the picture: y counts downwards.
            const float slope_x = tile_height(x - 1, y, size) - tile_height(x + 1, y, size);
            const float slope_y = tile_height(x, y + 1, size) - tile_height(x, y - 1, size);
            const float length = std::sqrt(slope_x * slope_x + slope_y * slope_y + 1.0f);
            set_texel(images.normal, x, y, 127.5f + 127.5f * glm::vec3(slope_x, slope_y, 1.0f) / length);
            const float roughness = height > 0.5f ? 0.28f + 0.12f * of_tile + 0.06f * grain : 0.9f;
            set_texel(images.metallic_roughness, x, y, 255.0f * glm::vec3(1.0f, roughness, 0.0f));
        }
    }
    return images;
}

Image grille(int size, int holes) {
    Image image = square("grille", size, true);
    const int cell = size / holes;
    const int bar = std::max(cell / 5, 1);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const int nearest = std::min({x % cell, y % cell, cell - 1 - x % cell, cell - 1 - y % cell});
            const float alpha = nearest < bar ? 1.0f : nearest == bar ? 0.5f : 0.0f;
            const float value = 0.40f + 0.05f * (hash_noise(x, y) - 0.5f);
            set_texel(image, x, y, 255.0f * value * glm::vec3(1.0f, 1.0f, 1.08f), alpha);
        }
    }
    return image;
}

}  // namespace halfframe::content
