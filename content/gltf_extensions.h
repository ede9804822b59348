// The extensions of glTF 2.0 that are read: looking them up, checking them, and what they change in a document.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "content/content.h"
#include "content/gltf_document.h"

namespace halfframe::content {

/// Extensions whose effect on the picture is complete here.
[[nodiscard]] std::span<const std::string_view> supported_extensions();

/// The extension object of `owner`, when it has one.
[[nodiscard]] std::optional<JsonPlace> extension(const JsonPlace& owner, std::string_view name);

/// Every reference, range and number inside extensions that this loader relies on. Error(input) at the first fault.
void check_gltf_extensions(const GltfDocument& document);
/// Parts of it.
void check_material_extensions(const JsonPlace& root, const JsonPlace& material);
void check_texture_transform(const JsonPlace& texture_use);
/// The texture that `owner` names under `key`, where it names one: of the core as of extensions.
void check_texture_use(const JsonPlace& root, const JsonPlace& owner, std::string_view key);

/// The compression of a buffer view (EXT_meshopt_compression, or its successor with the same streams).
[[nodiscard]] std::optional<JsonPlace> meshopt_of(const JsonPlace& buffer_view);
void check_meshopt(const JsonPlace& root);
/// Puts what compressed buffer views hold into buffers of their own. A damaged stream: Error(input).
void decode_meshopt(const GltfDocument& document, GltfResources& resources);

/// Notes the chosen scene and variant of the materials. A choice that the file does not offer: Error(usage) with those
/// that it does.
void apply_choices(GltfDocument& document, const LoadOptions& options);
/// The material that a variant gives a primitive (KHR_materials_variants); nothing: its own stays.
[[nodiscard]] std::optional<std::size_t> material_of_variant(const JsonPlace& primitive, std::size_t variant);

/// The light of a node (KHR_lights_punctual), placed; nothing where it has none.
[[nodiscard]] std::optional<Light> light_of_node(const GltfDocument& document, std::size_t node,
                                                 const glm::mat4& world_from_local);

}  // namespace halfframe::content
