// gltf_binary(): a Scene as a GLB that loads back to the same frame. Floats are written as they are, and factors in
// powers of two, so that nothing is rounded on the way.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "content/mesh_tools.h"
#include "content/png_file.h"
#include "engine/frame/uv_rows.h"

namespace halfframe::content {
namespace {

using nlohmann::json;

template <typename Vector>
json array_of(const Vector& value) {
    json array = json::array();
    for (int i = 0; i < Vector::length(); ++i) array.push_back(static_cast<double>(value[i]));
    return array;
}

json matrix_of(const glm::mat4& matrix) {
    json array = json::array();
    for (int i = 0; i < 16; ++i) array.push_back(static_cast<double>(matrix[i / 4][i % 4]));
    return array;
}

/// The smallest power of two that is not below the largest channel, at least 1: dividing by it is exact.
float scale_of(const glm::vec3& color) {
    const float largest = std::max({color.r, color.g, color.b});
    return largest > 1.0f ? std::exp2(std::ceil(std::log2(largest))) : 1.0f;
}

class Exporter {
public:
    explicit Exporter(const Scene& scene) : scene_(scene) {}

    std::string run() {
        document_["asset"] = {{"version", "2.0"}, {"generator", "halfframe"}};
        json& gltf_scene = document_["scenes"][0];
        gltf_scene["name"] = scene_.name;
        document_["scene"] = 0;
        for (const Material& material : scene_.materials) document_["materials"].push_back(material_of(material));
        for (const Surface& surface : scene_.surfaces) add_surface(surface);
        for (const Camera& camera : scene_.cameras) add_camera(camera);
        for (const Light& light : scene_.lights) add_light(light);
        for (std::size_t i = 0; i < node_count_; ++i) gltf_scene["nodes"].push_back(i);
        const json extras = scene_extras();
        if (!extras.empty()) gltf_scene["extras"] = extras;
        if (!used_.empty()) document_["extensionsUsed"] = used_;
        if (!binary_.empty()) document_["buffers"] = json::array({{{"byteLength", binary_.size()}}});
        return glb();
    }

private:
    json& add_node(const std::string& name, const glm::mat4& matrix) {
        json& node = document_["nodes"].emplace_back(json::object());
        ++node_count_;
        if (!name.empty()) node["name"] = name;
        if (matrix != glm::mat4(1.0f)) node["matrix"] = matrix_of(matrix);
        return node;
    }

    json& extension(json& owner, const std::string& name) {
        used_.insert(name);
        return owner["extensions"][name];
    }

    std::size_t add_view(const void* bytes, std::size_t count) {
        binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
        document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", count}});
        binary_.append(static_cast<const char*>(bytes), count);
        return document_["bufferViews"].size() - 1;
    }

    template <typename T>
    std::size_t add_accessor(const std::vector<T>& values, int component_type, const char* type) {
        document_["accessors"].push_back({{"bufferView", add_view(values.data(), values.size() * sizeof(T))},
                                          {"componentType", component_type},
                                          {"type", type},
                                          {"count", values.size()}});
        return document_["accessors"].size() - 1;
    }

    /// Attributes, indices and mode of a mesh, written once; the loader turns the faces of a mirrored one around again.
    const json& primitive_of(int index, bool mirror) {
        const auto known = primitives_.find({index, mirror});
        if (known != primitives_.end()) return known->second;
        const Mesh& plain = scene_.meshes[static_cast<std::size_t>(index)];
        const Mesh mesh = mirror ? mirrored(plain) : plain;
        constexpr int kFloat = 5126, kUnsigned = 5125;
        json primitive = {{"mode", static_cast<int>(mesh.primitive)}};
        json& attributes = primitive["attributes"];
        const std::size_t positions = add_accessor(mesh.positions, kFloat, "VEC3");
        const Box box = local_box(mesh);
        document_["accessors"][positions]["min"] = array_of(box.low);
        document_["accessors"][positions]["max"] = array_of(box.high);
        attributes["POSITION"] = positions;
        if (!mesh.normals.empty()) attributes["NORMAL"] = add_accessor(mesh.normals, kFloat, "VEC3");
        if (!mesh.tangents.empty()) attributes["TANGENT"] = add_accessor(mesh.tangents, kFloat, "VEC4");
        if (!mesh.uv.empty()) attributes["TEXCOORD_0"] = add_accessor(mesh.uv, kFloat, "VEC2");
        if (!mesh.uv1.empty()) attributes["TEXCOORD_1"] = add_accessor(mesh.uv1, kFloat, "VEC2");
        if (!mesh.colors.empty()) attributes["COLOR_0"] = add_accessor(mesh.colors, kFloat, "VEC4");
        if (!mesh.indices.empty()) primitive["indices"] = add_accessor(mesh.indices, kUnsigned, "SCALAR");
        return primitives_[{index, mirror}] = primitive;
    }

    void add_surface(const Surface& surface) {
        const bool mirror = glm::determinant(glm::dmat3(surface.world_from_local)) < 0.0;
        const std::tuple key{surface.mesh, surface.material, mirror};
        if (!meshes_.contains(key)) {
            json primitive = primitive_of(surface.mesh, mirror);
            primitive["material"] = surface.material;
            json mesh = {{"primitives", json::array({primitive})}};
            const std::string& name = scene_.meshes[static_cast<std::size_t>(surface.mesh)].name;
            if (!name.empty()) mesh["name"] = name;
            document_["meshes"].push_back(mesh);
            meshes_[key] = document_["meshes"].size() - 1;
        }
        json& node = add_node(surface.name, surface.world_from_local);
        node["mesh"] = meshes_[key];
        if (surface.dynamic) node["extras"]["hf_dynamic"] = true;
    }

    std::size_t texture_of(const Texture& texture) {
        for (std::size_t i = 0; i < textures_.size(); ++i) {
            if (textures_[i] == texture) return i;
        }
        textures_.push_back(texture);
        const auto wrap = [](Wrap mode) { return mode == Wrap::repeat ? 10497 : mode == Wrap::clamp ? 33071 : 33648; };
        const Minify minify = texture.minify.value_or(Minify{.linear = texture.linear, .between = texture.linear});
        const int min = !texture.mipmaps ? (minify.linear ? 9729 : 9728)
                                         : 9984 + (minify.linear ? 1 : 0) + (minify.between ? 2 : 0);
        document_["samplers"].push_back({{"magFilter", texture.linear ? 9729 : 9728},
                                         {"minFilter", min},
                                         {"wrapS", wrap(texture.wrap_u)},
                                         {"wrapT", wrap(texture.wrap_v)}});
        document_["textures"].push_back(
            {{"sampler", document_["samplers"].size() - 1}, {"source", image_of(texture.image)}});
        return textures_.size() - 1;
    }

    std::size_t image_of(int index) {
        const auto known = images_.find(index);
        if (known != images_.end()) return known->second;
        const Image& image = scene_.images[static_cast<std::size_t>(index)];
        const std::string png = png_of(image);
        json entry = {{"bufferView", add_view(png.data(), png.size())}, {"mimeType", "image/png"}};
        if (!image.name.empty()) entry["name"] = image.name;
        document_["images"].push_back(entry);
        return images_[index] = document_["images"].size() - 1;
    }

    void add_texture(json& owner, const char* key, const Texture& texture, const UvMapping& uv) {
        if (!texture) return;
        json& use = owner[key];
        use["index"] = texture_of(texture);
        if (uv.set != 0) use["texCoord"] = uv.set;
        if (is_plain(uv)) return;
        extension(use, "KHR_texture_transform") = {{"offset", array_of(uv.offset)},
                                                   {"scale", array_of(uv.scale)},
                                                   {"rotation", static_cast<double>(uv.rotation_rad)}};
    }

    void add_model(json& result, const Material& material) {
        if (material.model == MaterialModel::specular_glossiness) {
            json& glossy = extension(result, "KHR_materials_pbrSpecularGlossiness");
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
        add_texture(pbr, "metallicRoughnessTexture", material.metallic_roughness_texture,
                    material.metallic_roughness_uv);
        if (material.model == MaterialModel::unlit) extension(result, "KHR_materials_unlit") = json::object();
        if (material.ior != Material{}.ior)
            extension(result, "KHR_materials_ior") = {{"ior", static_cast<double>(material.ior)}};
        if (material.specular == glm::vec3(1.0f) && !material.specular_texture && !material.specular_color_texture)
            return;
        json& specular = extension(result, "KHR_materials_specular");
        specular["specularColorFactor"] = array_of(material.specular);
        add_texture(specular, "specularTexture", material.specular_texture, material.specular_uv);
        add_texture(specular, "specularColorTexture", material.specular_color_texture, material.specular_color_uv);
    }

    json material_of(const Material& material) {
        json result = json::object();
        if (!material.name.empty()) result["name"] = material.name;
        add_model(result, material);
        add_texture(result, "normalTexture", material.normal_texture, material.normal_uv);
        if (material.normal_texture) result["normalTexture"]["scale"] = static_cast<double>(material.normal_scale);
        add_texture(result, "occlusionTexture", material.occlusion_texture, material.occlusion_uv);
        if (material.occlusion_texture)
            result["occlusionTexture"]["strength"] = static_cast<double>(material.occlusion_strength);
        add_texture(result, "emissiveTexture", material.emissive_texture, material.emissive_uv);
        const float strength = scale_of(material.emissive);
        result["emissiveFactor"] = array_of(material.emissive / strength);
        if (strength != 1.0f) {
            extension(result,
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

    void add_water(json& result, const Material& material) {
        constexpr std::array<const char*, 4> kMasks{"none", "everywhere", "vertex", "texture"};
        if (material.water == WaterMask::none) return;
        result["extras"]["hf_water"] = kMasks[static_cast<std::size_t>(material.water)];
        if (material.water_texture) result["extras"]["hf_water_texture"] = texture_of(material.water_texture);
        if (material.deepest_puddle_m != Material{}.deepest_puddle_m)
            result["extras"]["hf_puddle_depth_m"] = static_cast<double>(material.deepest_puddle_m);
    }

    void add_camera(const Camera& camera) {
        json lens = {{"znear", static_cast<double>(camera.near_m)}, {"zfar", static_cast<double>(camera.far_m)}};
        json entry = {{"type", camera.orthographic ? "orthographic" : "perspective"}};
        if (camera.orthographic) {
            lens["xmag"] = lens["ymag"] = static_cast<double>(camera.half_height_m);
        } else {
            lens["yfov"] = static_cast<double>(camera.fov_y_rad);
        }
        entry[camera.orthographic ? "orthographic" : "perspective"] = lens;
        if (!camera.name.empty()) entry["name"] = camera.name;
        if (camera.exposure != 1.0f) entry["extras"]["hf_exposure"] = static_cast<double>(camera.exposure);
        document_["cameras"].push_back(entry);
        add_node(camera.name, camera.world_from_view)["camera"] = document_["cameras"].size() - 1;
    }

    void add_light(const Light& light) {
        constexpr const char* kTypes[] = {"directional", "point", "spot"};
        const float scale = scale_of(light.color);
        json entry = {{"type", kTypes[static_cast<std::size_t>(light.kind)]},
                      {"color", array_of(light.color / scale)},
                      {"intensity", static_cast<double>(scale) * std::numbers::pi}};
        if (!light.name.empty()) entry["name"] = light.name;
        if (light.kind != LightKind::sun) entry["range"] = static_cast<double>(light.range_m);
        if (light.kind == LightKind::spot) {
            entry["spot"] = {{"innerConeAngle", static_cast<double>(light.inner_cone_rad)},
                             {"outerConeAngle", static_cast<double>(light.outer_cone_rad)}};
        }
        if (light.radius_m > 0.0f) entry["extras"]["hf_radius_m"] = static_cast<double>(light.radius_m);
        json& lights = extension(document_, "KHR_lights_punctual")["lights"];
        lights.push_back(entry);
        // -Z of the node is the way the light travels; the other two axes only have to stand across it.
        const glm::vec3 back = -light.direction;
        const glm::vec3 other = std::abs(back.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
        const glm::vec3 right = glm::normalize(glm::cross(other, back));
        const glm::mat4 matrix(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f), glm::vec4(back, 0.0f),
                               glm::vec4(light.position, 1.0f));
        const std::size_t index = lights.size() - 1;
        extension(add_node(light.name, matrix), "KHR_lights_punctual")["light"] = index;
    }

    json scene_extras() const {
        json extras = json::object();
        if (scene_.ambient != glm::vec3(0.0f)) extras["hf_ambient"] = array_of(scene_.ambient);
        if (scene_.background != Scene{}.background) extras["hf_background"] = array_of(scene_.background);
        if (scene_.bloom) extras["hf_bloom_strength"] = static_cast<double>(scene_.bloom->strength);
        if (scene_.sky) {
            extras["hf_sky_zenith"] = array_of(scene_.sky->zenith);
            extras["hf_sky_horizon"] = array_of(scene_.sky->horizon);
            extras["hf_sky_ground"] = array_of(scene_.sky->ground);
        }
        if (scene_.wetness) {
            extras["hf_wetness"] = static_cast<double>(scene_.wetness->level);
            if (!scene_.wetness->is_static) extras["hf_wetness_live"] = true;
            if (scene_.wetness->since_s) extras["hf_rain_ended_s"] = static_cast<double>(*scene_.wetness->since_s);
            extras["hf_drying_s"] = static_cast<double>(scene_.wetness->dry_s);
        }
        if (scene_.puddles) extras["hf_puddles"] = static_cast<double>(scene_.puddles->level);
        if (scene_.environment) {
            extras["hf_environment"] = scene_.environment->name;
            extras["hf_environment_size"] = scene_.environment->size;
        }
        return extras;
    }

    std::string glb() {
        const auto append_u32 = [](std::string& bytes, std::size_t value) {
            for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xFFu);
        };
        std::string text = document_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
        std::string bytes = "glTF";
        append_u32(bytes, 2);
        append_u32(bytes, 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size()));
        append_u32(bytes, text.size());
        bytes += "JSON" + text;
        if (!binary_.empty()) {
            append_u32(bytes, binary_.size());
            bytes += std::string("BIN\0", 4) + binary_;
        }
        return bytes;
    }

    const Scene& scene_;
    json document_ = json::object();
    std::string binary_;
    std::set<std::string> used_;
    std::size_t node_count_ = 0;
    std::map<std::pair<int, bool>, json> primitives_;
    std::map<std::tuple<int, int, bool>, std::size_t> meshes_;
    std::vector<Texture> textures_;
    std::map<int, std::size_t> images_;
};

}  // namespace

std::vector<std::string> not_exported(const Scene& scene) {
    std::vector<std::string> sentences;
    if (!scene.animations.empty() || !scene.skins.empty())
        sentences.emplace_back("Animations and skins are not exported: everything stands as it is.");
    const bool morphs = std::ranges::any_of(scene.meshes, [](const Mesh& mesh) { return !mesh.morph_targets.empty(); });
    if (morphs) sentences.emplace_back("Morph targets are not exported: meshes have their base shape.");
    const auto is_elsewhere = [](const Material& material) {
        return material.water_texture && !(material.water_uv == material.base_color_uv);
    };
    if (std::ranges::any_of(scene.materials, is_elsewhere)) {
        sentences.emplace_back(
            "Water textures are exported at the coordinates of the base colour, which are not theirs everywhere.");
    }
    const auto names = environment_names();
    if (scene.environment && std::ranges::find(names, scene.environment->name) == names.end()) {
        sentences.push_back(fmt::format("The environment {} is not built in: the file cannot be loaded with it.",
                                        scene.environment->name));
    }
    return sentences;
}

std::string gltf_binary(const Scene& scene) {
    const auto names = environment_names();
    if (scene.environment && std::ranges::find(names, scene.environment->name) == names.end()) {
        Scene without = scene;
        without.environment.reset();
        return Exporter(without).run();
    }
    return Exporter(scene).run();
}

}  // namespace halfframe::content
