// A checked glTF document in tinygltf's types, and the two things read from it: images and primitives.
//
// The types are filled here and not by tinygltf's own reader, which would write the JSON out and parse it a second
// time, and which takes what the checks refuse. tinygltf decodes the images.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <glm/gtc/quaternion.hpp>

#include "content/gltf_document.h"
#include "engine/frame/scene.h"

namespace halfframe::content {

/// Decoded 8-bit RGBA pixels; empty when nothing uses the image.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

struct GltfNode {
    std::string name;
    int mesh = -1;  ///< -1: none, as of the next two
    int camera = -1;
    int skin = -1;
    std::vector<int> children;
    std::optional<glm::mat4> matrix;  ///< in place of the next three
    glm::vec3 translation{0.0f};      ///< [m]
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    bool has_extensions = false;
    bool has_extras = false;
};

struct GltfModel {
    JsonSource source;
    tinygltf::Model model;  ///< its buffers and images have no bytes; its nodes are the next ones
    std::vector<GltfNode> nodes;
    std::vector<GltfBuffer> buffers;  ///< empty: without data
    std::vector<DecodedImage> images;

    /// Error(input) when the buffer behind the view has no data.
    void expect_data(std::size_t buffer_view) const;
};

/// `document` was checked. Decodes the images in `used_images`; their files are gone as soon as they are decoded.
[[nodiscard]] GltfModel parse_gltf_model(const GltfDocument& document, GltfResources resources,
                                         const std::set<std::size_t>& used_images);

/// Elements of an accessor as T = float or glm::vecN<float>, normalized integers as glTF 2.0 section 3.11 says. Missing
/// components are 1 (an alpha). Applies sparse replacement.
template <typename T>
[[nodiscard]] std::vector<T> read_elements(const GltfModel& gltf, int accessor);
[[nodiscard]] std::vector<std::uint32_t> read_indices(const GltfModel& gltf, int accessor);
/// Is none of them infinite or not a number?
[[nodiscard]] bool all_finite(std::span<const float> values);
/// Is every index less than `count`? Up to 2^31 - 1, far above kMostVertices.
[[nodiscard]] bool all_below(std::span<const std::uint32_t> indices, std::size_t count);
/// All components of all elements one after the other, normalized integers as above. Not for MAT2 and MAT3 of small
/// integers, whose columns are padded.
[[nodiscard]] std::vector<float> read_floats(const GltfModel& gltf, int accessor);

/// The last TEXCOORD set that is read.
inline constexpr int kLastUvSet = 1;

/// What a primitive needs from its material.
struct MaterialUv {
    std::array<bool, kLastUvSet + 1> reads{};  ///< which TEXCOORD sets
    std::optional<UvMapping> of_normal_map;    ///< none: tangents are neither kept nor made
};

/// Vertices and indices read so far, against the caps.
struct ReadSoFar {
    std::uint64_t vertices = 0;
    std::uint64_t indices = 0;
};

/// Nothing when there is nothing to draw; then a notice says why.
[[nodiscard]] std::optional<Mesh> read_primitive(const GltfModel& gltf, std::size_t mesh, std::size_t primitive,
                                                 const MaterialUv& needs, ReadSoFar& so_far,
                                                 std::vector<std::string>& notices);

/// Adds a sentence once.
void add_notice(std::vector<std::string>& notices, const std::string& sentence);

}  // namespace halfframe::content
