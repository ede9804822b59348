// Puts the memory room together: materials, floor, air, cameras.
#include "content/memory_room/memory_room.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "content/built_in.h"
#include "content/noise.h"
#include "content/plain_materials.h"
#include "content/shapes.h"

namespace halfframe::content {

namespace memory_room {

namespace {

Material glass_of(const char* name, const glm::vec3& albedo, const glm::vec3& radiance, float alpha) {
    Material material = blended(shining(name, radiance, albedo), alpha);
    material.roughness = 0.25f;
    return material;
}

/// What is remembered: contour lines, as a mind draws them that has nearly forgotten.
Image remembered(std::uint32_t seed) {
    constexpr int kSize = 256;
    Image image = blank("remembered", kSize, kSize, true);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / kSize;
            const float v = (static_cast<float>(y) + 0.5f) / kSize;
            const float hill = layered_noise(u, v, 3, 4, seed);
            const float level = hill * 9.0f - std::floor(hill * 9.0f);
            const float line = 1.0f - smooth_step(0.03f, 0.10f, std::min(level, 1.0f - level));
            const float fade = smooth_step(0.0f, 0.16f, std::min({u, 1.0f - u, v, 1.0f - v}));
            set_texel(image, x, y, glm::vec3(255.0f), fade * (0.16f + 0.84f * line));
        }
    }
    return image;
}

Glass add_glass(Scene& scene, std::uint32_t seed) {
    Glass glass;
    glass.clear = add_material(scene, glass_of("clear glass", {0.55f, 0.75f, 0.82f}, {0.10f, 0.34f, 0.40f}, 0.26f));
    glass.milky = add_material(scene, glass_of("milky glass", {0.80f, 0.86f, 0.90f}, {0.75f, 0.90f, 0.95f}, 0.42f));
    glass.edge = add_material(scene, glass_of("edge", {0.30f, 0.40f, 0.45f}, {0.9f, 2.3f, 2.7f}, 0.85f));
    glass.line = add_material(scene, glass_of("line", {0.10f, 0.12f, 0.13f}, {2.6f, 4.2f, 4.6f}, 0.95f));
    Material picture = glass_of("picture", {0.10f, 0.14f, 0.16f}, {0.25f, 1.3f, 1.7f}, 0.80f);
    picture.base_color_texture.image = add_image(scene, remembered(seed + 5u));
    picture.base_color_texture.wrap_u = picture.base_color_texture.wrap_v = Wrap::clamp;
    glass.picture = add_material(scene, picture);
    Material veil = glass_of("veil", glm::vec3(0.0f), {0.70f, 0.82f, 0.87f}, 0.22f);
    glass.veil = add_material(scene, veil);
    Material shaft = glass_of("shaft", glm::vec3(0.0f), {1.60f, 1.95f, 2.05f}, 0.34f);
    glass.shaft = add_material(scene, shaft);
    return glass;
}

/// A strip of small cells whose alpha is strongest at `peak` of its height, 0 at its sides, its top and its foot.
Mesh faded(const glm::vec2& size_m, float peak) {
    Mesh mesh = quad(size_m, glm::vec2(1.0f), std::clamp(std::min(size_m.x, size_m.y) / 8.0f, 0.4f, 1.2f));
    for (const glm::vec3& at : mesh.positions) {
        const float across = 2.0f * at.x / size_m.x;
        const float up = 0.5f + at.y / size_m.y;
        const float along = up < peak ? up / peak : (1.0f - up) / (1.0f - peak);
        mesh.colors.emplace_back(1.0f, 1.0f, 1.0f, std::max(0.0f, along * (1.0f - across * across)));
    }
    return mesh;
}

void add_floor(Scene& scene) {
    Material floor;
    floor.name = "floor";
    floor.base_color = glm::vec4(0.30f, 0.38f, 0.43f, 1.0f);
    floor.metallic = 0.0f;
    floor.roughness = 0.28f;
    const glm::mat4 lying = glm::rotate(glm::mat4(1.0f), -glm::half_pi<float>(), {1.0f, 0.0f, 0.0f});
    const int material = add_material(scene, floor);
    const int slab = add_mesh(scene, box({2.3f, 0.10f, 1.30f}), "slab");
    for (int i = 0; i < 20; ++i) {
        const auto at = static_cast<float>(i);
        add_surface(scene, "slab " + std::to_string(i), slab, material,
                    glm::translate(glm::mat4(1.0f), {0.12f * std::sin(at * 1.7f),
                                                     -0.05f - 0.03f * static_cast<float>(i % 3), 1.5f - 1.42f * at}));
    }
    Material ground = floor;
    ground.name = "ground";
    ground.base_color = glm::vec4(0.62f, 0.70f, 0.74f, 1.0f);
    ground.roughness = 0.5f;
    add_surface(scene, "ground", add_mesh(scene, quad({70.0f, 70.0f}, glm::vec2(1.0f), 3.5f), "ground"),
                add_material(scene, ground), glm::translate(glm::mat4(1.0f), {0.0f, -1.2f, -16.0f}) * lying);
}

void add_lamp(Scene& scene, const glm::vec3& at, const glm::vec3& color, float range_m) {
    Light light;
    light.name = "memory";
    light.position = at;
    light.color = color;
    light.range_m = range_m;
    light.radius_m = 0.3f;
    scene.lights.push_back(light);
}

void add_camera(Scene& scene, const char* name, const glm::vec3& eye, const glm::vec3& target, float fov_y_rad) {
    Camera camera = camera_looking(eye, target, fov_y_rad, world_box(scene));
    camera.name = name;
    camera.near_m = 0.10f;
    camera.far_m = 90.0f;
    scene.cameras.push_back(camera);
}

}  // namespace

void add_air(Scene& scene, const Glass& glass, std::uint32_t seed) {
    Random random(seed, 3);
    for (int i = 0; i < 9; ++i) {
        const float z = -2.5f - 3.1f * static_cast<float>(i);
        const std::string name = "veil " + std::to_string(i);
        add_surface(scene, name, add_mesh(scene, faded({44.0f, 9.0f}, 0.34f), name), glass.veil,
                    glm::translate(glm::mat4(1.0f), {0.0f, 3.3f, z}));
    }
    for (int i = 0; i < 10; ++i) {
        const float z = -2.0f - 2.6f * static_cast<float>(i) - random.unit();
        const float x = (i % 2 == 0 ? 1.0f : -1.0f) * random.between(1.5f, 5.0f);
        const std::string name = "shaft " + std::to_string(i);
        const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1.0f), {x, 3.8f, z}),
                                            random.between(-0.18f, 0.18f), glm::vec3(0.0f, 0.0f, 1.0f));
        add_surface(scene, name, add_mesh(scene, faded({random.between(0.4f, 1.6f), 9.6f}, 0.62f), name), glass.shaft,
                    place);
    }
    for (int i = 0; i < 16; ++i) {
        const std::string name = "thread " + std::to_string(i);
        const glm::vec3 at(random.between(-5.0f, 5.0f), random.between(0.2f, 5.0f), -random.between(2.0f, 26.0f));
        const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1.0f), at), random.between(-0.12f, 0.12f),
                                            glm::vec3(0.0f, 0.0f, 1.0f));
        add_surface(scene, name, add_mesh(scene, quad({random.between(1.5f, 5.0f), 0.028f}), name), glass.line, place);
    }
}

Scene build(std::uint32_t seed) {
    Scene scene;
    scene.name = "memory_room";
    add_floor(scene);
    const Glass glass = add_glass(scene, seed);
    add_shards(scene, glass, seed);
    add_frames(scene, glass, seed);
    add_air(scene, glass, seed);
    Light above;
    above.kind = LightKind::sun;
    above.name = "above";
    above.direction = glm::normalize(glm::vec3(0.25f, -0.9f, -0.35f));
    above.color = glm::vec3(0.46f, 0.53f, 0.56f);
    scene.lights.push_back(above);
    for (int i = 0; i < 6; ++i)
        add_lamp(scene, {i % 2 == 0 ? -1.6f : 1.6f, 2.1f, -3.0f - 4.5f * static_cast<float>(i)}, {0.55f, 0.95f, 1.10f},
                 6.0f);
    scene.ambient = {0.26f, 0.30f, 0.325f};
    scene.sky = Sky{{0.66f, 0.735f, 0.775f}, {0.865f, 0.895f, 0.905f}, {0.70f, 0.75f, 0.78f}};
    scene.background = scene.sky->horizon;
    scene.bloom = Bloom{0.45f};
    add_camera(scene, "path", {0.15f, 1.6f, 2.6f}, {0.0f, 1.75f, -12.0f}, 0.95f);
    add_camera(scene, "shards", {-3.6f, 0.9f, -1.0f}, {1.6f, 2.3f, -11.0f}, 0.85f);
    return scene;
}

}  // namespace memory_room

Scene make_memory_room(std::uint32_t seed) { return memory_room::build(seed); }

}  // namespace halfframe::content
