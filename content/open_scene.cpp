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
    const std::optional<std::uint32_t>& seed = options.seed;
    std::vector<std::string> names;
    std::vector<std::string_view> seeded;
    for (const BuiltInScene& each : built_in_scenes()) {
        if (each.make_from != nullptr) seeded.push_back(each.name);
    }
    const auto expect_no_seed = [&] {
        if (seed) {
            throw Error(Fault::usage, fmt::format("{}: --seed {} means nothing to it; scenes made from a seed are {}",
                                                  scene, *seed, fmt::join(seeded, ", ")));
        }
    };
    for (const BuiltInScene& each : built_in_scenes()) {
        if (each.name == scene) {
            if (!options.scene.empty() || !options.variant.empty()) {
                throw Error(Fault::usage, fmt::format("{} is built in: --gltf-scene and --variant choose what of a "
                                                      ".gltf or .glb file is loaded; leave them out",
                                                      scene));
            }
            if (seed && each.make_from != nullptr) return each.make_from(*seed);
            expect_no_seed();
            return each.make();
        }
        names.emplace_back(each.name);
    }
    std::string ending = std::filesystem::path(scene).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".gltf" || ending == ".glb") {
        expect_no_seed();
        return load_gltf(scene, options);
    }
    throw Error(Fault::input,
                fmt::format("{}: neither a built-in scene{} nor a .gltf or .glb file; the built-in scenes are {}",
                            scene, did_you_mean(scene, names), fmt::join(names, ", ")));
}

}  // namespace halfframe::content
