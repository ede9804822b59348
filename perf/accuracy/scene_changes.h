// Changes of a scene that must not change its picture, or change it in a known way.
#pragma once

#include "engine/frame/scene.h"

namespace halfframe::accuracy {

/// A scene, the camera it is seen with, and the size of its picture.
struct Shot {
    Scene scene;
    Camera camera;
    int width = 160;  ///< [pixels]
    int height = 90;
};

/// Everything further along by `offset` [the scene's unit of length], what moves and its course too. Places are floats:
/// 10 km from the origin they keep steps of half a millimetre to one millimetre, in every unit.
[[nodiscard]] Shot moved(Shot shot, const glm::dvec3& offset);

/// The shot with the places that moved() leaves of it, brought back: its picture is what moved() can show at best.
[[nodiscard]] Shot with_places_of(Shot shot, const glm::dvec3& offset);

/// Lengths are `per_metre` times as many: 100 says centimetres. A lamp's colour is what a white surface shows at a
/// distance of one, so it grows with the square; a sun's stays.
[[nodiscard]] Shot in_units(Shot shot, double per_metre);

/// Turned about +Y by quarters of a circle, camera, sun and lamps too. Exact: no number is rounded.
[[nodiscard]] Shot turned(Shot shot, int quarters);

/// The lights in the opposite order.
[[nodiscard]] Shot with_lights_reversed(Shot shot);

/// Every lamp as two of half its colour at the same place. The sun stays one: only one is drawn.
[[nodiscard]] Shot with_lamps_halved(Shot shot);

/// No lamps, the sun alone.
[[nodiscard]] Shot without_lamps(Shot shot);

/// Every lamp a volume of no size: a range of 0.
[[nodiscard]] Shot with_lamps_of_no_range(Shot shot);

/// Every light, the sun too, times `factor`; the ambient, the emission and the exposure stay.
[[nodiscard]] Shot with_lights_times(Shot shot, float factor);

/// Lights, ambient, environment and emission times `factor`, the exposure divided by it.
[[nodiscard]] Shot exposed_for(Shot shot, float factor);

/// Each indexed triangle mesh with more triangles that have no area: one vertex three times, one edge there and back,
/// and three corners on a line, the new corners with neither normal nor tangent.
[[nodiscard]] Shot with_empty_triangles(Shot shot);

/// The first animation at `time_s`, played round and round.
[[nodiscard]] Shot at_time(Shot shot, double time_s);

/// The same eye and target with another field of view [rad].
[[nodiscard]] Shot with_field_of_view(Shot shot, float fov_y_rad);

}  // namespace halfframe::accuracy
