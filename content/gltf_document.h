// A glTF asset before its content is read: checked JSON, and the bytes it refers to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "content/gltf_buffer.h"
#include "content/json_place.h"

namespace halfframe::content {

// Caps. A file of a few bytes can ask for any amount of memory; these keep a load near 1 GiB at the very worst.
/// Any file read [bytes]: twice the 256 MiB of a whole PS3, so nothing this renderer can draw is larger.
inline constexpr std::uint64_t kMostFileBytes = 512ull << 20;
/// JSON text [bytes]: room for embedded buffers; as values it still fits in memory (16 bytes for each comma, twice
/// that for each member of an object).
inline constexpr std::uint64_t kMostJsonBytes = 128ull << 20;
/// All buffers together [bytes].
inline constexpr std::uint64_t kMostBufferBytes = 512ull << 20;
/// Elements of one accessor: one without a buffer view costs nothing in the file.
inline constexpr std::uint64_t kMostElements = 16ull << 20;
/// Vertices of all primitives together: 64 bytes each at most, 512 MiB.
inline constexpr std::uint64_t kMostVertices = 8ull << 20;
/// Indices of all primitives together: 4 bytes each, 128 MiB.
inline constexpr std::uint64_t kMostIndices = 32ull << 20;
/// A side of an image [pixels]: the largest texture of common drivers.
inline constexpr int kLargestImageSide = 16384;
/// One image [pixels]: 8192 x 8192; while it is decoded it exists three times.
inline constexpr std::uint64_t kLargestImagePixels = 64ull << 20;
/// All images together [pixels], 4 bytes each.
inline constexpr std::uint64_t kMostImagePixels = 128ull << 20;

struct GltfDocument {
    std::filesystem::path file;
    JsonSource source;
    JsonDocument json;
    std::optional<GltfBuffer> binary_chunk;  ///< GLB only
    std::vector<std::string> notices;
    std::optional<std::size_t> chosen_scene;    ///< in place of the default one
    std::optional<std::size_t> chosen_variant;  ///< of the materials (KHR_materials_variants)

    [[nodiscard]] JsonPlace root() const { return {json, source}; }
    [[nodiscard]] bool uses_extension(std::string_view name) const;
};

/// Reads and parses the file, .gltf or .glb by its content. glTF 1.0, a damaged GLB, bad JSON: Error(input).
[[nodiscard]] GltfDocument read_gltf_document(const std::filesystem::path& file);

/// Version, extensions, and every reference, range and number that this loader relies on. Error(input) at the first
/// fault; notices for what is legal but left out.
void check_gltf(GltfDocument& document);
/// The parts of check_gltf(): buffers to materials; meshes to scenes; then skins, morph targets and animations.
void check_gltf_data(const GltfDocument& document);
void check_gltf_scenes(const GltfDocument& document);
void check_gltf_motion(const GltfDocument& document);

/// The bytes of buffers and images, in the order of the document. An image that lies in a buffer view stays empty here.
/// So does a buffer without data, which glTF allows; it is an error only when something is read from it.
struct GltfResources {
    /// A buffer view that was compressed, and the buffer that holds all of it and nothing else.
    struct UnpackedView {
        std::size_t view = 0;
        std::size_t buffer = 0;
    };
    std::vector<GltfBuffer> buffers;  ///< of the document, then those of unpacked views
    std::vector<Bytes> images;
    std::vector<UnpackedView> unpacked_views;
};
/// Reads data URIs, files beside the asset and the GLB's binary chunk. A file must lie in the asset's folder or below,
/// by name and after symbolic links are followed.
/// The chunk is moved out of the document.
[[nodiscard]] GltfResources read_gltf_resources(GltfDocument& document);

/// Size of one element of an accessor [bytes] with the padding of matrix columns; `type` as in glTF ("VEC3", "MAT2").
[[nodiscard]] std::uint64_t element_bytes(std::uint64_t component_type, const std::string& type);
[[nodiscard]] std::uint64_t component_bytes(std::uint64_t component_type);

/// The array behind a root key, or nothing.
[[nodiscard]] inline std::size_t count_of(const JsonPlace& root, std::string_view key) {
    const std::optional<JsonPlace> array = root.find(key);
    return array ? array->size() : 0;
}

/// The name of an object of the document; empty where it has none that is a string.
[[nodiscard]] std::string name_of(const JsonPlace& object);

/// Calls visit(element, index) for each element of the array `key`, when there is one; each must be an object.
template <typename Visit>
void for_each_object(const JsonPlace& owner, std::string_view key, Visit&& visit) {
    if (const std::optional<JsonPlace> array = owner.find(key)) {
        for (std::size_t i = 0; i < array->size(); ++i) {
            const JsonPlace element = array->at(i);
            element.expect_object();
            visit(element, i);
        }
    }
}

/// The index behind `key`, when there is one; it must be below `count` ("meshes" names what is counted).
[[nodiscard]] std::optional<std::size_t> index_in(const JsonPlace& owner, std::string_view key, std::size_t count,
                                                  std::string_view what);

}  // namespace halfframe::content
