// Names of a document, in the loader's words.
#include "perf/check/places.h"

#include <algorithm>

#include <fmt/format.h>

#include "content/gltf_document.h"

namespace halfframe::check {

Places::Places(const Scene& scene, const std::filesystem::path& file) : scene_(scene), is_file_(!file.empty()) {
    if (!is_file_) return;
    const content::GltfDocument document = content::read_gltf_document(file);
    const content::JsonPlace root = document.root();
    const auto named = [&](const char* key, const char* kind, Names& names) {
        content::for_each_object(root, key, [&](const content::JsonPlace& each, std::size_t index) {
            std::string name = each.has("name") ? each.at("name").text() : std::string();
            if (name.empty() && each.has("uri") && !each.at("uri").text().starts_with("data:")) {
                name = each.at("uri").text();
            }
            names.names.push_back(name.empty() ? fmt::format("{} {}", kind, index) : name);
        });
    };
    named("materials", "material", materials_);
    named("images", "image", images_);
    named("meshes", "mesh", meshes_);
}

std::string Places::find(const Names& names, const std::string& name) {
    const auto first = std::find(names.names.begin(), names.names.end(), name);
    if (first == names.names.end() || std::find(first + 1, names.names.end(), name) != names.names.end()) {
        return names.list;
    }
    return fmt::format("{}/{}", names.list, first - names.names.begin());
}

std::string Places::material(int index) const {
    return is_file_ ? find(materials_, scene_.materials[static_cast<std::size_t>(index)].name) : "";
}
std::string Places::image(int index) const {
    return is_file_ ? find(images_, scene_.images[static_cast<std::size_t>(index)].name) : "";
}
std::string Places::mesh(int index) const {
    return is_file_ ? find(meshes_, scene_.meshes[static_cast<std::size_t>(index)].name) : "";
}

}  // namespace halfframe::check
