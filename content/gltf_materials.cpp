// Materials, textures, samplers, images.
#include "content/gltf_materials.h"

#include <array>

#include <fmt/format.h>

namespace halfframe::content {
namespace {

/// The texture uses of a material that are read, in order of importance.
struct Slot {
    const char* owner;  ///< key around it, or nothing
    const char* key;
};
constexpr std::array<Slot, 4> kSlots{{{"pbrMetallicRoughness", "baseColorTexture"},
                                      {"pbrMetallicRoughness", "metallicRoughnessTexture"},
                                      {nullptr, "normalTexture"},
                                      {nullptr, "emissiveTexture"}}};

template <typename Visit>
void for_each_texture_use(const JsonPlace& material, Visit&& visit) {
    for (const Slot& slot : kSlots) {
        if (slot.owner == nullptr || material.has(slot.owner)) {
            const JsonPlace owner = slot.owner == nullptr ? material : material.at(slot.owner);
            if (owner.has(slot.key)) {
                visit(owner.at(slot.key));
            }
        }
    }
}

Wrap wrap_of(int wrap) {
    switch (wrap) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Wrap::clamp;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Wrap::mirror;
        default: return Wrap::repeat;
    }
}

/// The Scene has one filter for inside a level and magnification: the file's magFilter, else its minFilter's.
void apply_sampler(const tinygltf::Sampler& sampler, Texture& texture) {
    texture.wrap_u = wrap_of(sampler.wrapS);
    texture.wrap_v = wrap_of(sampler.wrapT);
    const int min = sampler.minFilter;
    const bool min_is_nearest = min == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                                min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                                min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    texture.linear = sampler.magFilter >= 0 ? sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST : !min_is_nearest;
    texture.mipmaps = min != TINYGLTF_TEXTURE_FILTER_NEAREST && min != TINYGLTF_TEXTURE_FILTER_LINEAR;
}

glm::vec3 vec3_of(const std::vector<double>& numbers) {
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

/// KHR_materials_emissive_strength, a plain factor.
float emissive_strength(const GltfDocument& document, int material) {
    const JsonPlace place = document.root().at("materials").at(static_cast<std::size_t>(material));
    if (!place.has("extensions") || !place.at("extensions").has("KHR_materials_emissive_strength")) {
        return 1.0f;
    }
    const JsonPlace extension = place.at("extensions").at("KHR_materials_emissive_strength");
    return extension.has("emissiveStrength") ? static_cast<float>(extension.at("emissiveStrength").number()) : 1.0f;
}

}  // namespace

std::set<std::size_t> images_used_by_materials(const GltfDocument& document) {
    const JsonPlace root = document.root();
    std::set<std::size_t> used;
    for_each_object(root, "materials", [&](const JsonPlace& material, std::size_t) {
        for_each_texture_use(material, [&](const JsonPlace& use) {
            const JsonPlace texture = root.at("textures").at(static_cast<std::size_t>(use.at("index").whole()));
            if (texture.has("source")) {
                used.insert(static_cast<std::size_t>(texture.at("source").whole()));
            }
        });
    });
    return used;
}

int uv_set_of_material(const GltfDocument& document, int material) {
    int uv_set = -1;
    if (material >= 0) {
        for_each_texture_use(document.root().at("materials").at(static_cast<std::size_t>(material)),
                             [&](const JsonPlace& use) {
                                 if (uv_set < 0) {
                                     uv_set = use.has("texCoord") ? static_cast<int>(use.at("texCoord").whole()) : 0;
                                 }
                             });
    }
    return uv_set;
}

int GltfMaterials::scene_material(int material) {
    const auto known = materials_.find(material);
    if (known != materials_.end()) {
        return known->second;
    }
    Material result = converted(material);
    scene_.materials.push_back(std::move(result));
    return materials_[material] = static_cast<int>(scene_.materials.size()) - 1;
}

Material GltfMaterials::converted(int material) {
    Material result;
    if (material < 0) {
        result.name = "default";
        return result;
    }
    const tinygltf::Material& source = gltf_.model.materials.at(static_cast<std::size_t>(material));
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const int uv_set = uv_set_of_material(document_, material);
    result.name = source.name.empty() ? fmt::format("material {}", material) : source.name;
    result.base_color = glm::vec4(vec3_of(pbr.baseColorFactor), static_cast<float>(pbr.baseColorFactor[3]));
    result.metallic = static_cast<float>(pbr.metallicFactor);
    result.roughness = static_cast<float>(pbr.roughnessFactor);
    result.emissive = vec3_of(source.emissiveFactor) * emissive_strength(document_, material);
    result.normal_scale = static_cast<float>(source.normalTexture.scale);
    result.alpha_cutoff = glm::clamp(static_cast<float>(source.alphaCutoff), 0.0f, 1.0f);
    result.alpha_mode = source.alphaMode == "MASK"    ? AlphaMode::mask
                        : source.alphaMode == "BLEND" ? AlphaMode::blend
                                                      : AlphaMode::opaque;
    result.double_sided = source.doubleSided;
    const auto texture = [&](const auto& info, const char* slot, bool srgb) {
        if (info.index >= 0 && info.texCoord != uv_set) {
            add_notice(scene_.notices,
                       fmt::format("The {} of /materials/{} uses other texture coordinates than the material's first "
                                   "texture and was left out: a mesh has one set here.",
                                   slot, material));
        }
        return info.index >= 0 && info.texCoord == uv_set ? scene_texture(info.index, srgb) : Texture{};
    };
    result.base_color_texture = texture(pbr.baseColorTexture, "baseColorTexture", true);
    result.metallic_roughness_texture = texture(pbr.metallicRoughnessTexture, "metallicRoughnessTexture", false);
    result.normal_texture = texture(source.normalTexture, "normalTexture", false);
    result.emissive_texture = texture(source.emissiveTexture, "emissiveTexture", true);
    return result;
}

Texture GltfMaterials::scene_texture(int texture, bool srgb) {
    const tinygltf::Texture& source = gltf_.model.textures.at(static_cast<std::size_t>(texture));
    Texture result;
    if (source.source < 0) {
        add_notice(scene_.notices,
                   fmt::format("/textures/{} has no image that can be read and was left out.", texture));
        return result;
    }
    result.image = scene_image(source.source, srgb);
    if (source.sampler >= 0) {
        apply_sampler(gltf_.model.samplers.at(static_cast<std::size_t>(source.sampler)), result);
    }
    return result;
}

int GltfMaterials::scene_image(int image, bool srgb) {
    const auto known = images_.find({image, srgb});
    if (known != images_.end()) {
        return known->second;
    }
    const auto at = static_cast<std::size_t>(image);
    const DecodedImage& decoded = gltf_.images.at(at);
    Image result;
    result.name = gltf_.model.images.at(at).name;
    if (result.name.empty()) {
        const JsonPlace place = document_.root().at("images").at(at);
        const bool has_file = place.has("uri") && !place.at("uri").text().starts_with("data:");
        result.name = has_file ? place.at("uri").text() : fmt::format("image {}", image);
    }
    result.width = decoded.width;
    result.height = decoded.height;
    result.srgb = srgb;
    result.rgba = decoded.rgba;
    scene_.images.push_back(std::move(result));
    return images_[{image, srgb}] = static_cast<int>(scene_.images.size()) - 1;
}

}  // namespace halfframe::content
