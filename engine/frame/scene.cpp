// Boxes of scenes, and cameras made from boxes.
#include "engine/frame/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/error.h"
#include "engine/frame/skinning.h"
#include "shaders_es/surface/surface_limits.h"

namespace halfframe {
namespace {

// Smallest half size a camera is made for [m]: a single point still gives a finite camera.
constexpr float kSmallestHalfSize = 1e-3f;
// Smallest near over far. 24-bit depth then still separates 1/16 of a unit at the far plane of a 1000-unit scene.
constexpr float kSmallestNearOverFar = 1e-3f;
// Air around a framed box, so that edges of the model do not touch edges of the picture.
constexpr float kFramingMargin = 1.05f;
// Where a framing camera stands, seen from the centre: to the right, above and in front.
const glm::vec3 kThreeQuarters{0.55f, 0.42f, 0.72f};

std::array<glm::vec3, 8> corners(const Box& box) {
    std::array<glm::vec3, 8> result{};
    for (unsigned corner = 0; corner < 8; ++corner) {
        result[corner] = {(corner & 1u) ? box.high.x : box.low.x, (corner & 2u) ? box.high.y : box.low.y,
                          (corner & 4u) ? box.high.z : box.low.z};
    }
    return result;
}

/// `box`, or a small cube when it is empty, made at least kSmallestHalfSize thick through its middle.
Box solid(const Box& box) {
    if (box.empty()) {
        return {glm::vec3(-1.0f), glm::vec3(1.0f)};
    }
    const glm::vec3 centre = 0.5f * (box.low + box.high);
    glm::vec3 half = 0.5f * (box.high - box.low);
    if (std::max({half.x, half.y, half.z}) < kSmallestHalfSize) {
        half = glm::vec3(kSmallestHalfSize);
    }
    return {centre - half, centre + half};
}

glm::mat4 world_from_view_looking(const glm::vec3& eye, const glm::vec3& forward) {
    const bool straight_up_or_down = std::abs(forward.y) > 0.999f;
    const glm::vec3 up = straight_up_or_down ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 right = glm::normalize(glm::cross(forward, up));
    const glm::vec3 true_up = glm::cross(right, forward);
    return {glm::vec4(right, 0.0f), glm::vec4(true_up, 0.0f), glm::vec4(-forward, 0.0f), glm::vec4(eye, 1.0f)};
}

/// Least and greatest distance of the box's corners along `forward` [m].
struct DepthExtent {
    float nearest = 1e30f;
    float farthest = -1e30f;
};

DepthExtent depth_extent(const glm::vec3& eye, const glm::vec3& forward, const Box& box) {
    DepthExtent extent;
    for (const glm::vec3& corner : corners(box)) {
        const float depth = glm::dot(corner - eye, forward);
        extent.nearest = std::min(extent.nearest, depth);
        extent.farthest = std::max(extent.farthest, depth);
    }
    return extent;
}

/// Near and far around what of `box` lies before the eye.
void set_depth_range(Camera& camera, const glm::vec3& eye, const glm::vec3& forward, const Box& box) {
    const auto [nearest, farthest] = depth_extent(eye, forward, box);
    const float size = glm::length(box.high - box.low);
    camera.far_m = std::max(farthest * 1.05f, size * 0.05f);
    camera.near_m = std::clamp(nearest * 0.9f, camera.far_m * kSmallestNearOverFar, camera.far_m * 0.5f);
}

}  // namespace

float power_of(float roughness) {
    const float alpha_squared = std::pow(roughness, 4.0f);
    const auto least = static_cast<float>(2.0 / (SURFACE_POWER_MAX + 2.0));
    return std::max(2.0f / std::max(alpha_squared, least) - 2.0f, static_cast<float>(SURFACE_POWER_MIN));
}

float smoothness_of_power(float power) { return std::clamp((std::log2(power) - 1.0f) * 0.1f, 0.0f, 1.0f); }

float smoothness_of(float roughness) { return smoothness_of_power(power_of(roughness)); }

float unmapped_roughness(const Material& material) {
    return material.model == MaterialModel::specular_glossiness ? 1.0f - material.smoothness : material.roughness;
}

bool maps_smoothness(const Material& material) {
    return material.model == MaterialModel::specular_glossiness ? bool(material.specular_smoothness_texture)
                                                                : bool(material.metallic_roughness_texture);
}

Box box_of(std::span<const glm::vec3> points) {
    // Sixteen points at a time, their numbers side by side: the compiler takes four numbers in an instruction, and of
    // so many it does not make a variable each.
    constexpr std::size_t kTogether = 16;
    std::array<float, 3 * kTogether> low{}, high{};
    low.fill(Box{}.low.x);
    high.fill(Box{}.high.x);
    std::size_t i = 0;
    for (; i + kTogether <= points.size(); i += kTogether) {
        const float* numbers = &points[i].x;
        for (std::size_t k = 0; k < low.size(); ++k) {
            const float number = numbers[k], lowest = low[k], highest = high[k];
            low[k] = number < lowest ? number : lowest;
            high[k] = highest < number ? number : highest;
        }
    }
    Box box;
    for (std::size_t k = 0; k < low.size(); k += 3) {
        box.low = glm::min(box.low, glm::vec3(low[k], low[k + 1], low[k + 2]));
        box.high = glm::max(box.high, glm::vec3(high[k], high[k + 1], high[k + 2]));
    }
    for (; i < points.size(); ++i) box.add(points[i]);
    return box;
}

Box local_box(const Mesh& mesh) {
    if (mesh.indices.empty()) return box_of(mesh.positions);
    std::vector<char> is_used(mesh.positions.size(), 0);
    for (const std::uint32_t index : mesh.indices) {
        expect(index < is_used.size(), "an index of a mesh lies past its last vertex");
        is_used[index] = 1;
    }
    if (std::ranges::find(is_used, 0) == is_used.end()) return box_of(mesh.positions);
    Box box;
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        if (is_used[i] != 0) box.add(mesh.positions[i]);
    }
    return box;
}

Box world_box(const Box& local, const glm::mat4& world_from_local) {
    Box box;
    if (!local.empty()) {
        for (const glm::vec3& corner : corners(local)) {
            box.add(glm::vec3(world_from_local * glm::vec4(corner, 1.0f)));
        }
    }
    return box;
}

Box world_box(const Scene& scene) {
    std::vector<Box> local(scene.meshes.size());
    std::transform(scene.meshes.begin(), scene.meshes.end(), local.begin(),
                   [](const Mesh& mesh) { return local_box(mesh); });
    Box box;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& surface = scene.surfaces[i];
        const bool moves = changes_shape(scene, surface);
        const Box world =
            world_box(moves ? posed_box(scene, static_cast<int>(i)) : local.at(static_cast<std::size_t>(surface.mesh)),
                      surface.world_from_local);
        if (!world.empty()) {
            box.add(world.low);
            box.add(world.high);
        }
    }
    return box;
}

Camera tightened(const Camera& camera, const Box& scene_box) {
    if (scene_box.empty()) return camera;
    const glm::vec3 eye(camera.world_from_view[3]);
    const glm::vec3 forward = -glm::normalize(glm::vec3(camera.world_from_view[2]));
    const auto [nearest, farthest] = depth_extent(eye, forward, scene_box);
    Camera tight = camera;
    // A hundredth of air, so that what lies on the box is not cut by rounding.
    const float air = 0.01f * (farthest - nearest) + 1e-6f * std::abs(farthest);
    const float near_m = std::max(camera.near_m, nearest - air);
    const float far_m = std::min(camera.far_m, farthest + air);
    if (near_m >= far_m) return camera;  // the scene is behind the eye or past the far plane: nothing to separate
    tight.near_m = near_m;
    tight.far_m = far_m;
    return tight;
}

View view_of(const Camera& camera, int width, int height) {
    expect(width > 0 && height > 0, "a view needs a width and a height of at least one pixel");
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    View view;
    view.view_from_world = glm::inverse(camera.world_from_view);
    view.eye = glm::vec3(camera.world_from_view[3]);
    view.width = width;
    view.height = height;
    view.orthographic = camera.orthographic;
    view.exposure = camera.exposure;
    if (camera.orthographic) {
        const float half_width = camera.half_height_m * aspect;
        view.clip_from_view = glm::ortho(-half_width, half_width, -camera.half_height_m, camera.half_height_m,
                                         camera.near_m, camera.far_m);
    } else {
        view.clip_from_view = glm::perspective(camera.fov_y_rad, aspect, camera.near_m, camera.far_m);
    }
    return view;
}

Camera camera_framing(const Box& box, float aspect, float fov_y_rad) {
    expect(aspect > 0.0f && fov_y_rad > 0.0f && fov_y_rad < 3.1f,
           "a framing camera needs an aspect above 0 and a field of view between 0 and 3.1 rad");
    const Box framed = solid(box);
    const glm::vec3 centre = 0.5f * (framed.low + framed.high);
    const glm::vec3 forward = -glm::normalize(kThreeQuarters);
    const glm::mat4 axes = world_from_view_looking(centre, forward);
    const glm::vec3 right(axes[0]);
    const glm::vec3 up(axes[1]);
    const float tan_y = std::tan(0.5f * fov_y_rad) / kFramingMargin;
    const float tan_x = tan_y * aspect;
    // A corner is inside when |sideways| <= tan * (distance + depth beyond the centre): the largest distance wins.
    float distance = 0.0f;
    for (const glm::vec3& corner : corners(framed)) {
        const glm::vec3 offset = corner - centre;
        const float beyond = glm::dot(offset, forward);
        distance = std::max(distance, std::abs(glm::dot(offset, right)) / tan_x - beyond);
        distance = std::max(distance, std::abs(glm::dot(offset, up)) / tan_y - beyond);
    }
    return camera_looking(centre - forward * distance, centre, fov_y_rad, framed);
}

Camera camera_looking(const glm::vec3& eye, const glm::vec3& target, float fov_y_rad, const Box& scene_box) {
    const glm::vec3 away = target - eye;
    const float distance = glm::length(away);
    expect(distance > 0.0f, "a camera needs a target that is not its eye");
    const glm::vec3 forward = away / distance;
    Camera camera;
    camera.fov_y_rad = fov_y_rad;
    camera.world_from_view = world_from_view_looking(eye, forward);
    set_depth_range(camera, eye, forward, solid(scene_box));
    return camera;
}

}  // namespace halfframe
