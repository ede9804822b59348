// Rows of spheres from rough to smooth, lit by an environment alone: what a material reflects, and what a level of the
// cube looks like. --environment puts other surroundings round them.
#include <array>

#include <glm/gtc/matrix_transform.hpp>

#include "content/built_in.h"
#include "content/content.h"
#include "content/shapes.h"

namespace halfframe::content {
namespace {

constexpr int kColumns = 7;
constexpr float kSpacing_m = 1.15f;

struct Row {
    const char* name;
    glm::vec3 base_color;  ///< linear
    float metallic;
};
/// Metals: sRGB 186..255 and no albedo, as the talk's chart has them. Dielectrics: albedo sRGB 32..243.
constexpr std::array kRows = {Row{"silver", {0.95f, 0.93f, 0.88f}, 1.0f}, Row{"copper", {0.93f, 0.53f, 0.40f}, 1.0f},
                              Row{"blue paint", {0.05f, 0.11f, 0.30f}, 0.0f},
                              Row{"white plaster", {0.72f, 0.70f, 0.67f}, 0.0f}};

}  // namespace

Scene make_spheres() {
    Scene scene;
    scene.name = "spheres";
    const int ball = add_mesh(scene, sphere(0.5f, 64, 32), "sphere");
    for (std::size_t row = 0; row < kRows.size(); ++row) {
        for (int column = 0; column < kColumns; ++column) {
            Material material;
            material.name = std::string(kRows[row].name) + " " + std::to_string(column);
            material.base_color = glm::vec4(kRows[row].base_color, 1.0f);
            material.metallic = kRows[row].metallic;
            material.roughness = 1.0f - static_cast<float>(column) / (kColumns - 1);
            const glm::vec3 at((static_cast<float>(column) - 0.5f * (kColumns - 1)) * kSpacing_m,
                               (0.5f * (kRows.size() - 1) - static_cast<float>(row)) * kSpacing_m, 0.0f);
            add_surface(scene, material.name, ball, add_material(scene, material), glm::translate(glm::mat4(1.0f), at));
        }
    }
    scene.environment = environment("studio", {.size = 64}).map;
    scene.background = glm::vec3(0.16f, 0.165f, 0.175f);
    Camera camera = camera_looking({0.0f, 0.0f, 11.0f}, glm::vec3(0.0f), 0.46f, world_box(scene));
    camera.name = "front";
    scene.cameras.push_back(camera);
    return scene;
}

}  // namespace halfframe::content
