// Writes water that never changes into materials and their textures.
#pragma once

#include <string>

#include "engine/frame/effect_card.h"

namespace halfframe {

/// Why the textures of a material cannot hold its water, to follow "because"; empty: they can.
[[nodiscard]] std::string obstacle_to_writing(const Scene& scene, const Material& material);

/// Roughness 0..1 of a smoothness 0..1: the way back from smoothness_of().
[[nodiscard]] float roughness_of(float smoothness);

/// The mean porosity of a material over its textures, 0..1.
[[nodiscard]] float mean_porosity(const Scene& scene, const Material& material);

/// `changes.materials` with the water of those whose WaterPath is written: albedo darker, roughness less, by a factor
/// where all texels are alike and by new images where not. What is written takes up no more water.
void write_wetness(const Scene& scene, MaterialChanges& changes);

/// The scene with that done, whole: with the new images behind its own. Its wetness stays
/// only where some material still shows it live.
[[nodiscard]] Scene with_written_wetness(const Scene& scene);

}  // namespace halfframe
