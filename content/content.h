// What is drawn: glTF files, built-in scenes, environments, and the data files of content/ (devices, budgets).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/budget.h"
#include "engine/frame/cost_table.h"
#include "engine/frame/scene.h"
#include "engine/gl/caps.h"

namespace halfframe::content {

/// What of a glTF file is loaded.
struct LoadOptions {
    std::string scene = {};    ///< by name, or by number from 0; empty: the file's default scene
    std::string variant = {};  ///< of its materials (KHR_materials_variants), by name or number; empty: the file's own
    std::optional<std::uint32_t> seed = std::nullopt;  ///< of a built-in scene that is made from one; empty: its own
};

/// Reads a .gltf or .glb file. Bad or unsupported input: Error(input) that names the file, the place in it (JSON
/// pointer or byte) and what to try. A choice that the file does not offer: Error(usage). What the format allows and
/// this loader leaves out is a sentence in Scene::notices.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& file, const LoadOptions& options = {});

/// `scene` as the bytes of a GLB file that loads back to the same frame: float32 streams, PNG images, extensions where
/// the scene needs them, extras for the rest. What not_exported() says is left out.
[[nodiscard]] std::string gltf_binary(const Scene& scene);
/// What gltf_binary() leaves out of `scene`, one sentence each.
[[nodiscard]] std::vector<std::string> not_exported(const Scene& scene);

struct BuiltInScene {
    std::string_view name;
    std::string_view purpose;
    Scene (*make)();                                   ///< with the seed it has by itself, if it has one
    Scene (*make_from)(std::uint32_t seed) = nullptr;  ///< none: it is the same always
};
[[nodiscard]] const std::vector<BuiltInScene>& built_in_scenes();

/// A built-in name, or a path that ends in .gltf or .glb. Unknown: Error(input) with the names there are. Options that
/// mean nothing to the scene: Error(usage).
[[nodiscard]] Scene open_scene(const std::string& scene, const LoadOptions& options = {});

/// Lights for a scene that brings none: the documented `studio` rig, a sun, two points and an ambient, sized to the
/// scene's box. An `environment` (the built-in one called studio goes with it) takes the place of the ambient, so that
/// metals have something to reflect. Does nothing to a scene that has lights, an ambient or an environment. Returns
/// true when it was added.
bool add_studio_rig(Scene& scene, std::optional<EnvironmentMap> environment = std::nullopt);

struct EnvironmentOptions {
    int size = 128;                        ///< texels a side of level 0: 16, 32, 64, 128, 256 or 512
    int threads = 0;                       ///< 0: as many as the machine has. The result is the same
    std::filesystem::path cache_folder;    ///< keeps results by content; empty: nothing is kept
    std::function<void(double)> progress;  ///< hears 0..1 on the caller's thread; throw to stop, it comes out again
};

struct LoadedEnvironment {
    EnvironmentMap map;
    std::vector<std::string> notices;  ///< what was mended or softened, one sentence each
    bool from_cache = false;
};

/// A built-in environment by name, or an equirectangular .hdr or .exr file, prefiltered (content/environment). Takes a
/// second or so when the cache does not have it. Bad file or unknown name: Error(input); bad option: Error(usage).
[[nodiscard]] LoadedEnvironment environment(const std::string& name_or_file, const EnvironmentOptions& options = {});
[[nodiscard]] std::vector<std::string> environment_names();

/// A device mask by name (native|es3-minimum|es2-mali400-class|es2-minimum) or from a JSON file path.
[[nodiscard]] gl::DeviceProfile device_profile(const std::string& name_or_path);
[[nodiscard]] std::vector<std::string> device_profile_names();

/// The built-in budget "ps3_30fps", or a JSON file path. Unknown keys are errors that name the key.
[[nodiscard]] Budget budget(const std::string& name_or_path);

/// What effects cost on devices that are not here, as the cost model counted them in the built-in scenes: "prices", or
/// a JSON file path. For estimate_frame() and budgeted_tiers() (engine/frame/cost_table.h).
[[nodiscard]] CostTable cost_table(const std::string& name_or_path = "prices");

}  // namespace halfframe::content
