// What a prefiltered environment must be, worked out in another way: a sky that is a formula, integrated in double, and
// cube maps looked up as OpenGL ES 2.0 does. Shares no code with content/environment.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "content/environment/equirectangular.h"
#include "engine/frame/scene.h"

namespace halfframe::tests {

/// A gradient that differs by channel, and a sun.
struct FormulaSky {
    glm::dvec3 sun_direction = glm::normalize(glm::dvec3(0.31, 0.52, -0.79));
    double sun_radius_rad = 0.010;
    glm::dvec3 sun_radiance{3000.0, 2600.0, 2000.0};
    glm::dvec3 slope = glm::normalize(glm::dvec3(0.2, 0.9, 0.4));  ///< the way the gradient rises
};

[[nodiscard]] glm::dvec3 gradient_radiance(const FormulaSky& sky, const glm::dvec3& direction);

/// Mean radiance under the lobe max(axis.l, 0)^power. Power 1 about the normal is what a white Lambert surface shows.
[[nodiscard]] glm::dvec3 lobe_integral(const FormulaSky& sky, const glm::dvec3& axis, double power);

/// The sky as a picture: every pixel is the mean over its solid angle.
[[nodiscard]] content::Equirectangular picture_of(const FormulaSky& sky, int height);

/// A place on a face, s and t of 0..1 as in OpenGL ES 2.0, table 3.21.
struct FacePlace {
    int face = 0;
    double s = 0.0;
    double t = 0.0;
};
[[nodiscard]] FacePlace place_on_face(const glm::dvec3& direction, int face);
[[nodiscard]] FacePlace place_of(const glm::dvec3& direction);
/// Where texel (x, y) of a face gathers its light: its centre, moved by u' = s^2 / (s - 1)^3 u^3 + u.
[[nodiscard]] glm::dvec3 texel_direction(int face, int x, int y, int size, bool warped = true);

/// Bilinear inside the face alone, clamped at its edges.
[[nodiscard]] glm::dvec3 sampled(const EnvironmentMap& map, std::size_t level, const FacePlace& place);

/// The largest relative difference between texels of `level` and the lobe of `power`; every `stride`-th texel.
[[nodiscard]] double lobe_error(const EnvironmentMap& map, std::size_t level, double power, const FormulaSky& sky,
                                std::size_t stride);

/// The largest relative difference between what the two faces of an edge show along it.
[[nodiscard]] double seam_error(const EnvironmentMap& map, std::size_t level);

/// EnvironmentMap::irradiance as a surface of normal `n` shows it.
[[nodiscard]] glm::dvec3 shown_by_lambert(const EnvironmentMap& map, const glm::dvec3& n);

/// Directions spread evenly over the sphere (a Fibonacci spiral).
[[nodiscard]] std::vector<glm::dvec3> even_directions(int count);

/// Largest difference of the channels, relative to the larger channel of `expected`.
[[nodiscard]] double relative_error(const glm::dvec3& actual, const glm::dvec3& expected);

}  // namespace halfframe::tests
