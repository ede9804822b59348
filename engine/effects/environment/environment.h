// START HERE: environment lights surfaces from a prefiltered map: spherical harmonics for the diffuse part, a cube
// whose levels were smoothed by cosine powers for reflections.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kEnvironment;

/// A texel of RGBM8 as the shaders unpack it: light = (rgb / 255 * a / 255 * root_range)^2. The multiplier is rounded
/// up, so that no channel overflows; NaN and negatives become 0, light above root_range^2 is cut.
[[nodiscard]] std::array<std::uint8_t, 4> packed_rgbm(const glm::vec3& light, float root_range);

/// The level of `map` whose smoothness is nearest to `smoothness` 0..1, among those at most `largest_size` texels a
/// side.
[[nodiscard]] int level_for(const EnvironmentMap& map, float smoothness, int largest_size);

/// The step of ENVIRONMENT_STEPS a level that a surface of one smoothness 0..1 reads, 0 for the sharpest: its level as
/// the shader's reflection_level() gives it, rounded.
[[nodiscard]] int level_step(const EnvironmentMap& map, float smoothness);

/// The cube of a step: between two levels both are blended in linear light, the coarse one filtered as a sampler does.
/// As large as the finer one.
[[nodiscard]] std::vector<glm::vec3> texels_of_step(const EnvironmentMap& map, int step);

}  // namespace halfframe
