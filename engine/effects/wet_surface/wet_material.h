// The talk's wet material on the CPU, as shaders_es/wet_surface/wet_surface.glsl has it: for what is written into
// textures, for the low tier's factors and for questions about a place.
#pragma once

#include <algorithm>

#include <glm/glm.hpp>

namespace halfframe {

/// Share of a material that takes up water, 0..1. Linear specular 0..1, smoothness 0..1.
[[nodiscard]] inline float porosity(const glm::vec3& specular, float smoothness) {
    const float metal = glm::smoothstep(0.4f, 0.6f, (specular.r + specular.g + specular.b) / 3.0f);
    return (1.0f - metal) * std::clamp((0.5f - smoothness) * 2.5f, 0.0f, 1.0f);
}

/// Factor on the albedo, 0.2..1.
[[nodiscard]] inline float wet_factor(float pores, float wetness) { return 1.0f - 0.8f * pores * wetness; }

[[nodiscard]] inline float wet_smoothness(float smoothness, float pores, float wetness) {
    return smoothness + (1.0f - smoothness) * 0.4f * pores * wetness;
}

}  // namespace halfframe
