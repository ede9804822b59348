// The low tier's level of detail of light: which draws may light their vertices, and from where on.
#pragma once

#include <span>
#include <string_view>

#include <glm/glm.hpp>

#include "engine/frame/frame_plan.h"
#include "engine/frame/scene.h"

namespace halfframe {

/// A triangle is steep where two of its normals are farther apart than this: a cosine, of 30 degrees. Between vertices
/// that are 30 degrees apart diffuse light errs by 3 % of its peak.
inline constexpr float kGentleCosine = 0.866f;

/// Share of a mesh's area that steep triangles may have: the fillets of a machine part, not its faces.
inline constexpr double kSteepShare = 0.05;

/// Distance of the eye from the middle of a surface's box, in diagonals of the box, from which on its vertices are lit:
/// the direction to the eye then turns by 28 degrees at most from one end of it to the other. Nearer, a floor of two
/// triangles would mirror at its middle as it does at its corners.
inline constexpr float kFarInDiagonals = 2.0f;

/// Roughness 0..1 from which on vertices carry what a material mirrors and the sun's highlight on it too: a Blinn power of 4.3
/// at most. The lobe about the mirrored ray is then nearly as wide as the cosine of diffuse light, and on a white metal
/// harmonics are 3 display codes off at most beside a small lamp (`halfframe accuracy environment`, "reflection, by vertex").
inline constexpr float kRoughByVertex = 0.75f;

/// Whether light may be interpolated between the vertices of `mesh`: of triangles, of which few are steep. False where
/// there are no normals.
[[nodiscard]] bool turns_gently(const Mesh& mesh);

/// Whether vertices can carry all that the effects of `plan` add to surfaces in a program with `defines`: each that adds
/// light adds it at surface.vertex_light too, and none changes the material or dims a light by fragment. With
/// MIRROR_BY_VERTEX what is added at surface.mirrored has to be added at surface.vertex_mirrored too.
[[nodiscard]] bool vertices_carry_insertions(const FramePlan& plan, std::span<const std::string_view> defines);

/// Whether vertices carry what `material` mirrors too, where they are lit.
[[nodiscard]] bool mirrors_by_vertex(const Material& material);

/// What the vertices are told of a material whose numbers no texture varies: shaders_es/surface/surface_by_vertex.glsl.
struct VertexLitMaterial {
    glm::vec4 albedo;    ///< rgb 0..1; w smoothness
    glm::vec4 specular;  ///< rgb 0..1: of the specular colour what vertex colours do not tint; w power
    glm::vec4 metal;     ///< rgb 0..1: what they do
};

[[nodiscard]] VertexLitMaterial vertex_lit(const Material& material);

}  // namespace halfframe
