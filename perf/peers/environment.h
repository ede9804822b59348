// What an .hdr file lights a scene with here: the environment effect where this build has it, else its mean as ambient.
#pragma once

#include <filesystem>
#include <string>

#include <glm/glm.hpp>

#include "engine/frame/scene.h"

namespace halfframe::peers {

/// Mean radiance over the sphere of an equirectangular .hdr file, linear. Unreadable: Error(input).
[[nodiscard]] glm::vec3 mean_radiance(const std::filesystem::path& hdr);

/// Lights `scene` with `hdr` times `scale`. Returns "environment", or "ambient" where this build draws no environments.
std::string add_environment(Scene& scene, const std::filesystem::path& hdr, float scale);

}  // namespace halfframe::peers
