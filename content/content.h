// What is drawn: glTF files, built-in scenes, and the data files of content/ (devices, budgets).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/budget.h"
#include "engine/frame/scene.h"
#include "engine/gl/caps.h"

namespace halfframe::content {

/// Reads a .gltf or .glb file. Bad or unsupported input: Error(input) that names the file, the place in it (JSON
/// pointer or byte) and what to try. What the format allows and this loader leaves out is a sentence in Scene::notices.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& file);

struct BuiltInScene {
    std::string_view name;
    std::string_view purpose;
    Scene (*make)();
};
[[nodiscard]] const std::vector<BuiltInScene>& built_in_scenes();

/// A built-in name, or a path that ends in .gltf or .glb. Unknown: Error(input) with the names there are.
[[nodiscard]] Scene open_scene(const std::string& scene);

/// Lights for a scene that brings none: the documented `studio` rig, a sun, two points and an ambient, sized to the
/// scene's box. Does nothing to a scene that has lights or an ambient. Returns true when it was added.
bool add_studio_rig(Scene& scene);

/// A device mask by name (native|es3-minimum|es2-mali400-class|es2-minimum) or from a JSON file path.
[[nodiscard]] gl::DeviceProfile device_profile(const std::string& name_or_path);
[[nodiscard]] std::vector<std::string> device_profile_names();

/// The built-in budget "ps3_30fps", or a JSON file path. Unknown keys are errors that name the key.
[[nodiscard]] Budget budget(const std::string& name_or_path);

}  // namespace halfframe::content
