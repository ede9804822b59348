// Which part of the world the sun's map shows: what the camera sees, and what stands between that and the sun. Pure.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe {

/// What a surface is to the sun.
struct ShadowBody {
    int surface = 0;  ///< index in Scene::surfaces
    Box local;        ///< of its mesh [m]
    bool casts = false;
    bool receives = false;
};

/// Points and lines neither cast nor receive; translucents receive; a mesh without normals is not lit and only casts.
[[nodiscard]] ShadowBody shadow_body(const Scene& scene, int surface, const Box& local);

/// True when the box has no thickness: a plane or a line, which cannot shadow itself.
[[nodiscard]] bool is_flat(const Box& box);

/// A box in light space: x and y across the light, z the way it travels. Everything in double, from the world's origin.
struct ShadowFit {
    glm::dmat3 light_from_world{1.0};
    glm::dvec2 low{0.0};      ///< corner of the square that the map shows [m]
    double side_m = 0.0;      ///< of that square
    double depth_low = 0.0;   ///< nearest to the sun [m]
    double depth_high = 0.0;  ///< farthest
    bool operator==(const ShadowFit&) const = default;
};

/// Axes across and along light that travels in `direction`; the same for every camera.
[[nodiscard]] glm::dmat3 light_axes(const glm::vec3& direction);

/// The fit for one view, or nothing when no receiver is in view. It depends on nothing but its arguments, lies on a
/// grid that is fixed to the world, and has one of four sizes an octave: so while the camera moves the map keeps its
/// texels where they are, and stays equal until the view leaves a cell of 1/16 of the map. Reads no more of `scene`
/// than the places of its surfaces.
[[nodiscard]] std::optional<ShadowFit> fit_shadow(const Scene& scene, std::span<const ShadowBody> bodies,
                                                  const glm::vec3& sun_direction, const View& view);

/// To the clip space in which the map is drawn.
[[nodiscard]] glm::mat4 shadow_clip_from_local(const ShadowFit& fit, const glm::mat4& world_from_local);

/// From world axes with the origin at the eye to the map as it is sampled, 0..1; `map_texels`: its side, rim included.
[[nodiscard]] glm::mat4 shadow_from_eye(const ShadowFit& fit, const glm::vec3& eye, int map_texels);

/// Side of one texel of a map of `map_texels` [m].
[[nodiscard]] double shadow_texel_m(const ShadowFit& fit, int map_texels);

}  // namespace halfframe
