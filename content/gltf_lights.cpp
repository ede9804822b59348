// KHR_lights_punctual as Scene lights.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "content/gltf_extensions.h"
#include "content/gltf_extras.h"

namespace halfframe::content {
namespace {

/// A light without a range reaches to where a thousandth of a light of 1 is left: 0.2 of 255 codes at black.
constexpr float kFaintest = 1e-3f;
constexpr float kFarthest_m = 1e6f;

float number_or(const JsonPlace& owner, const char* key, float otherwise) {
    return owner.has(key) ? static_cast<float>(owner.at(key).number()) : otherwise;
}

LightKind kind_of(const std::string& type) {
    return type == "directional" ? LightKind::sun : type == "spot" ? LightKind::spot : LightKind::point;
}

}  // namespace

std::optional<Light> light_of_node(const GltfDocument& document, std::size_t node_index,
                                   const glm::mat4& world_from_local) {
    const JsonPlace node = document.root().at("nodes").at(node_index);
    const auto use = extension(node, "KHR_lights_punctual");
    if (!use) return std::nullopt;
    const auto index = static_cast<std::size_t>(use->at("light").whole());
    const JsonPlace source = extension(document.root(), "KHR_lights_punctual")->at("lights").at(index);
    Light light;
    light.kind = kind_of(source.at("type").text());
    light.name = name_of(source);
    if (light.name.empty()) light.name = name_of(node);
    if (light.name.empty()) light.name = fmt::format("light {}", index);
    if (source.has("color")) {
        for (int i = 0; i < 3; ++i)
            light.color[i] = static_cast<float>(source.at("color").at(static_cast<std::size_t>(i)).number());
    }
    // A white Lambert surface sends back 1 / pi of the illuminance: candela at 1 m, or lux of a sun.
    const double share = (source.has("intensity") ? source.at("intensity").number() : 1.0) / std::numbers::pi_v<double>;
    for (int i = 0; i < 3; ++i) light.color[i] = static_cast<float>(static_cast<double>(light.color[i]) * share);
    light.position = glm::vec3(world_from_local[3]);
    const glm::vec3 back(world_from_local[2]);
    const float length = glm::length(back);
    const bool unit_already = std::abs(length - 1.0f) < 5e-7f;
    light.direction = unit_already                             ? -back
                      : length > 0.0f && std::isfinite(length) ? -back / length
                                                               : glm::vec3(0.0f, 0.0f, -1.0f);
    const float strongest = std::max({light.color.r, light.color.g, light.color.b});
    light.range_m = std::clamp(number_or(source, "range", std::sqrt(strongest / kFaintest)), 1e-3f, kFarthest_m);
    if (light.kind == LightKind::spot) {
        light.inner_cone_rad = number_or(source.at("spot"), "innerConeAngle", 0.0f);
        light.outer_cone_rad = number_or(source.at("spot"), "outerConeAngle", 0.785398163f);
    }
    apply_extras(source, ExtrasOwner::light, {.light = &light});
    light.radius_m = std::min(light.radius_m, 0.99f * light.range_m);  // a sphere ends before its light does
    return light;
}

}  // namespace halfframe::content
