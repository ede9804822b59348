// Where the low tier may light vertices instead of fragments.
#include "engine/effects/surface/surface_by_vertex.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/effects/surface/surface_textures.h"
#include "shaders_es/surface/surface_limits.h"

namespace halfframe {

namespace {

/// What fragments lit by vertex have too.
bool is_behind_the_light(std::string_view point) { return point == "surface.lighting" || point == "surface.color"; }

}  // namespace

bool turns_gently(const Mesh& mesh) {
    if (mesh.normals.empty()) return false;
    const bool list = mesh.primitive == Primitive::triangles;
    const bool fan = mesh.primitive == Primitive::triangle_fan;
    if (!list && !fan && mesh.primitive != Primitive::triangle_strip) return false;
    const std::size_t count = mesh.indices.empty() ? mesh.normals.size() : mesh.indices.size();
    double area = 0.0, steep = 0.0;
    for (std::size_t i = 0; i + 2 < count; i += list ? 3 : 1) {
        std::array<std::size_t, 3> corners{fan ? 0 : i, i + 1, i + 2};
        if (!mesh.indices.empty()) {
            for (std::size_t& corner : corners) corner = mesh.indices[corner];
        }
        const auto [a, b, c] = corners;
        const auto& normals = mesh.normals;
        const float twice = glm::length(
            glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
        const float turn = std::min({glm::dot(normals[a], normals[b]), glm::dot(normals[b], normals[c]),
                                     glm::dot(normals[c], normals[a])});
        area += twice;
        if (turn < kGentleCosine) steep += twice;
    }
    return steep <= kSteepShare * area;
}

bool vertices_carry_insertions(const FramePlan& plan, std::span<const std::string_view> defines) {
    const auto has = [&](std::string_view define) { return std::ranges::find(defines, define) != defines.end(); };
    return std::ranges::all_of(plan.effects, [&](const EffectDecision& decision) {
        const auto is_here = [&](const gl::Insertion& one) {
            return std::string_view(one.point).starts_with("surface.") &&
                   (one.only_with == nullptr || has(one.only_with));
        };
        const auto adds_at = [&](std::string_view point) {
            return std::ranges::any_of(decision.insertions,
                                       [&](const gl::Insertion& one) { return is_here(one) && one.point == point; });
        };
        if (adds_at("surface.mirrored") && !has("CONSTANT_SMOOTHNESS")) return false;
        if (adds_at("surface.mirrored") && has("MIRROR_BY_VERTEX") && !adds_at("surface.vertex_mirrored")) return false;
        return adds_at("surface.vertex_light") ||
               std::ranges::all_of(decision.insertions, [&](const gl::Insertion& one) {
                   return !is_here(one) || is_behind_the_light(one.point);
               });
    });
}

VertexLitMaterial vertex_lit(const Material& material) {
    const float power = power_of(unmapped_roughness(material));
    const float smoothness = smoothness_of_power(power);
    const glm::vec3 base(material.base_color);
    const glm::vec3 own(specular_factors_of(material));
    if (material.model == MaterialModel::specular_glossiness) {
        const float left = 1.0f - glm::clamp(std::max({own.r, own.g, own.b}), 0.0f, 1.0f);
        return {glm::vec4(base * left, smoothness), glm::vec4(own, power), glm::vec4(0.0f)};
    }
    const bool is_default = model_defines(material).empty();
    const glm::vec3 dielectric =
        is_default ? glm::vec3(static_cast<float>(SURFACE_DIELECTRIC_SPECULAR)) : glm::min(own, glm::vec3(1.0f));
    const float rest = 1.0f - material.metallic;
    return {glm::vec4(base * rest, smoothness), glm::vec4(dielectric * rest, power),
            glm::vec4(base * material.metallic, 0.0f)};
}

bool mirrors_by_vertex(const Material& material) { return unmapped_roughness(material) >= kRoughByVertex; }

}  // namespace halfframe
