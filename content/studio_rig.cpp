// The studio rig: lights for a scene that brings none. content/README.md has the numbers.
#include "content/content.h"

#include <algorithm>
#include <utility>

#include "content/environment/environment_strength.h"

namespace halfframe::content {
namespace {

/// A point light that gives `color` at `distance_m`: c_light is defined at 1 m, and light falls with the square.
Light point_at(const char* name, const glm::vec3& position, const glm::vec3& color, float distance_m, float range_m) {
    Light light;
    light.kind = LightKind::point;
    light.name = name;
    light.position = position;
    light.color = color * distance_m * distance_m;
    light.range_m = range_m;
    return light;
}

}  // namespace

bool add_studio_rig(Scene& scene, std::optional<EnvironmentMap> environment) {
    if (!scene.lights.empty() || scene.ambient != glm::vec3(0.0f) || scene.environment) {
        return false;
    }
    const Box box = world_box(scene);
    const glm::vec3 centre = box.empty() ? glm::vec3(0.0f) : 0.5f * (box.low + box.high);
    // A box without size (one point) still gets lights that are not inside it.
    const float radius_m = box.empty() ? 1.0f : std::max(0.5f * glm::length(box.high - box.low), 1e-3f);

    Light sun;
    sun.kind = LightKind::sun;
    sun.name = "studio sun";
    sun.color = glm::vec3(0.50f, 0.48f, 0.455f);
    sun.direction = glm::normalize(glm::vec3(-0.45f, -0.75f, -0.50f));
    scene.lights.push_back(sun);

    const float away_m = 2.0f * radius_m;
    const glm::vec3 left = glm::normalize(glm::vec3(-0.85f, 0.25f, 0.45f));
    const glm::vec3 behind = glm::normalize(glm::vec3(0.55f, 0.45f, -0.70f));
    scene.lights.push_back(
        point_at("studio fill", centre + left * away_m, glm::vec3(0.12f, 0.15f, 0.20f), away_m, 4.0f * away_m));
    scene.lights.push_back(
        point_at("studio rim", centre + behind * away_m, glm::vec3(0.20f, 0.15f, 0.21f), away_m, 4.0f * away_m));
    if (!environment) {
        scene.ambient = glm::vec3(0.045f, 0.05f, 0.06f);
        return true;
    }
    // The studio's boxes are as bright as photographers like them; beside a sun and two points a third is enough.
    constexpr float kShare = 0.3f;
    multiply(*environment, kShare);
    scene.environment = std::move(environment);
    return true;
}

}  // namespace halfframe::content
