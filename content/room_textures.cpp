// Floor tiles and a grille.
#include "content/room_textures.h"

#include <algorithm>
#include <cmath>

namespace halfframe::content {
namespace {

/// A well-mixed 32-bit number from two small ones (multiply and shift, constants of the PCG family).
std::uint32_t hash(std::uint32_t x, std::uint32_t y) {
    std::uint32_t state = (x * 747796405u + y * 2891336453u) + 277803737u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (state >> 22u) ^ state;
}

/// 0..1
float noise(int x, int y) {
    return static_cast<float>(hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) >> 8u) / 16777215.0f;
}

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

Image blank(const char* name, int size, bool srgb) {
    Image image;
    image.name = name;
    image.width = size;
    image.height = size;
    image.srgb = srgb;
    image.rgba.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4, 255);
    return image;
}

void set_texel(Image& image, int x, int y, float red, float green, float blue, float alpha = 1.0f) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    image.rgba[at + 0] = byte_of(red);
    image.rgba[at + 1] = byte_of(green);
    image.rgba[at + 2] = byte_of(blue);
    image.rgba[at + 3] = byte_of(alpha);
}

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
    TileImages images{blank("floor base colour", size, true), blank("floor normal", size, false),
                      blank("floor metallic roughness", size, false)};
    const int tile = size / 2;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float height = tile_height(x, y, size);
            const float of_tile = noise(x / tile + 17, y / tile + 31);
            const float grain = noise(x, y) - 0.5f;
            // Albedo in sRGB, blue-grey and inside the talk's range of 32..243.
            const float value = height > 0.5f ? 0.43f + 0.08f * of_tile + 0.03f * grain : 0.22f + 0.04f * grain;
            set_texel(images.base_color, x, y, 0.92f * value, 0.98f * value, 1.10f * value);
            // Slope of the bevel, +Y up in the picture: y counts downwards.
            const float slope_x = tile_height(x - 1, y, size) - tile_height(x + 1, y, size);
            const float slope_y = tile_height(x, y + 1, size) - tile_height(x, y - 1, size);
            const float length = std::sqrt(slope_x * slope_x + slope_y * slope_y + 1.0f);
            set_texel(images.normal, x, y, 0.5f + 0.5f * slope_x / length, 0.5f + 0.5f * slope_y / length,
                      0.5f + 0.5f / length);
            const float roughness = height > 0.5f ? 0.28f + 0.12f * of_tile + 0.06f * grain : 0.9f;
            set_texel(images.metallic_roughness, x, y, 1.0f, roughness, 0.0f);
        }
    }
    return images;
}

Image grille(int size, int holes) {
    Image image = blank("grille", size, true);
    const int cell = size / holes;
    const int bar = std::max(cell / 5, 1);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const int nearest = std::min({x % cell, y % cell, cell - 1 - x % cell, cell - 1 - y % cell});
            const float alpha = nearest < bar ? 1.0f : nearest == bar ? 0.5f : 0.0f;
            const float value = 0.40f + 0.05f * (noise(x, y) - 0.5f);
            set_texel(image, x, y, value, value, 1.08f * value, alpha);
        }
    }
    return image;
}

}  // namespace halfframe::content
