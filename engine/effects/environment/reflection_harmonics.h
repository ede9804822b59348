// A cube of reflections as spherical harmonics, for what is so rough that vertices carry what it mirrors.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace halfframe {

/// What rough_reflection() in shaders_es/environment/environment_vertex.glsl reads: the factors of nine polynomials (bands 0
/// to 2, as those of EnvironmentMap::irradiance), then a unit axis, and the factors of Legendre's polynomials of band 3 and of
/// band 4 about it; they add up to the root of the light. rgb or xyz; w is 0.
using ReflectionHarmonics = std::array<glm::vec4, 12>;
/// Index of the axis: no light, and so not exposed; the others grow with the root of the exposure.
inline constexpr std::size_t kHarmonicsAxis = 9;

/// `light`: >= 0, of six faces of `side` x `side` texels, +X -X +Y -Y +Z -Z, rows as glTexImage2D takes them. The
/// projection of the root of what a fetch shows in the middle of each texel, weighted by its solid angle; of a cube of one light
/// it is the root to the bit. The root has half the stops of the light: what harmonics leave out beside a bright lamp is small
/// then, and their square is never negative, where harmonics of the light itself left black rings.
/// Three bands alone leave rings: a lobe ends at 90 degrees while it is still steep. The axis is that about which bands 3 and 4
/// say most: one lamp's are then complete, several lamps' in part, for 2 terms in the place of 16.
/// R. Ramamoorthi and P. Hanrahan, SIGGRAPH 2001; P.-P. Sloan, Stupid Spherical Harmonics Tricks, GDC 2008, appendix A2.
[[nodiscard]] ReflectionHarmonics reflection_harmonics(const std::vector<glm::vec3>& light, int side);

}  // namespace halfframe
