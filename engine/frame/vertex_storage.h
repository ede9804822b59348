// How the streams of a mesh are stored in fewer bits, and what that loses. Pure: no GL.
//
// Positions are 16-bit steps of a box, UVs 16-bit steps of their range, both with the ends of the range exact, so that
// tiles that meet at their boxes still meet. Scale and offset of positions are folded into the matrices on the CPU.
// Directions are octahedral: Q. Meyer et al., "On Floating-Point Normal Vectors", EGSR 2010; Z. Cigolle et al., "A
// Survey of Efficient Representations for Independent Unit Vectors", JCGT 2014. shaders_es/common/vertex_decode.glsl
// decodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "engine/frame/scene.h"

namespace halfframe {

/// full: 32-bit floats everywhere. half: 16 and 8 bits, where the error stays below the limits here.
enum class VertexPrecision : std::uint8_t { full, half };
[[nodiscard]] const char* name(VertexPrecision precision);

/// How one stream lies in memory. Directions are two octahedral components in either.
enum class StreamFormat : std::uint8_t {
    absent,   ///< takes no bytes
    float32,  ///< positions 12 bytes, directions 8, UVs 8, colours 16
    bits16,   ///< positions 8 bytes, directions 4, UVs 4, colours 8
    bits8,    ///< colours only: 4 bytes
};

/// Worst error that 16-bit positions may have before a mesh keeps 32 bits [mm, in the world]: a quarter of a pixel from
/// 2 m off at 1000 pixels a radian (1280 pixels of 65 degrees). A box of 38 m a side reaches it.
inline constexpr double kPositionLimit_mm = 0.5;
/// Worst error of 16-bit UVs [texels of the largest texture]: 16 repeats of 2048 texels.
inline constexpr double kUvLimit_texels = 0.25;
/// Worst error of 8-bit colours before they take 16 bits [display codes]: dark colours have few of 256 linear steps.
inline constexpr double kColorLimit_codes = 1.0;

/// How one mesh is stored. The default of every stream is what 32 bits make of it.
struct MeshStorage {
    StreamFormat positions = StreamFormat::float32;
    StreamFormat normals = StreamFormat::absent;
    StreamFormat tangents = StreamFormat::absent;
    StreamFormat uv = StreamFormat::absent;
    StreamFormat uv1 = StreamFormat::absent;
    StreamFormat colors = StreamFormat::absent;
    Box position_box;  ///< of bits16: 0 is its low corner, 65535 its high one; meshes that share corners share it [m]
    glm::vec4 uv_range{1.0f, 1.0f, 0.0f, 0.0f};   ///< uv = stored * xy + zw
    glm::vec4 uv1_range{1.0f, 1.0f, 0.0f, 0.0f};  ///< the same of the second set
    double world_scale = 1.0;    ///< largest scale that the mesh is drawn at: errors are told in the world
    glm::dvec2 uv_texels{0.0};   ///< texels across one unit of uv, of the largest texture that is read with it
    glm::dvec2 uv1_texels{0.0};  ///< the same of the second set
};

/// Local positions from stored ones: origin + step * stored.
struct StoredPositions {
    glm::dvec3 origin{0.0};  ///< [m]
    glm::dvec3 step{1.0};    ///< [m]
};
[[nodiscard]] StoredPositions stored_positions(const MeshStorage& storage);

/// What storing a mesh costs and loses. Errors are against 32-bit floats.
struct StorageError {
    std::size_t bytes_full = 0;    ///< vertices as 32-bit floats, as Mesh holds them; indices are not counted
    std::size_t bytes_stored = 0;  ///< vertices as stored
    double worst_mm = 0.0;         ///< in the world, at the largest scale the mesh is drawn at
    double worst_normal_degrees = 0.0;
    double worst_tangent_degrees = 0.0;  ///< 180 if a handedness is lost
    double worst_uv_texels = 0.0;        ///< along one axis, of the largest texture; in UV units x 1024 without one
    double worst_color_codes = 0.0;      ///< sRGB display codes of 0..255; alpha in steps of 1/255
};

/// 32 bits for every stream that the mesh has.
[[nodiscard]] MeshStorage full_storage(const Mesh& mesh);

/// How every mesh of the scene is stored. Meshes that share corners in one space share a box, so that shared corners
/// stay shared to the bit. A mesh that would err past a limit keeps 32 bits and a notice says so; skinned and morphed
/// ones keep 32-bit positions, because their vertices move.
[[nodiscard]] std::vector<MeshStorage> plan_vertex_storage(const Scene& scene, VertexPrecision precision,
                                                           std::vector<std::string>& notices);

/// What `storage` makes of `mesh`: stores and restores every vertex.
[[nodiscard]] StorageError storage_error(const Mesh& mesh, const MeshStorage& storage);

/// `from_local` for positions as stored: what a shader multiplies them with. The identity's place for 32-bit ones.
[[nodiscard]] glm::mat4 from_stored(const glm::mat4& from_local, const MeshStorage& storage);
/// xyz: what undoes the scale of from_stored() for a direction, up to its length.
[[nodiscard]] glm::vec4 direction_scale(const MeshStorage& storage);

/// Octahedral coordinates -1..1 of a unit vector.
[[nodiscard]] glm::dvec2 octahedral(const glm::dvec3& direction);
/// The same of a tangent with its handedness: y is 0..1, above 0, and carries the sign.
[[nodiscard]] glm::dvec2 octahedral_tangent(const glm::dvec4& tangent);
/// Their inverses; unit.
[[nodiscard]] glm::dvec3 from_octahedral(const glm::dvec2& stored);
[[nodiscard]] glm::dvec4 tangent_from_octahedral(const glm::dvec2& stored);
/// The same in steps of 1/32767. Eight bits would err by 0.95 degrees, two thirds of a highlight of power 2048.
[[nodiscard]] glm::i16vec2 octahedral16(const glm::dvec3& direction);
[[nodiscard]] glm::i16vec2 octahedral16_tangent(const glm::dvec4& tangent);

/// 0..65535 along each axis of the box.
[[nodiscard]] glm::u16vec3 position16(const glm::vec3& position, const Box& box);
/// 0..65535 along a range (xy scale, zw offset).
[[nodiscard]] glm::u16vec2 uv16(const glm::vec2& uv, const glm::vec4& range);

}  // namespace halfframe
