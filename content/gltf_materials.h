// Materials of a glTF document as Scene materials, with their images.
#pragma once

#include <map>
#include <set>
#include <utility>

#include "content/gltf_model.h"

namespace halfframe::content {

/// The image indices that the materials' textures lead to.
[[nodiscard]] std::set<std::size_t> images_used_by_materials(const GltfDocument& document);

/// Texture coordinates that a material's textures are read with. -1 is the default material.
[[nodiscard]] MaterialUv uv_of_material(const GltfDocument& document, int material);

/// Converts materials on demand, each once. Not copyable: it fills the one scene it was given.
class GltfMaterials {
public:
    GltfMaterials(const GltfDocument& document, GltfModel& gltf, Scene& scene)
        : document_(document), gltf_(gltf), scene_(scene) {}
    GltfMaterials(const GltfMaterials&) = delete;
    GltfMaterials& operator=(const GltfMaterials&) = delete;

    /// Index in Scene::materials of a material of the document; -1 gives the default material of glTF 2.0.
    [[nodiscard]] int scene_material(int material);

private:
    Material converted(int material);
    Texture scene_texture(int texture, bool srgb);
    int scene_image(int image, bool srgb);

    const GltfDocument& document_;
    GltfModel& gltf_;
    Scene& scene_;
    std::map<int, int> materials_;
    std::map<std::pair<int, bool>, int> images_;
};

}  // namespace halfframe::content
