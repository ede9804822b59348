// The wet yard: a slab with hollows under a canopy's edge, a tiled patch whose joints fill, a wall, and three balls, after
// rain.
//
// What to read off: the slab is dark and shining outside, dry under the canopy; its hollows mirror the lamps. The tiles
// stay above the water and their joints do not. The rough ball and the wall are darker than they were; the lacquered and
// the metal ball are as in dry weather: nothing soaks in.
#include "content/built_in.h"

#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "content/content.h"
#include "content/noise.h"
#include "content/plain_materials.h"
#include "content/shapes.h"
#include "engine/effects/wet_surface/wet_surface.h"

namespace halfframe::content {
namespace {

constexpr float kYard_m = 10.0f;
constexpr float kCell_m = 0.25f;
constexpr float kCanopyX = 2.0f;  ///< it covers what lies beyond
constexpr std::uint32_t kSeed = 5u;
constexpr int kTileTexels = 128;

glm::mat4 at(const glm::vec3& place) { return glm::translate(glm::mat4(1.0f), place); }
glm::mat4 lying() { return glm::rotate(glm::mat4(1.0f), -glm::half_pi<float>(), {1.0f, 0.0f, 0.0f}); }

Mesh slab() {
    Mesh mesh = quad(glm::vec2(kYard_m), glm::vec2(4.0f), kCell_m);
    for (const glm::vec3& position : mesh.positions) {
        const float open = 1.0f - smooth_step(kCanopyX - 0.3f, kCanopyX + 0.5f, position.x);
        const float hollow = smooth_step(
            0.52f, 0.80f, smooth_noise(position.x * 0.6f + 16.0f, position.y * 0.6f + 16.0f, 1024, kSeed));
        mesh.colors.emplace_back(1.0f, 1.0f, 1.0f, vertex_alpha({open, open < 1.0f ? 0.0f : hollow}));
    }
    return mesh;
}

/// Four tiles: R takes water everywhere but on one of them, which is glazed; G is low in the joints.
Image tile_water() {
    Image image = blank("tile water", kTileTexels, kTileTexels, false);
    for (int y = 0; y < kTileTexels; ++y) {
        for (int x = 0; x < kTileTexels; ++x) {
            const auto edge = [](int place) {
                const int in_tile = place % (kTileTexels / 2);
                return static_cast<float>(std::min(in_tile, kTileTexels / 2 - 1 - in_tile));
            };
            const float height = smooth_step(1.0f, 6.0f, std::min(edge(x), edge(y)));
            const bool glazed = x < kTileTexels / 2 && y < kTileTexels / 2 && height > 0.5f;
            set_texel(image, x, y, {glazed ? 0.0f : 255.0f, 255.0f * height, 0.0f});
        }
    }
    return image;
}

Material rained_on(Material material) {
    material.water = WaterMask::everywhere;
    return material;
}

void add_ground(Scene& scene) {
    Material concrete = dielectric("concrete", glm::vec3(0.32f, 0.31f, 0.29f), 0.82f);
    concrete.water = WaterMask::vertex_color;
    add_surface(scene, "slab", add_mesh(scene, slab(), "slab"), add_material(scene, concrete), lying());
    Material tiles = dielectric("tiles", glm::vec3(0.42f, 0.22f, 0.15f), 0.75f);
    tiles.water = WaterMask::texture;
    tiles.water_texture.image = add_image(scene, tile_water());
    add_surface(scene, "tiles", add_mesh(scene, quad(glm::vec2(2.4f), glm::vec2(3.0f), 0.3f), "tiles"),
                add_material(scene, tiles), at({-2.6f, 0.01f, 2.2f}) * lying());
}

}  // namespace

Scene make_wet_yard() {
    Scene scene;
    scene.name = "wet_yard";
    add_ground(scene);
    const int plaster = add_material(scene, rained_on(dielectric("plaster", glm::vec3(0.55f, 0.50f, 0.42f), 0.85f)));
    add_surface(scene, "wall", add_mesh(scene, quad({kYard_m, 2.6f}, glm::vec2(1.0f), 0.5f), "wall"), plaster,
                at({0.0f, 1.3f, -0.5f * kYard_m}));
    const int timber = add_material(scene, dielectric("timber", glm::vec3(0.20f, 0.13f, 0.08f), 0.6f));
    add_surface(scene, "canopy", add_mesh(scene, box({3.2f, 0.12f, 6.0f}), "canopy"), timber,
                at({kCanopyX + 1.6f, 2.5f, -2.0f}));
    const int post = add_mesh(scene, box({0.14f, 2.45f, 0.14f}), "post");
    for (const float z : {-4.7f, 0.7f}) add_surface(scene, "post", post, timber, at({kCanopyX + 0.1f, 1.225f, z}));
    const int ball = add_mesh(scene, sphere(0.45f), "ball");
    const std::array balls{rained_on(dielectric("sandstone", glm::vec3(0.48f, 0.37f, 0.24f), 0.85f)),
                           rained_on(dielectric("lacquer", glm::vec3(0.30f, 0.03f, 0.03f), 0.22f)),
                           rained_on(metal("steel", glm::vec3(0.62f, 0.61f, 0.60f), 0.35f))};
    for (std::size_t i = 0; i < balls.size(); ++i) {
        add_surface(scene, balls[i].name, ball, add_material(scene, balls[i]),
                    at({-3.0f + 1.5f * static_cast<float>(i), 0.45f, -1.6f}));
    }
    const auto lamp = [&](const char* name, const glm::vec3& color, const glm::vec3& place) {
        scene.lights.push_back({.kind = LightKind::point,
                                .name = name,
                                .color = color,
                                .position = place,
                                .range_m = 14.0f,
                                .radius_m = 0.15f});
    };
    lamp("warm lamp", {11.0f, 7.4f, 4.1f}, {-3.6f, 2.3f, -4.0f});
    lamp("cool lamp", {4.2f, 6.4f, 9.5f}, {2.6f, 2.1f, -1.4f});
    lamp("front lamp", {4.5f, 4.3f, 4.0f}, {-2.4f, 2.6f, 2.6f});
    scene.environment = environment("night_sky", {.size = 32}).map;
    scene.background = glm::vec3(0.06f, 0.07f, 0.10f);
    scene.wetness = Wetness{.level = 0.9f};
    scene.puddles = Puddles{.level = 0.85f};
    Camera camera = camera_looking({-1.9f, 1.6f, 4.9f}, {-0.7f, 0.55f, -1.5f}, 0.80f, world_box(scene));
    camera.name = "yard";
    scene.cameras.push_back(camera);
    return scene;
}

}  // namespace halfframe::content
