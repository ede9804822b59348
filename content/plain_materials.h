// Materials without textures, for scenes made by code.
#pragma once

#include <string>

#include "engine/frame/scene.h"

namespace halfframe::content {

/// No metal; `linear` is its albedo 0..1.
[[nodiscard]] inline Material dielectric(std::string name, const glm::vec3& linear, float roughness) {
    Material material;
    material.name = std::move(name);
    material.base_color = glm::vec4(linear, 1.0f);
    material.metallic = 0.0f;
    material.roughness = roughness;
    return material;
}

/// `specular` is what it reflects straight on, 0..1.
[[nodiscard]] inline Material metal(std::string name, const glm::vec3& specular, float roughness) {
    Material material = dielectric(std::move(name), specular, roughness);
    material.metallic = 1.0f;
    return material;
}

/// Sends `radiance` out, 1 is white on the display before the tone map; `linear` is its albedo.
[[nodiscard]] inline Material shining(std::string name, const glm::vec3& radiance, const glm::vec3& linear) {
    Material material = dielectric(std::move(name), linear, 0.6f);
    material.emissive = radiance;
    return material;
}

/// Seen from both sides, `alpha` of it over what lies behind.
[[nodiscard]] inline Material blended(Material material, float alpha) {
    material.base_color.a = alpha;
    material.alpha_mode = AlphaMode::blend;
    material.double_sided = true;
    return material;
}

}  // namespace halfframe::content
