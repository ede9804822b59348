// Light for a scene: the environment that --environment names, and the studio rig where there would be none.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "engine/frame/scene.h"

namespace halfframe::cli {

/// `wished` is the value of --environment: a built-in name or a .hdr or .exr file, which replaces the scene's own;
/// "none" takes it away; empty leaves it. A scene that has no light at all then gets the studio rig with its
/// environment (with a constant ambient after "none"). `between` hears a word for the user from time to time and throws
/// to stop.
void light(Scene& scene, const std::string& wished, const std::filesystem::path& cache_folder,
           const std::function<void(const std::string&)>& between);

}  // namespace halfframe::cli
