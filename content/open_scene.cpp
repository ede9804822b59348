// A scene by built-in name or by path.
#include "content/content.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "content/nearest.h"
#include "engine/error.h"

namespace halfframe::content {

Scene open_scene(const std::string& scene, const LoadOptions& options) {
    std::vector<std::string> names;
    for (const BuiltInScene& each : built_in_scenes()) {
        if (each.name == scene) {
            if (!options.scene.empty() || !options.variant.empty()) {
                throw Error(Fault::usage, fmt::format("{} is built in: --gltf-scene and --variant choose what of a "
                                                      ".gltf or .glb file is loaded; leave them out",
                                                      scene));
            }
            return each.make();
        }
        names.emplace_back(each.name);
    }
    std::string ending = std::filesystem::path(scene).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".gltf" || ending == ".glb") {
        return load_gltf(scene, options);
    }
    throw Error(Fault::input,
                fmt::format("{}: neither a built-in scene{} nor a .gltf or .glb file; the built-in scenes are {}",
                            scene, did_you_mean(scene, names), fmt::join(names, ", ")));
}

}  // namespace halfframe::content
