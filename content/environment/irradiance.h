// The diffuse part of an environment: nine spherical harmonics, folded into a polynomial of the normal.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "content/environment/light_taps.h"

namespace halfframe::content {

struct Irradiance {
    /// As EnvironmentMap::irradiance.
    std::array<glm::dvec3, 9> terms{};
    /// Strength of the window that keeps the dark side from ringing; 0: none was needed.
    double window = 0.0;
};

/// Projects the light onto bands 0 to 2 and convolves it with the cosine (R. Ramamoorthi and P. Hanrahan, SIGGRAPH
/// 2001). Light from one side rings below zero on the other, or leaves it darker than it is: then band l is divided by
/// 1 + window l^2 (l + 1)^2 (P.-P. Sloan, "Stupid Spherical Harmonics Tricks", GDC 2008), with the least window that
/// leaves the darkest side three quarters of its light in all three channels, the same for each so that no hue changes.
[[nodiscard]] Irradiance irradiance(const LightTaps& light);

/// A bound that one channel of the polynomial, over all unit normals, does not go below; it is reached within 1e-9 of
/// the largest term.
[[nodiscard]] double lowest_value(const std::array<double, 9>& terms);

}  // namespace halfframe::content
