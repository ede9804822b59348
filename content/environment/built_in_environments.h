// Environments that are drawn by code: no file, no licence, the same everywhere.
#pragma once

#include <string_view>
#include <vector>

#include "content/environment/equirectangular.h"

namespace halfframe::content {

struct BuiltInEnvironment {
    std::string_view name;
    std::string_view purpose;
    /// Radiance from a unit direction.
    glm::dvec3 (*radiance)(const glm::dvec3& direction);
};
[[nodiscard]] const std::vector<BuiltInEnvironment>& built_in_environments();

[[nodiscard]] glm::dvec3 night_sky_radiance(const glm::dvec3& direction);
[[nodiscard]] glm::dvec3 studio_radiance(const glm::dvec3& direction);

/// 1024 x 512: pixels of a third of a degree, a twentieth of the narrowest lobe.
[[nodiscard]] Equirectangular drawn(const BuiltInEnvironment& environment);

}  // namespace halfframe::content
