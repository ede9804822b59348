// An environment brighter or dimmer by a factor.
#pragma once

#include <optional>

#include "engine/frame/scene.h"

namespace halfframe::content {

/// Multiplies radiance and irradiance. `strength`: >= 0.
void multiply(EnvironmentMap& map, float strength);

/// The strength that makes `map` of `original`, to the last bit; none: `map` is not that environment in another strength.
[[nodiscard]] std::optional<float> strength_between(const EnvironmentMap& original, const EnvironmentMap& map);

}  // namespace halfframe::content
