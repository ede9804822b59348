// What storing vertices in 16 and 8 bits, and colour textures in blocks, spares and loses.
#include <algorithm>
#include <set>

#include "engine/frame/texture_storage.h"
#include "engine/frame/vertex_storage.h"
#include "perf/check/check.h"

namespace halfframe::check {
namespace {

void keep_worst(Worst& worst, double error, const std::string& where) {
    if (error > worst.error) worst = {error, where};
}

void add_vertices(const Scene& scene, StorageFigures& figures) {
    std::vector<std::string> notices;
    const std::vector<MeshStorage> planned = plan_vertex_storage(scene, VertexPrecision::half, notices);
    for (const std::string& sentence : notices) {
        if (sentence.find("keeps 32-bit positions") != std::string::npos) figures.why_full_positions = sentence;
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const StorageError error = storage_error(mesh, planned[i]);
        figures.vertex_bytes_before += error.bytes_full;
        figures.vertex_bytes_after += error.bytes_stored;
        figures.full_positions += planned[i].positions == StreamFormat::float32 ? 1u : 0u;
        keep_worst(figures.positions_mm, error.worst_mm, mesh.name);
        keep_worst(figures.normals_degrees, error.worst_normal_degrees, mesh.name);
        keep_worst(figures.tangents_degrees, error.worst_tangent_degrees, mesh.name);
        const bool textured = planned[i].uv_texels.x > 0.0 || planned[i].uv1_texels.x > 0.0;
        if (textured) keep_worst(figures.coordinates_texels, error.worst_uv_texels, mesh.name);
        keep_worst(figures.colors_codes, error.worst_color_codes, mesh.name);
    }
}

std::set<int> color_images(const Scene& scene) {
    std::set<int> images;
    for (const Surface& surface : scene.surfaces) {
        const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
        for (const Texture* texture : {&material.base_color_texture, &material.emissive_texture,
                                       &material.specular_color_texture, &material.specular_smoothness_texture}) {
            if (*texture) images.insert(texture->image);
        }
    }
    return images;
}

void add_textures(const Scene& scene, const Request& request, StorageFigures& figures) {
    const std::vector<int> dropped = request.most_texture_bytes ? levels_to_drop(scene, *request.most_texture_bytes)
                                                                : std::vector<int>(scene.images.size(), 0);
    for (const int index : color_images(scene)) {
        const auto at = static_cast<std::size_t>(index);
        const Image& image = scene.images[at];
        ++figures.color_images;
        std::vector<Image> levels = mip_chain(image, TexelKind::color, std::nullopt);
        for (const Image& level : levels) figures.texture_bytes_before += level.rgba.size();
        std::size_t first =
            std::min<std::size_t>(static_cast<std::size_t>(std::max(dropped[at], 0)), levels.size() - 1);
        while (request.largest_texture && first + 1 < levels.size() &&
               std::max(levels[first].width, levels[first].height) > *request.largest_texture) {
            ++first;
        }
        figures.smaller_images += first > 0 ? 1u : 0u;
        const bool with_alpha = has_alpha(image);
        for (std::size_t level = first; level < levels.size(); ++level) {
            const CompressedImage blocks = compressed(levels[level], with_alpha);
            figures.texture_bytes_after += blocks.blocks.size();
            if (level > first) continue;
            const TexelError error = texel_error(levels[level], decompressed(blocks));
            keep_worst(figures.texture_rms_codes, error.rms_codes, image.name);
            keep_worst(figures.texture_worst_codes, error.worst_codes, image.name);
        }
    }
}

}  // namespace

void check_storage(const Scene& scene, const Request& request, Report& report) {
    add_vertices(scene, report.storage);
    add_textures(scene, request, report.storage);
}

}  // namespace halfframe::check
