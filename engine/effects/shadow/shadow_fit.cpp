// Fits the sun's map to what is seen.
#include "engine/effects/shadow/shadow_fit.h"

#include <algorithm>
#include <cmath>

#include "engine/frame/camera_space.h"
#include "shaders_es/shadow/shadow_limits.h"

namespace halfframe {

namespace {

/// Air on either side for the filter and the lift, in shares of the seen extent: 10 texels of 2032 and 5.1 of 1008 on
/// each side are under 1/160.
constexpr double kAir = 1.0 / 160.0;
/// The least a map may show [m]: a scene of one point still gives finite matrices, in any unit of length.
constexpr double kSmallestSide = 1e-9;

struct Extent {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    [[nodiscard]] bool empty() const { return low.x > high.x || low.y > high.y || low.z > high.z; }
};

glm::dvec3 corner_of(const Box& box, unsigned corner) {
    return {corner & 1u ? box.high.x : box.low.x, corner & 2u ? box.high.y : box.low.y,
            corner & 4u ? box.high.z : box.low.z};
}

Extent extent_in_light(const glm::dmat3& light_from_world, const Box& local, const glm::mat4& world_from_local) {
    const glm::dmat4 world(world_from_local);
    Extent extent;
    for (unsigned corner = 0; corner < 8; ++corner)
        extent.add(light_from_world * glm::dvec3(world * glm::dvec4(corner_of(local, corner), 1.0)));
    return extent;
}

/// The view's pyramid or box. Its corners are taken from the eye, so that 10 km from the origin they keep their digits.
Extent view_in_light(const glm::dmat3& light_from_world, const View& view) {
    const glm::dmat4 view_from_clip = glm::inverse(glm::dmat4(view.clip_from_view));
    const glm::dmat3 world_from_view = glm::inverse(glm::dmat3(view.view_from_world));
    Extent extent;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec4 at = view_from_clip * glm::dvec4(corner & 1u ? 1.0 : -1.0, corner & 2u ? 1.0 : -1.0,
                                                          corner & 4u ? 1.0 : -1.0, 1.0);
        extent.add(light_from_world * (glm::dvec3(view.eye) + world_from_view * (glm::dvec3(at) / at.w)));
    }
    return extent;
}

/// The smallest of the sizes 2^(k/4) m that holds `extent` with its air wherever the grid of cells begins.
double side_for(double extent) {
    constexpr double kCellShare = (SHADOW_CELLS - 1.0) / SHADOW_CELLS;
    const double needed = std::max(extent * (1.0 + 2.0 * kAir) / kCellShare, kSmallestSide);
    return std::exp2(std::ceil(4.0 * std::log2(needed)) / 4.0);
}

bool overlap(const Extent& a, const glm::dvec2& low, double side) {
    return a.high.x >= low.x && a.high.y >= low.y && a.low.x <= low.x + side && a.low.y <= low.y + side;
}

/// What of the receivers is in view.
Extent seen_receivers(const Scene& scene, std::span<const ShadowBody> bodies, const glm::dmat3& light_from_world,
                      const View& view) {
    const Extent in_view = view_in_light(light_from_world, view);
    Extent seen;
    for (const ShadowBody& body : bodies) {
        if (!body.receives) continue;
        const glm::mat4& place = scene.surfaces[static_cast<std::size_t>(body.surface)].world_from_local;
        if (outside_view(body.local, clip_from_local(view, place))) continue;
        Extent part = extent_in_light(light_from_world, body.local, place);
        part.low = glm::max(part.low, in_view.low);
        part.high = glm::min(part.high, in_view.high);
        if (part.empty()) continue;
        seen.add(part.low);
        seen.add(part.high);
    }
    return seen;
}

}  // namespace

ShadowBody shadow_body(const Scene& scene, int index, const Box& local) {
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(index)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
    const AlphaMode mode = scene.materials[static_cast<std::size_t>(surface.material)].alpha_mode;
    const bool is_area = mesh.primitive >= Primitive::triangles && !local.empty();
    return {.surface = index,
            .local = local,
            .casts = is_area && mode != AlphaMode::blend,
            .receives = is_area && !mesh.normals.empty()};
}

bool is_flat(const Box& box) {
    if (box.empty()) return true;
    const glm::vec3 size = box.high - box.low;
    const float largest = std::max({size.x, size.y, size.z});
    return std::min({size.x, size.y, size.z}) <= 1e-6f * largest;  // 1e-6: rounding of a plane's positions
}

glm::dmat3 light_axes(const glm::vec3& direction) {
    const glm::dvec3 along = glm::normalize(glm::dvec3(direction));
    // A noon sun travels along Y: there Z takes its place.
    const glm::dvec3 guide = std::abs(along.y) < 0.99 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 across = glm::normalize(glm::cross(along, guide));
    const glm::dvec3 third = glm::cross(along, across);
    return glm::transpose(glm::dmat3(across, third, along));
}

std::optional<ShadowFit> fit_shadow(const Scene& scene, std::span<const ShadowBody> bodies,
                                    const glm::vec3& sun_direction, const View& view) {
    ShadowFit fit;
    fit.light_from_world = light_axes(sun_direction);
    const Extent seen = seen_receivers(scene, bodies, fit.light_from_world, view);
    if (seen.empty()) return std::nullopt;
    const double extent = std::max(seen.high.x - seen.low.x, seen.high.y - seen.low.y);
    fit.side_m = side_for(extent);
    const double cell = fit.side_m / SHADOW_CELLS;
    fit.low = glm::floor((glm::dvec2(seen.low) - extent * kAir) / cell) * cell;
    fit.depth_low = seen.low.z;
    for (const ShadowBody& body : bodies) {
        if (!body.casts) continue;
        const Extent part = extent_in_light(fit.light_from_world, body.local,
                                            scene.surfaces[static_cast<std::size_t>(body.surface)].world_from_local);
        if (overlap(part, fit.low, fit.side_m)) fit.depth_low = std::min(fit.depth_low, part.low.z);
    }
    // Depth lies on the same grid, a cell of air at either end.
    fit.depth_low = (std::floor(fit.depth_low / cell) - 1.0) * cell;
    fit.depth_high = (std::ceil(seen.high.z / cell) + 1.0) * cell;
    return fit;
}

namespace {

/// x and y of the drawn square to -1..1, depth to -1..1.
glm::dmat4 clip_from_world(const ShadowFit& fit) {
    const glm::dvec3 scale(2.0 / fit.side_m, 2.0 / fit.side_m, 2.0 / (fit.depth_high - fit.depth_low));
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 3; ++column) matrix[column] = glm::dvec4(scale * fit.light_from_world[column], 0.0);
    matrix[3] = glm::dvec4(-scale * glm::dvec3(fit.low, fit.depth_low) - 1.0, 1.0);
    return matrix;
}

}  // namespace

glm::mat4 shadow_clip_from_local(const ShadowFit& fit, const glm::mat4& world_from_local) {
    return glm::mat4(clip_from_world(fit) * glm::dmat4(world_from_local));
}

glm::mat4 shadow_from_eye(const ShadowFit& fit, const glm::vec3& eye, int map_texels) {
    const double drawn = static_cast<double>(map_texels - 2 * SHADOW_MAP_RIM) / map_texels;
    glm::dmat4 map_from_clip(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        map_from_clip[axis][axis] = axis < 2 ? 0.5 * drawn : 0.5;
        map_from_clip[3][axis] = 0.5;
    }
    glm::dmat4 world_from_eye(1.0);
    world_from_eye[3] = glm::dvec4(glm::dvec3(eye), 1.0);
    return glm::mat4(map_from_clip * clip_from_world(fit) * world_from_eye);
}

double shadow_texel_m(const ShadowFit& fit, int map_texels) { return fit.side_m / (map_texels - 2 * SHADOW_MAP_RIM); }

}  // namespace halfframe
