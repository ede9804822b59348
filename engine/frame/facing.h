// Triangles of a mesh in the order of where they face, so that those that face away are left out by the range, before a
// vertex of theirs is transformed. Pure: no GL.
//
// A grid on the octahedron |x| + |y| + |z| = 1 (Q. Meyer et al., "On Floating-Point Normal Vectors", EGSR 2010) divides
// the normals into groups. n.(eye - p) is below 0 for all of a group where it is for the four corners of its cell and
// the least n.p: a normal of the cell is a mean of its corners. Next to the cone of D. Shirman and S. Abi-Ezzi ("The
// Cone of Normals Technique for Fast Processing of Curved Patches", Eurographics 1993) that needs no angle and no
// sphere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "engine/frame/scene.h"

namespace halfframe {

/// Meshes of fewer triangles stay as they are.
inline constexpr std::size_t kFacingTriangles = 512;
/// Fewer hidden triangles in a row are drawn all the same: another draw call costs as much. On llvmpipe 64, 100 and 200
/// take equal time.
inline constexpr std::uint32_t kHiddenTriangles = 128;
/// As many as a mesh is drawn in at most, because what is left out in a row is a sixteenth of it or more.
inline constexpr std::size_t kMostRanges = 17;

/// Where each group of a mesh's triangles ends, and when it is hidden. Without groups the mesh keeps its order.
struct FacingGroups {
    struct Group {
        std::uint32_t end = 0;   ///< the triangle after its last; it begins where the one before it ends
        std::uint16_t cell = 0;  ///< of the grid
        float plane = 0.0f;      ///< least n.(p - middle), |n.x| + |n.y| + |n.z| = 1
    };
    std::vector<Group> groups;
    glm::vec3 middle{0.0f};  ///< of all positions
    float reach = 0.0f;      ///< largest |x|, |y| or |z| of a position from there
};

/// Triangles `first` to `first + count` of an index buffer.
struct TriangleRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Orders the triangles that `indices` make of `positions`, in whatever space they are. Those that face alike keep
/// their order. Leaves `indices` alone, and returns no groups, where they are few, and where neighbours would be torn
/// apart: where fewer vertices would be found in a cache of the last 32. That is most of what a modeller has ordered
/// well, and slower to draw in part than well ordered as a whole.
/// An index without a position is the device's to judge: the order stays then too.
[[nodiscard]] FacingGroups order_by_facing(std::span<const glm::vec3> positions, std::vector<std::uint32_t>& indices);

/// Which triangles may show their fronts (counter-clockwise in the window) where `clip_from_local` takes them, in
/// `ranges`; returns how many ranges. Of a plain perspective or parallel view; one that mirrors hides nothing.
[[nodiscard]] std::size_t visible_ranges(const FacingGroups& groups, const glm::mat4& clip_from_local,
                                         std::array<TriangleRange, kMostRanges>& ranges);

/// Of each mesh of the scene: may its triangles change their order, and is it ever drawn without its backs? Not if it
/// changes its shape, or if a surface of it blends, where the order shows.
[[nodiscard]] std::vector<bool> meshes_to_order(const Scene& scene);

}  // namespace halfframe
