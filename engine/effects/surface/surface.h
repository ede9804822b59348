// START HERE: surface shades everything that has a mesh: direct light, constant ambient, emission.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kSurface;

/// The programs of surface, which transparent draws with too. One list, so that both are checked alike.
[[nodiscard]] std::span<const ShaderVariant> surface_shaders(Tier tier);

/// How many surfaces blend with what is behind them; the others hide it.
[[nodiscard]] int count_blended(const Scene& scene);

/// What a light is, as something to sort by: the brightest first, then by place and direction.
[[nodiscard]] std::array<float, 7> order_of(const Light& light);

/// Fills `lights` with those that reach `box` (world, [m]), strongest first and equal ones in the order of order_of(),
/// so that the order in a file moves nothing; at most `limit`; suns are not among them.
/// `left_out` counts those that reach it and had no place. Allocates nothing where `lights` has room for limit + 1.
void lights_reaching(const Scene& scene, const Box& box, std::size_t limit, std::vector<int>& lights, int& left_out);

}  // namespace halfframe
