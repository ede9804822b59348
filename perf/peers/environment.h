// An .hdr file as the light of a compared scene, brought to the same mean for everybody.
#pragma once

#include <filesystem>
#include <string>

#include <glm/glm.hpp>

#include "engine/frame/scene.h"

namespace halfframe::peers {

/// Mean radiance over the sphere of an equirectangular .hdr file, linear. Unreadable: Error(input).
[[nodiscard]] glm::vec3 mean_radiance(const std::filesystem::path& hdr);

/// Lights `scene` with `hdr` times `scale`, and with no ambient beside it.
void add_environment(Scene& scene, const std::filesystem::path& hdr, float scale);

}  // namespace halfframe::peers
