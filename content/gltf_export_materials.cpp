// Materials, textures, samplers and images of an exported file. Factors are split by powers of two, so that nothing is
// rounded on the way.
#include "content/gltf_export_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "content/png_file.h"
#include "engine/frame/uv_rows.h"

namespace halfframe::content {

using nlohmann::json;

float export_scale(const glm::vec3& color) {
    const float largest = std::max({color.r, color.g, color.b});
    return largest > 1.0f ? std::exp2(std::ceil(std::log2(largest))) : 1.0f;
}

std::size_t MaterialExporter::texture_of(const Texture& texture) {
    for (std::size_t i = 0; i < textures_.size(); ++i) {
        if (textures_[i] == texture) return i;
    }
    textures_.push_back(texture);
    const auto wrap = [](Wrap mode) { return mode == Wrap::repeat ? 10497 : mode == Wrap::clamp ? 33071 : 33648; };
    const Minify minify = texture.minify.value_or(Minify{.linear = texture.linear, .between = texture.linear});
    const int min =
        !texture.mipmaps ? (minify.linear ? 9729 : 9728) : 9984 + (minify.linear ? 1 : 0) + (minify.between ? 2 : 0);
    const std::size_t sampler = file_.append("samplers", {{"magFilter", texture.linear ? 9729 : 9728},
                                                          {"minFilter", min},
                                                          {"wrapS", wrap(texture.wrap_u)},
                                                          {"wrapT", wrap(texture.wrap_v)}});
    return file_.append("textures", {{"sampler", sampler}, {"source", image_of(texture.image)}});
}

std::size_t MaterialExporter::image_of(int index) {
    const auto known = images_.find(index);
    if (known != images_.end()) return known->second;
    const Image& image = scene_.images[static_cast<std::size_t>(index)];
    const std::string png = png_of(image);
    json entry = {{"bufferView", file_.add_view(png.data(), png.size())}, {"mimeType", "image/png"}};
    if (!image.name.empty()) entry["name"] = image.name;
    return images_[index] = file_.append("images", std::move(entry));
}

void MaterialExporter::add_texture(json& owner, const char* key, const Texture& texture, const UvMapping& uv) {
    if (!texture) return;
    json& use = owner[key];
    use["index"] = texture_of(texture);
    if (uv.set != 0) use["texCoord"] = uv.set;
    if (is_plain(uv)) return;
    file_.extension(use, "KHR_texture_transform") = {{"offset", array_of(uv.offset)},
                                                     {"scale", array_of(uv.scale)},
                                                     {"rotation", static_cast<double>(uv.rotation_rad)}};
}

void MaterialExporter::add_model(json& result, const Material& material) {
    if (material.model == MaterialModel::specular_glossiness) {
        json& glossy = file_.extension(result, "KHR_materials_pbrSpecularGlossiness");
        glossy = {{"diffuseFactor", array_of(material.base_color)},
                  {"specularFactor", array_of(material.specular)},
                  {"glossinessFactor", static_cast<double>(material.smoothness)}};
        add_texture(glossy, "diffuseTexture", material.base_color_texture, material.base_color_uv);
        add_texture(glossy, "specularGlossinessTexture", material.specular_smoothness_texture,
                    material.specular_smoothness_uv);
        return;
    }
    json& pbr = result["pbrMetallicRoughness"];
    pbr = {{"baseColorFactor", array_of(material.base_color)},
           {"metallicFactor", static_cast<double>(material.metallic)},
           {"roughnessFactor", static_cast<double>(material.roughness)}};
    add_texture(pbr, "baseColorTexture", material.base_color_texture, material.base_color_uv);
    add_texture(pbr, "metallicRoughnessTexture", material.metallic_roughness_texture, material.metallic_roughness_uv);
    if (material.model == MaterialModel::unlit) file_.extension(result, "KHR_materials_unlit") = json::object();
    if (material.ior != Material{}.ior)
        file_.extension(result, "KHR_materials_ior") = {{"ior", static_cast<double>(material.ior)}};
    if (material.specular == glm::vec3(1.0f) && !material.specular_texture && !material.specular_color_texture) return;
    json& specular = file_.extension(result, "KHR_materials_specular");
    specular["specularColorFactor"] = array_of(material.specular);
    add_texture(specular, "specularTexture", material.specular_texture, material.specular_uv);
    add_texture(specular, "specularColorTexture", material.specular_color_texture, material.specular_color_uv);
}

void MaterialExporter::add_water(json& result, const Material& material) {
    constexpr std::array<const char*, 4> kMasks{"none", "everywhere", "vertex", "texture"};
    if (material.water == WaterMask::none) return;
    result["extras"]["hf_water"] = kMasks[static_cast<std::size_t>(material.water)];
    if (material.water_texture) result["extras"]["hf_water_texture"] = texture_of(material.water_texture);
    if (material.deepest_puddle_m != Material{}.deepest_puddle_m)
        result["extras"]["hf_puddle_depth_m"] = static_cast<double>(material.deepest_puddle_m);
}

json MaterialExporter::material_of(const Material& material) {
    json result = json::object();
    if (!material.name.empty()) result["name"] = material.name;
    add_model(result, material);
    add_texture(result, "normalTexture", material.normal_texture, material.normal_uv);
    if (material.normal_texture) result["normalTexture"]["scale"] = static_cast<double>(material.normal_scale);
    add_texture(result, "occlusionTexture", material.occlusion_texture, material.occlusion_uv);
    if (material.occlusion_texture)
        result["occlusionTexture"]["strength"] = static_cast<double>(material.occlusion_strength);
    add_texture(result, "emissiveTexture", material.emissive_texture, material.emissive_uv);
    const float strength = export_scale(material.emissive);
    result["emissiveFactor"] = array_of(material.emissive / strength);
    if (strength != 1.0f) {
        file_.extension(result,
                        "KHR_materials_emissive_strength") = {{"emissiveStrength", static_cast<double>(strength)}};
    }
    if (material.alpha_mode == AlphaMode::blend) result["alphaMode"] = "BLEND";
    if (material.alpha_mode == AlphaMode::mask) {
        result["alphaMode"] = "MASK";
        result["alphaCutoff"] = static_cast<double>(material.alpha_cutoff);
    }
    if (material.double_sided) result["doubleSided"] = true;
    add_water(result, material);
    return result;
}

}  // namespace halfframe::content
