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

struct Size {
    int width = 0;
    int height = 0;
};

/// Of level 0 and all smaller ones.
std::vector<Size> level_sizes(const Image& image) {
    std::vector<Size> sizes{{image.width, image.height}};
    while (sizes.back().width > 1 || sizes.back().height > 1)
        sizes.push_back({std::max(sizes.back().width / 2, 1), std::max(sizes.back().height / 2, 1)});
    return sizes;
}

/// What compressing loses of the level, which is the largest that is kept.
TexelError compression_error(const Image& image, const std::vector<Size>& sizes, std::size_t level, bool with_alpha) {
    Image smaller;
    for (std::size_t i = 1; i <= level; ++i)
        smaller = reduced(i == 1 ? image : smaller, sizes[i].width, sizes[i].height, TexelKind::color);
    const Image& kept = level == 0 ? image : smaller;
    return texel_error(kept, decompressed(compressed(kept, with_alpha)));
}

void add_textures(const Scene& scene, const Request& request, StorageFigures& figures) {
    const std::vector<int> dropped = request.most_texture_bytes ? levels_to_drop(scene, *request.most_texture_bytes)
                                                                : std::vector<int>(scene.images.size(), 0);
    for (const int index : color_images(scene)) {
        const auto at = static_cast<std::size_t>(index);
        const Image& image = scene.images[at];
        ++figures.color_images;
        const std::vector<Size> sizes = level_sizes(image);
        for (const Size& size : sizes)
            figures.texture_bytes_before +=
                4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
        std::size_t first = std::min<std::size_t>(static_cast<std::size_t>(std::max(dropped[at], 0)), sizes.size() - 1);
        while (request.largest_texture && first + 1 < sizes.size() &&
               std::max(sizes[first].width, sizes[first].height) > *request.largest_texture) {
            ++first;
        }
        figures.smaller_images += first > 0 ? 1u : 0u;
        const bool with_alpha = has_alpha(image);
        for (std::size_t level = first; level < sizes.size(); ++level)
            figures.texture_bytes_after += compressed_bytes(sizes[level].width, sizes[level].height, with_alpha);
        const TexelError error = compression_error(image, sizes, first, with_alpha);
        keep_worst(figures.texture_rms_codes, error.rms_codes, image.name);
        keep_worst(figures.texture_worst_codes, error.worst_codes, image.name);
    }
}

}  // namespace

void check_storage(const Scene& scene, const Request& request, Report& report) {
    add_vertices(scene, report.storage);
    add_textures(scene, request, report.storage);
}

}  // namespace halfframe::check
