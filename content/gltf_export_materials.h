// Materials of a scene as those of a glTF file.
#pragma once

#include <map>
#include <vector>

#include "content/glb_writer.h"
#include "engine/frame/scene.h"

namespace halfframe::content {

/// The smallest power of two that is not below the largest channel, at least 1: dividing by it is exact.
[[nodiscard]] float export_scale(const glm::vec3& color);

class MaterialExporter {
public:
    MaterialExporter(const Scene& scene, GlbWriter& file) : scene_(scene), file_(file) {}
    /// An entry of `materials`; textures and images that it needs are in the file then.
    [[nodiscard]] nlohmann::json material_of(const Material& material);

private:
    std::size_t texture_of(const Texture& texture);
    std::size_t image_of(int index);
    void add_texture(nlohmann::json& owner, const char* key, const Texture& texture, const UvMapping& uv);
    void add_model(nlohmann::json& result, const Material& material);
    void add_water(nlohmann::json& result, const Material& material);

    const Scene& scene_;
    GlbWriter& file_;
    std::vector<Texture> textures_;
    std::map<int, std::size_t> images_;
};

}  // namespace halfframe::content
