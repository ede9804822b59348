// Finds the models that tests read but the repository does not hold.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace halfframe::harness {

/// The folder of test assets: environment HALFFRAME_ASSETS, else ../shared/assets beside the source folder.
/// Nothing when it is not there: tests then skip with assets_missing().
[[nodiscard]] std::optional<std::filesystem::path> assets_folder();
/// The sentence of that skip: which folder was looked for and what to set.
[[nodiscard]] std::string assets_missing();

/// The glTF 2.0 models of Debian's assimp-testmodels, nothing when the package is not installed.
[[nodiscard]] std::optional<std::filesystem::path> assimp_models_folder();
[[nodiscard]] std::string assimp_models_missing();

/// Every .gltf and .glb file below `folder`, sorted by path, so that a list of them is the same on every machine.
[[nodiscard]] std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder);

}  // namespace halfframe::harness
