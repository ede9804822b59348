// A cube of reflections as spherical harmonics, for what is so rough that vertices carry what it mirrors.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace halfframe {

/// What rough_reflection() in shaders_es/environment/environment_vertex.glsl reads: the factors of nine polynomials (bands 0
/// to 2, as those of EnvironmentMap::irradiance), then a unit axis, and the factors of Legendre's polynomials of band 3 and of
/// band 4 about it. rgb or xyz; w is 0.
using ReflectionHarmonics = std::array<glm::vec4, 12>;
/// Index of the axis: no light, and so not exposed.
inline constexpr std::size_t kHarmonicsAxis = 9;

/// `texels`: light of six faces of `side` x `side` texels, +X -X +Y -Y +Z -Z, rows as glTexImage2D takes them. The
/// projection of what a fetch shows in the middle of each texel, weighted by its solid angle; a cube of one light gives
/// that light to the bit. Three bands alone leave rings: a lobe ends at 90 degrees while it is still steep, and of a small lamp
/// they miss up to 0.4 of its mean over all directions. The axis is that about which bands 3 and 4 say most: one lamp's are
/// then complete, several lamps' in part, for 2 terms in the place of 16.
/// R. Ramamoorthi and P. Hanrahan, SIGGRAPH 2001; P.-P. Sloan, Stupid Spherical Harmonics Tricks, GDC 2008, appendix A2.
[[nodiscard]] ReflectionHarmonics reflection_harmonics(const std::vector<glm::vec3>& texels, int side);

}  // namespace halfframe
