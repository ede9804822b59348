// Writes a scene as a .glb file that every peer can read.
#include <fstream>

#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "perf/peers/models.h"
#include "perf/report/picture_file.h"

namespace halfframe::peers {
namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;  // GL's names, as glTF takes them

/// The document and its one binary chunk while they grow.
class Glb {
public:
    /// Index of a new accessor over `values`; `box` adds the bounds that positions must have.
    template <typename Value>
    int accessor(const std::vector<Value>& values, const char* type, int component, bool box = false) {
        const int view =
            buffer_view(reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(Value));
        Json accessor = {{"bufferView", view}, {"componentType", component}, {"count", values.size()}, {"type", type}};
        if constexpr (std::is_same_v<Value, glm::vec3>) {
            if (box) {
                Box bounds;
                for (const glm::vec3& value : values) bounds.add(value);
                accessor["min"] = {bounds.low.x, bounds.low.y, bounds.low.z};
                accessor["max"] = {bounds.high.x, bounds.high.y, bounds.high.z};
            }
        }
        document["accessors"].push_back(accessor);
        return static_cast<int>(document["accessors"].size()) - 1;
    }

    int buffer_view(const std::uint8_t* bytes, std::size_t size) {
        while (binary.size() % 4 != 0) binary.push_back(0);
        document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}});
        binary.insert(binary.end(), bytes, bytes + size);
        return static_cast<int>(document["bufferViews"].size()) - 1;
    }

    Json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    std::vector<std::uint8_t> binary;
};

void add_meshes(Glb& glb, const Scene& scene) {
    std::vector<Json> primitives;
    for (const Mesh& mesh : scene.meshes) {
        Json attributes = {{"POSITION", glb.accessor(mesh.positions, "VEC3", kFloat, true)},
                           {"NORMAL", glb.accessor(mesh.normals, "VEC3", kFloat)},
                           {"TANGENT", glb.accessor(mesh.tangents, "VEC4", kFloat)},
                           {"TEXCOORD_0", glb.accessor(mesh.uv, "VEC2", kFloat)}};
        primitives.push_back(
            {{"attributes", attributes}, {"indices", glb.accessor(mesh.indices, "SCALAR", kUnsignedInt)}});
    }
    for (const Surface& surface : scene.surfaces) {  // glTF ties the material to the mesh: a mesh for each surface
        Json primitive = primitives[static_cast<std::size_t>(surface.mesh)];
        primitive["material"] = surface.material;
        glb.document["meshes"].push_back({{"primitives", {primitive}}});
        Json matrix = Json::array();
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) matrix.push_back(surface.world_from_local[column][row]);
        }
        const int index = static_cast<int>(glb.document["meshes"].size()) - 1;
        glb.document["nodes"].push_back({{"name", surface.name}, {"mesh", index}, {"matrix", matrix}});
        glb.document["scenes"][0]["nodes"].push_back(index);
    }
}

void add_materials(Glb& glb, const Scene& scene) {
    for (const Image& image : scene.images) {
        const auto png = perf::png_bytes({.width = image.width, .height = image.height, .rgba = image.rgba});
        glb.document["images"].push_back(
            {{"mimeType", "image/png"}, {"bufferView", glb.buffer_view(png.data(), png.size())}});
        glb.document["textures"].push_back({{"source", static_cast<int>(glb.document["images"].size()) - 1}});
    }
    for (const Material& material : scene.materials) {
        const auto& color = material.base_color;
        Json metallic_roughness = {{"baseColorFactor", {color.r, color.g, color.b, color.a}},
                                   {"metallicFactor", material.metallic},
                                   {"roughnessFactor", material.roughness}};
        Json value = {{"emissiveFactor", {material.emissive.r, material.emissive.g, material.emissive.b}}};
        const auto set = [](Json& object, const char* key, const Texture& texture) {
            if (texture) object[key] = {{"index", texture.image}};
        };
        set(metallic_roughness, "baseColorTexture", material.base_color_texture);
        set(metallic_roughness, "metallicRoughnessTexture", material.metallic_roughness_texture);
        set(value, "normalTexture", material.normal_texture);
        set(value, "emissiveTexture", material.emissive_texture);
        value["pbrMetallicRoughness"] = metallic_roughness;
        glb.document["materials"].push_back(value);
    }
}

void append_word(std::vector<std::uint8_t>& bytes, std::size_t word) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
}

}  // namespace

void write_glb(const std::filesystem::path& file, const Scene& scene) {
    Glb glb;
    add_meshes(glb, scene);
    add_materials(glb, scene);
    while (glb.binary.size() % 4 != 0) glb.binary.push_back(0);
    glb.document["buffers"].push_back({{"byteLength", glb.binary.size()}});
    std::string json = glb.document.dump();
    while (json.size() % 4 != 0) json.push_back(' ');
    std::vector<std::uint8_t> bytes;
    append_word(bytes, 0x46546C67);  // "glTF"
    append_word(bytes, 2);
    append_word(bytes, 12 + 8 + json.size() + 8 + glb.binary.size());
    append_word(bytes, json.size());
    append_word(bytes, 0x4E4F534A);  // "JSON"
    bytes.insert(bytes.end(), json.begin(), json.end());
    append_word(bytes, glb.binary.size());
    append_word(bytes, 0x004E4942);  // "BIN"
    bytes.insert(bytes.end(), glb.binary.begin(), glb.binary.end());
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) throw Error(Fault::environment, file.string() + " cannot be written; is the disk full?");
}

}  // namespace halfframe::peers
