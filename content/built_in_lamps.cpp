// The lamps: four panels from smooth to rough, and in front of each a shining sphere above a point of the same light.
//
// What to read off: a sphere's highlight is a wide soft disc where the panel is smooth, the point's a small spot; where
// the panel is rough the two are alike. The lower row is what the upper would be with a radius of 0.
#include "content/built_in.h"

#include <array>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "content/plain_materials.h"
#include "content/shapes.h"

namespace halfframe::content {
namespace {

constexpr std::array kRoughness{0.15f, 0.3f, 0.45f, 0.7f};
constexpr float kPanel_m = 2.0f;     // width and half the height of a panel
constexpr float kDistance_m = 1.0f;  // of the lamps' centres from the panels
constexpr float kRadius_m = 0.5f;
constexpr float kHeight_m = 1.0f;     // of the upper row over the middle; the lower hangs as far under it
constexpr float kCellSize_m = 0.25f;  // the low tier lights by vertex

/// Dark lacquer: what is seen is the highlight.
Material lacquer(float roughness) {
    return dielectric(fmt::format("roughness {:.2f}", roughness), {0.05f, 0.055f, 0.07f}, roughness);
}

}  // namespace

Scene make_lamps() {
    Scene scene;
    scene.name = "lamps";
    const int panel = add_mesh(scene, quad({kPanel_m, 2.0f * kPanel_m}, glm::vec2(1.0f), kCellSize_m), "panel");
    for (std::size_t i = 0; i < kRoughness.size(); ++i) {
        const float x = (static_cast<float>(i) - 1.5f) * kPanel_m;
        const int material = add_material(scene, lacquer(kRoughness[i]));
        add_surface(scene, scene.materials.back().name, panel, material,
                    glm::translate(glm::mat4(1.0f), {x, 0.0f, 0.0f}));
        for (const float side : {1.0f, -1.0f}) {
            scene.lights.push_back({.kind = LightKind::point,
                                    .name = side > 0.0f ? "sphere" : "point",
                                    .color = glm::vec3(1.5f, 1.4f, 1.2f),
                                    .position = {x, side * kHeight_m, kDistance_m},
                                    .range_m = 2.2f,  // further, and every panel would be lit by all eight
                                    .radius_m = side > 0.0f ? kRadius_m : 0.0f});
        }
    }
    scene.ambient = glm::vec3(0.02f);
    // From far away, so that every panel mirrors its own lamp at nearly the same angle.
    Camera camera = camera_looking({0.0f, 0.0f, 14.0f}, glm::vec3(0.0f), 0.31f, world_box(scene));
    camera.name = "front";
    scene.cameras.push_back(camera);
    return scene;
}

}  // namespace halfframe::content
