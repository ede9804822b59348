// Materials, textures, samplers, images. Materials are read from the document, with their extensions.
#include "content/gltf_materials.h"

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "content/gltf_extensions.h"
#include "content/gltf_extras.h"

namespace halfframe::content {
namespace {

/// A texture use of a material: where it stands in the document, and where it goes in a Material.
struct Slot {
    const char* extension;  ///< or nothing
    const char* owner;      ///< key around it, or nothing
    const char* key;
    bool srgb;
    Texture Material::*texture;
    UvMapping Material::*uv;
};

constexpr std::array<Slot, 5> kCoreSlots{
    {{nullptr, "pbrMetallicRoughness", "baseColorTexture", true, &Material::base_color_texture,
      &Material::base_color_uv},
     {nullptr, "pbrMetallicRoughness", "metallicRoughnessTexture", false, &Material::metallic_roughness_texture,
      &Material::metallic_roughness_uv},
     {nullptr, nullptr, "normalTexture", false, &Material::normal_texture, &Material::normal_uv},
     {nullptr, nullptr, "emissiveTexture", true, &Material::emissive_texture, &Material::emissive_uv},
     {nullptr, nullptr, "occlusionTexture", false, &Material::occlusion_texture, &Material::occlusion_uv}}};
constexpr std::array<Slot, 2> kSpecularSlots{{{"KHR_materials_specular", nullptr, "specularColorTexture", true,
                                               &Material::specular_color_texture, &Material::specular_color_uv},
                                              {"KHR_materials_specular", nullptr, "specularTexture", false,
                                               &Material::specular_texture, &Material::specular_uv}}};
constexpr std::array<Slot, 2> kGlossySlots{
    {{"KHR_materials_pbrSpecularGlossiness", nullptr, "diffuseTexture", true, &Material::base_color_texture,
      &Material::base_color_uv},
     {"KHR_materials_pbrSpecularGlossiness", nullptr, "specularGlossinessTexture", true,
      &Material::specular_smoothness_texture, &Material::specular_smoothness_uv}}};

/// An unlit material has one texture; specular-glossiness takes the place of metallic-roughness, and what the latter
/// says is its fallback (the extension).
MaterialModel model_of(const JsonPlace& material) {
    if (extension(material, "KHR_materials_unlit")) return MaterialModel::unlit;
    if (extension(material, "KHR_materials_pbrSpecularGlossiness")) return MaterialModel::specular_glossiness;
    return MaterialModel::metallic_roughness;
}

/// Calls visit(slot, texture use) for what is drawn of a material, in order of importance.
template <typename Visit>
void for_each_texture_use(const JsonPlace& material, Visit&& visit) {
    const auto visit_slot = [&](const Slot& slot) {
        std::optional<JsonPlace> owner = material;
        if (slot.extension != nullptr) owner = extension(material, slot.extension);
        if (owner && slot.owner != nullptr) owner = owner->find(slot.owner);
        if (const auto use = owner ? owner->find(slot.key) : std::nullopt) visit(slot, *use);
    };
    const MaterialModel model = model_of(material);
    if (model == MaterialModel::unlit) {
        visit_slot(kCoreSlots[0]);
        return;
    }
    if (model == MaterialModel::specular_glossiness) {
        for (const Slot& slot : kGlossySlots) visit_slot(slot);
    }
    for (const Slot& slot : kCoreSlots) {
        if (model != MaterialModel::specular_glossiness || slot.owner == nullptr) visit_slot(slot);
    }
    if (model == MaterialModel::metallic_roughness) {
        for (const Slot& slot : kSpecularSlots) visit_slot(slot);
    }
}

UvMapping uv_mapping_of(const JsonPlace& use) {
    UvMapping mapping;
    mapping.set = use.has("texCoord") ? static_cast<int>(use.at("texCoord").whole()) : 0;
    if (const auto transform = extension(use, "KHR_texture_transform")) {
        if (transform->has("texCoord")) mapping.set = static_cast<int>(transform->at("texCoord").whole());
        const auto pair = [&](const char* key, glm::vec2& into) {
            if (!transform->has(key)) return;
            for (int i = 0; i < 2; ++i)
                into[i] = static_cast<float>(transform->at(key).at(static_cast<std::size_t>(i)).number());
        };
        pair("offset", mapping.offset);
        pair("scale", mapping.scale);
        if (transform->has("rotation")) mapping.rotation_rad = static_cast<float>(transform->at("rotation").number());
    }
    return mapping;
}

Wrap wrap_of(int wrap) {
    switch (wrap) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Wrap::clamp;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Wrap::mirror;
        default: return Wrap::repeat;
    }
}

/// Where the file leaves a filter open: linear on magnification, unless minification is asked to be nearest.
void apply_sampler(const tinygltf::Sampler& sampler, Texture& texture) {
    texture.wrap_u = wrap_of(sampler.wrapS);
    texture.wrap_v = wrap_of(sampler.wrapT);
    const int min = sampler.minFilter;
    const bool linear = min != TINYGLTF_TEXTURE_FILTER_NEAREST &&
                        min != TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST &&
                        min != TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    texture.linear = sampler.magFilter >= 0 ? sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST : linear;
    texture.mipmaps = min != TINYGLTF_TEXTURE_FILTER_NEAREST && min != TINYGLTF_TEXTURE_FILTER_LINEAR;
    if (min < 0) return;
    const bool between =
        min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR || min == TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    if (linear != texture.linear || (texture.mipmaps && between != texture.linear))
        texture.minify = Minify{.linear = linear, .between = texture.mipmaps && between};
}

float number_or(const JsonPlace& owner, const char* key, float otherwise) {
    const auto place = owner.find(key);
    return place ? static_cast<float>(place->number()) : otherwise;
}

template <typename Vector>
Vector vector_or(const JsonPlace& owner, const char* key, const Vector& otherwise) {
    const auto place = owner.find(key);
    if (!place) return otherwise;
    Vector result{};
    for (int i = 0; i < Vector::length(); ++i)
        result[i] = static_cast<float>(place->at(static_cast<std::size_t>(i)).number());
    return result;
}

/// KHR_materials_ior and KHR_materials_specular. The extension limits reflectance times colour to 1 before the factor:
/// what is handed on is limited so already.
void read_specular(const JsonPlace& place, Material& material) {
    if (const auto ior = extension(place, "KHR_materials_ior")) material.ior = number_or(*ior, "ior", 1.5f);
    const auto specular = extension(place, "KHR_materials_specular");
    if (!specular) return;
    const float ratio = (material.ior - 1.0f) / (material.ior + 1.0f);
    const float normal = material.ior > 0.0f ? ratio * ratio : 1.0f;
    const glm::vec3 color = vector_or(*specular, "specularColorFactor", glm::vec3(1.0f));
    const glm::vec3 limited = normal > 0.0f ? glm::min(color, glm::vec3(1.0f / normal)) : color;
    material.specular = limited * number_or(*specular, "specularFactor", 1.0f);
}

void read_model(const JsonPlace& place, Material& material) {
    material.model = model_of(place);
    if (material.model == MaterialModel::specular_glossiness) {
        const JsonPlace glossy = *extension(place, "KHR_materials_pbrSpecularGlossiness");
        material.base_color = vector_or(glossy, "diffuseFactor", glm::vec4(1.0f));
        material.specular = vector_or(glossy, "specularFactor", glm::vec3(1.0f));
        material.smoothness = number_or(glossy, "glossinessFactor", 1.0f);
        material.metallic = 0.0f;
        material.roughness = 1.0f - material.smoothness;
        return;
    }
    if (place.has("pbrMetallicRoughness")) {
        const JsonPlace pbr = place.at("pbrMetallicRoughness");
        material.base_color = vector_or(pbr, "baseColorFactor", glm::vec4(1.0f));
        material.metallic = number_or(pbr, "metallicFactor", 1.0f);
        material.roughness = number_or(pbr, "roughnessFactor", 1.0f);
    }
    read_specular(place, material);
}

AlphaMode alpha_mode_of(const JsonPlace& place) {
    if (!place.has("alphaMode")) return AlphaMode::opaque;
    const std::string& mode = place.at("alphaMode").text();
    return mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

float emissive_strength_of(const JsonPlace& place) {
    const auto strength = extension(place, "KHR_materials_emissive_strength");
    return strength ? number_or(*strength, "emissiveStrength", 1.0f) : 1.0f;
}

}  // namespace

std::set<std::size_t> images_used_by_materials(const GltfDocument& document) {
    const JsonPlace root = document.root();
    std::set<std::size_t> used;
    const auto use_image = [&](std::uint64_t index) {
        const JsonPlace texture = root.at("textures").at(static_cast<std::size_t>(index));
        if (texture.has("source")) used.insert(static_cast<std::size_t>(texture.at("source").whole()));
    };
    for_each_object(root, "materials", [&](const JsonPlace& material, std::size_t) {
        for_each_texture_use(material, [&](const Slot&, const JsonPlace& use) { use_image(use.at("index").whole()); });
        Material water;
        int texture = -1;
        apply_extras(material, ExtrasOwner::material, {.material = &water, .water_texture = &texture});
        if (texture >= 0) use_image(static_cast<std::uint64_t>(texture));
    });
    return used;
}

MaterialUv uv_of_material(const GltfDocument& document, int material) {
    MaterialUv uv;
    if (material < 0) return uv;
    for_each_texture_use(document.root().at("materials").at(static_cast<std::size_t>(material)),
                         [&](const Slot& slot, const JsonPlace& use) {
                             const UvMapping mapping = uv_mapping_of(use);
                             if (mapping.set > kLastUvSet) return;
                             uv.reads[static_cast<std::size_t>(mapping.set)] = true;
                             if (slot.texture == &Material::normal_texture) uv.of_normal_map = mapping;
                         });
    return uv;
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
    const JsonPlace place = document_.root().at("materials").at(static_cast<std::size_t>(material));
    result.name = name_of(place);
    if (result.name.empty()) result.name = fmt::format("material {}", material);
    read_model(place, result);
    result.emissive = vector_or(place, "emissiveFactor", glm::vec3(0.0f)) * emissive_strength_of(place);
    if (place.has("normalTexture")) result.normal_scale = number_or(place.at("normalTexture"), "scale", 1.0f);
    if (place.has("occlusionTexture"))
        result.occlusion_strength = number_or(place.at("occlusionTexture"), "strength", 1.0f);
    result.alpha_cutoff = glm::clamp(number_or(place, "alphaCutoff", 0.5f), 0.0f, 1.0f);
    result.alpha_mode = alpha_mode_of(place);
    result.double_sided = place.has("doubleSided") && place.at("doubleSided").boolean();
    for_each_texture_use(place, [&](const Slot& slot, const JsonPlace& use) {
        const UvMapping mapping = uv_mapping_of(use);
        if (mapping.set > kLastUvSet) {
            add_notice(scene_.notices,
                       fmt::format("The {} of /materials/{} uses TEXCOORD_{} and was left out: the first two sets of "
                                   "texture coordinates are read.",
                                   slot.key, material, mapping.set));
            return;
        }
        result.*slot.texture = scene_texture(static_cast<int>(use.at("index").whole()), slot.srgb);
        result.*slot.uv = mapping;
    });
    int water_texture = -1;
    apply_extras(place, ExtrasOwner::material, {.material = &result, .water_texture = &water_texture});
    if (water_texture >= 0) {
        result.water_texture = scene_texture(water_texture, false);
        result.water_uv = result.base_color_uv;
    }
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
    DecodedImage& decoded = gltf_.images.at(at);
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
    if (const auto twin = images_.find({image, !srgb}); twin != images_.end()) {
        result.rgba = scene_.images[static_cast<std::size_t>(twin->second)].rgba;
    } else {
        result.rgba = std::move(decoded.rgba);
    }
    scene_.images.push_back(std::move(result));
    return images_[{image, srgb}] = static_cast<int>(scene_.images.size()) - 1;
}

}  // namespace halfframe::content
