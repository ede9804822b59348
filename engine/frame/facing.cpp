// Sorts triangles by the cell of the octahedron that they face, and finds the cells that an eye cannot see.
#include "engine/frame/facing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/frame/skinning.h"
#include "engine/frame/vertex_storage.h"

namespace halfframe {

namespace {

/// Cells along a side of the grid: 11 degrees at most from the middle of one to its edge.
constexpr std::size_t kSide = 16;
constexpr std::size_t kCells = kSide * kSide;
constexpr std::size_t kCorners = kSide + 1;  ///< along a side
constexpr std::uint32_t kNearbyVertices = 32;
/// Of the largest n.(eye - p) there can be: less is no sign of a back. A triangle a pixel long and 0.2 degrees from
/// edge on may turn round when its corners are rounded to 1/256 of a pixel.
constexpr float kEdgeOn = 1.0f / 256.0f;

/// Where a cell stands on Hilbert's curve over the grid: cells that follow each other face alike.
std::size_t place_on_curve(std::size_t column, std::size_t row) {
    std::size_t place = 0;
    for (std::size_t half = kSide / 2; half > 0; half /= 2) {
        const bool right = (column & half) != 0, upper = (row & half) != 0;
        place += half * half * ((right ? 3u : 0u) ^ (upper ? 1u : 0u));
        if (upper) continue;
        if (right) {
            column = kSide - 1 - column;
            row = kSide - 1 - row;
        }
        std::swap(column, row);
    }
    return place;
}

struct Grid {
    std::array<glm::vec3, kCorners * kCorners> corners;  ///< |x| + |y| + |z| = 1; row after row
    std::array<std::uint16_t, kCells> on_curve;          ///< cell at each place of the curve
    std::array<std::uint16_t, kCells> places;            ///< the inverse
};

Grid make_grid() {
    Grid grid{};
    for (std::size_t i = 0; i < grid.corners.size(); ++i) {
        const glm::dvec2 at(static_cast<double>(i % kCorners), static_cast<double>(i / kCorners));
        const glm::dvec3 unit = from_octahedral(at * (2.0 / kSide) - 1.0);
        grid.corners[i] = glm::vec3(unit / (std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z)));
    }
    for (std::size_t cell = 0; cell < kCells; ++cell) {
        const std::size_t place = place_on_curve(cell % kSide, cell / kSide);
        grid.on_curve[place] = static_cast<std::uint16_t>(cell);
        grid.places[cell] = static_cast<std::uint16_t>(place);
    }
    return grid;
}

const Grid& grid() {
    static const Grid made = make_grid();
    return made;
}

std::size_t cell_facing(const glm::dvec3& normal) {
    const glm::dvec2 at = (octahedral(normal) + 1.0) * (0.5 * kSide);
    const auto step = [](double x) { return static_cast<std::size_t>(std::clamp(x, 0.0, kSide - 1.0)); };
    return step(at.y) * kSide + step(at.x);
}

/// Vertices that a cache of the last kNearbyVertices does not hold.
std::size_t vertices_missed(std::span<const std::uint32_t> indices, std::size_t vertices) {
    std::vector<std::size_t> entered(vertices, 0);  // when, from 1; 0: never
    std::size_t misses = 0;
    for (const std::uint32_t index : indices) {
        if (entered[index] != 0 && misses - entered[index] < kNearbyVertices) continue;
        entered[index] = ++misses;
    }
    return misses;
}

/// What faces where, before anything is moved.
struct Facings {
    std::vector<std::uint16_t> place;           ///< on the curve, of each triangle
    std::array<std::uint32_t, kCells> count{};  ///< of triangles at each place
    std::array<float, kCells> plane{};
};

Facings facings_of(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                   const glm::dvec3& middle) {
    Facings facings;
    facings.place.resize(indices.size() / 3);
    facings.plane.fill(std::numeric_limits<float>::infinity());
    std::uint16_t place = 0;  // of one without area, which shows nowhere: that of the one before
    for (std::size_t i = 0; i < facings.place.size(); ++i) {
        const glm::dvec3 a(positions[indices[3 * i]]), b(positions[indices[3 * i + 1]]),
            c(positions[indices[3 * i + 2]]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
        if (length > 0.0 && std::isfinite(length)) {
            place = grid().places[cell_facing(normal)];
            const auto plane = static_cast<float>(glm::dot(normal / length, a - middle));
            facings.plane[place] = std::min(facings.plane[place], plane);
        }
        facings.place[i] = place;
        ++facings.count[place];
    }
    return facings;
}

/// xyz and w of the place where clip x, y and w are all 0, the eye or the direction of a parallel view: the sign of
/// n.xyz - (n.p) w is that of the triangle's area in the window (M. Olano and T. Greer, "Triangle Scan Conversion using
/// 2D Homogeneous Coordinates", Graphics Hardware 1997, section 4). w < 0: the window is mirrored.
glm::dvec4 eye_of(const glm::mat4& clip_from_local) {
    const glm::dmat4 columns(clip_from_local);
    const auto without = [&](int left_out) {  // determinant of rows x, y and w
        std::array<glm::dvec3, 3> rest;
        for (int i = 0, column = 0; column < 4; ++column) {
            if (column == left_out) continue;
            rest[static_cast<std::size_t>(i++)] = {columns[column].x, columns[column].y, columns[column].w};
        }
        return glm::dot(rest[0], glm::cross(rest[1], rest[2]));
    };
    const glm::dvec4 eye(without(0), -without(1), without(2), -without(3));
    const glm::dvec4 size = glm::abs(eye);
    const double largest = std::max({size.x, size.y, size.z, size.w});
    return largest > 0.0 ? eye / largest : glm::dvec4(0.0, 0.0, 0.0, -1.0);
}

}  // namespace

FacingGroups order_by_facing(std::span<const glm::vec3> positions, std::vector<std::uint32_t>& indices) {
    const std::size_t triangles = indices.size() / 3;
    if (triangles < kFacingTriangles) return {};
    if (std::ranges::any_of(indices, [&](std::uint32_t index) { return index >= positions.size(); })) return {};
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const glm::vec3& position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    FacingGroups facing;
    facing.middle = 0.5f * low + 0.5f * high;
    const glm::vec3 reach = glm::max(high - facing.middle, facing.middle - low);
    facing.reach = std::max({reach.x, reach.y, reach.z});
    if (!std::isfinite(facing.reach)) return {};
    const Facings facings = facings_of(positions, indices, glm::dvec3(facing.middle));
    std::array<std::uint32_t, kCells> next{};
    std::uint32_t end = 0;
    for (std::size_t place = 0; place < kCells; ++place) {
        next[place] = end;
        end += facings.count[place];
        if (facings.count[place] > 0) facing.groups.push_back({end, grid().on_curve[place], facings.plane[place]});
    }
    std::vector<std::uint32_t> ordered(3 * triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        const std::size_t to = 3 * std::size_t{next[facings.place[i]]++};
        for (std::size_t corner = 0; corner < 3; ++corner) ordered[to + corner] = indices[3 * i + corner];
    }
    if (vertices_missed(ordered, positions.size()) > vertices_missed(indices, positions.size())) return {};
    indices = std::move(ordered);
    return facing;
}

std::size_t visible_ranges(const FacingGroups& groups, const glm::mat4& clip_from_local,
                           std::array<TriangleRange, kMostRanges>& ranges) {
    const std::uint32_t all = groups.groups.back().end;
    const glm::dvec4 precise = eye_of(clip_from_local);
    if (!(precise.w >= 0.0)) {
        ranges[0] = {0, all};
        return 1;
    }
    const glm::vec3 eye(glm::dvec3(precise) - precise.w * glm::dvec3(groups.middle));
    const auto w = static_cast<float>(precise.w);
    std::array<float, kCorners * kCorners> along;
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = glm::dot(grid().corners[i], eye);
    const glm::vec3 size = glm::abs(eye);
    const float edge_on = kEdgeOn * (std::max({size.x, size.y, size.z}) + w * groups.reach);
    const auto is_hidden = [&](const FacingGroups::Group& group) {
        const float* low = &along[group.cell / kSide * kCorners + group.cell % kSide];
        return std::max({low[0], low[1], low[kCorners], low[kCorners + 1]}) < group.plane * w - edge_on;
    };
    const std::uint32_t left_out =
        std::max<std::uint32_t>(kHiddenTriangles, static_cast<std::uint32_t>(all / (kMostRanges - 1) + 1));
    std::size_t count = 0;
    std::uint32_t begin = 0, shown = 0;  // where the group begins, and the last range ends
    for (const FacingGroups::Group& group : groups.groups) {
        if (!is_hidden(group)) {
            if (count == 0 || begin - shown >= left_out) ranges[count++].first = begin;
            ranges[count - 1].count = group.end - ranges[count - 1].first;
            shown = group.end;
        }
        begin = group.end;
    }
    return count;
}

std::vector<bool> meshes_to_order(const Scene& scene) {
    std::vector<bool> order(scene.meshes.size(), false), keep(scene.meshes.size(), false);
    for (const Surface& surface : scene.surfaces) {
        const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
        const auto mesh = static_cast<std::size_t>(surface.mesh);
        if (material.alpha_mode == AlphaMode::blend || changes_shape(scene, surface)) keep[mesh] = true;
        if (!material.double_sided) order[mesh] = true;
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        order[i] = order[i] && !keep[i] && mesh.primitive == Primitive::triangles && !mesh.indices.empty();
    }
    return order;
}

}  // namespace halfframe
