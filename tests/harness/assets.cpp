// Looks for the asset folders on disk.
#include "tests/harness/assets.h"

#include <algorithm>
#include <cstdlib>

namespace halfframe::harness {
namespace {

std::filesystem::path wished_assets_folder() {
    const char* wished = std::getenv("HALFFRAME_ASSETS");
    if (wished != nullptr && *wished != '\0') return wished;
    return std::filesystem::path(HALFFRAME_SOURCE_DIR).parent_path() / "shared" / "assets";
}

constexpr const char* kAssimpModels = "/usr/share/assimp/models/glTF2";

}  // namespace

std::optional<std::filesystem::path> assets_folder() {
    std::filesystem::path folder = wished_assets_folder();
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored)) return std::nullopt;
    return folder;
}

std::string assets_missing() {
    return "no test assets in " + wished_assets_folder().string() +
           ": set HALFFRAME_ASSETS to a folder that holds khronos/";
}

std::optional<std::filesystem::path> assimp_models_folder() {
    std::error_code ignored;
    if (!std::filesystem::is_directory(kAssimpModels, ignored)) return std::nullopt;
    return std::filesystem::path(kAssimpModels);
}

std::string assimp_models_missing() {
    return std::string("no models in ") + kAssimpModels + ": install the Debian package assimp-testmodels";
}

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (entry.is_regular_file() && (extension == ".gltf" || extension == ".glb")) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace halfframe::harness
