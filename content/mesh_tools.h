// Changes to meshes that a loader or a shape needs: triangle lists, flat normals, tangents, mirroring.
#pragma once

#include "engine/frame/scene.h"

namespace halfframe::content {

[[nodiscard]] bool has_faces(Primitive primitive);

/// How many vertices the primitive draws: its indices, or all its vertices.
[[nodiscard]] std::size_t drawn_vertices(const Mesh& mesh);

/// The faces as a list of three indices each, in the front-face order of GL, from triangles, a strip or a fan.
[[nodiscard]] std::vector<std::uint32_t> triangle_list(const Mesh& mesh);

/// `mesh` with three vertices of its own for each triangle, and the normal of its face on them. A face without area
/// gets +Y.
[[nodiscard]] Mesh flat_shaded(const Mesh& mesh);

/// Makes every normal unit. One that is zero or not finite becomes the area-weighted mean of the normals of its faces
/// (or +Y). Returns how many those were.
std::size_t repair_normals(Mesh& mesh);

/// Tangents from positions, normals and uv: the direction of growing u, summed over the faces of a vertex, then made
/// orthogonal to the normal; w so that the bitangent points to falling v, which is up in the picture. Not MikkTSpace: a
/// vertex shared by faces with mirrored uv gets the mean of both, where MikkTSpace would split it. `uv`: those that the
/// normal map is read at; one for each vertex.
void add_tangents(Mesh& mesh, const std::vector<glm::vec2>& uv);
void add_tangents(Mesh& mesh);

/// What `mapping` makes of coordinates: the vertex shader's common/uv_mapping.glsl, on the CPU.
[[nodiscard]] std::vector<glm::vec2> mapped(const std::vector<glm::vec2>& uv, const UvMapping& mapping);

/// Makes every tangent unit and orthogonal to its normal, and w +1 or -1.
void repair_tangents(Mesh& mesh);

/// `mesh` for a transform with a negative determinant: faces turn around, so that fronts stay fronts, and the tangents'
/// handedness flips, so that bitangents stay what they were.
[[nodiscard]] Mesh mirrored(const Mesh& mesh);

}  // namespace halfframe::content
