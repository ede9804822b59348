// Writes the seeds from documents of the content tests.
#include "tests/fuzz/seeds.h"

#include <meshoptimizer.h>

#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using nlohmann::json;

json textured() {
    json document = triangle_document();
    document["images"] =
        json::array({{{"uri", "data:image/png;base64," + base64(two_pixel_png())}}, {{"uri", "picture.png"}}});
    document["samplers"] = json::parse(R"([{"magFilter": 9728, "minFilter": 9986, "wrapS": 33071, "wrapT": 33648}])");
    document["textures"] = json::parse(R"([{"source": 0, "sampler": 0}, {"source": 1}])");
    document["materials"] = json::parse(R"([{
        "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.5, "roughnessFactor": 0.5,
            "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1,
                "scale": [2, 2], "texCoord": 1}}}, "metallicRoughnessTexture": {"index": 1}},
        "normalTexture": {"index": 1, "scale": 2}, "occlusionTexture": {"index": 1, "strength": 0.5},
        "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1], "alphaMode": "MASK", "alphaCutoff": 0.4,
        "doubleSided": true,
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}, "KHR_materials_ior": {"ior": 1.4},
            "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 2, 1],
                "specularTexture": {"index": 1}}}},
        {"extensions": {"KHR_materials_unlit": {}}},
        {"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [1, 1, 1, 1], "glossinessFactor": 0.5,
            "specularGlossinessTexture": {"index": 0}}}}])");
    json& primitive = document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["extensions"] = json::parse(R"({"KHR_materials_variants": {"mappings": [
        {"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}]}})");
    document["extensions"] = json::parse(R"({"KHR_materials_variants": {"variants": [{"name": "a"}, {"name": "b"}]}})");
    std::string coordinates;
    append(coordinates, std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535});
    const std::size_t view = add_view(document, coordinates);
    for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"})
        primitive["attributes"][name] = add_accessor(document, view, 5123, "VEC2", 3, true);
    std::string normals;
    append(normals, std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["attributes"]["NORMAL"] = add_accessor(document, add_view(document, normals), 5126, "VEC3", 3);
    return document;
}

json placed() {
    json document = triangle_document();
    document["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing", "KHR_mesh_quantization"};
    document["extensions"] = json::parse(R"({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 2}, {"type": "point", "name": "bulb", "range": 4},
        {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.4}}]}})");
    document["cameras"] = json::parse(R"([
        {"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1, "zfar": 100, "aspectRatio": 1.5}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}}])");
    document["nodes"] = json::parse(R"([
        {"mesh": 0, "scale": [-1, 1, 1], "children": [1, 2]},
        {"camera": 0, "rotation": [0, 0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"camera": 1, "matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1], "extensions": {"KHR_lights_punctual": {"light": 2}}},
        {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {}}}}])");
    document["scenes"] = json::parse(R"([{"nodes": [0]}, {"name": "many", "nodes": [3]}])");
    document["scene"] = 1;
    std::string places;
    append(places, std::vector<float>{1, 0, 0, 2, 0, 0});
    document["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        add_accessor(document, add_view(document, places), 5126, "VEC3", 2);
    return document;
}

json sparse() {
    json document = triangle_document();
    std::string index, value;
    append(index, std::vector<std::uint8_t>{1});
    append(value, std::vector<float>{2, 0, 0});
    document["accessors"][1]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", add_view(document, index)}, {"componentType", 5121}}},
        {"values", {{"bufferView", add_view(document, value)}}}};
    document["meshes"][0]["primitives"][0]["mode"] = 5;
    return document;
}

json compressed() {
    json document = triangle_document();
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::string stream(meshopt_encodeVertexBufferBound(3, 12), '\0');
    stream.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(stream.data()), stream.size(),
                                             positions.data(), 3, 12));
    const std::size_t buffer = document["buffers"].size();
    document["buffers"].push_back(
        {{"byteLength", stream.size()}, {"uri", "data:application/octet-stream;base64," + base64(stream)}});
    document["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", buffer}, {"byteLength", stream.size()}, {"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}};
    document["extensionsRequired"] = {"EXT_meshopt_compression"};
    return document;
}

json beside() {
    json document = triangle_document();
    document["buffers"][0]["uri"] = "d%61ta.bin";
    std::string times, places;
    append(times, std::vector<float>{0, 1});
    append(places, std::vector<float>{0, 0, 0, 1, 2, 3});
    const json sampler{{"input", add_accessor(document, add_view(document, times), 5126, "SCALAR", 2)},
                       {"output", add_accessor(document, add_view(document, places), 5126, "VEC3", 2)}};
    document["animations"] = json::array({{{"samplers", {sampler}}}});
    document["animations"][0]["channels"] =
        json::parse(R"([{"sampler": 0, "target": {"node": 0, "path": "translation"}}])");
    document["skins"] = json::parse(R"([{"joints": [0]}])");
    return document;
}

/// A skin of two joints, two morph targets, and animations of every kind.
json moving() {
    json document = triangle_document();
    const auto floats = [&](std::vector<float> values, const char* type, std::size_t count) {
        std::string bytes;
        append(bytes, values);
        return add_accessor(document, add_view(document, bytes), 5126, type, count);
    };
    const auto joints = [&](std::vector<std::uint8_t> values) {
        std::string bytes;
        append(bytes, values);
        return add_accessor(document, add_view(document, bytes), 5121, "VEC4", 3);
    };
    json& primitive = document["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] = joints({0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    primitive["attributes"]["WEIGHTS_0"] = floats({0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 3);
    for (int i = 0; i < 2; ++i)
        primitive["targets"].push_back({{"POSITION", floats({0, 0, 1, 0, 1, 0, 1, 0, 0}, "VEC3", 3)}});
    document["meshes"][0]["weights"] = {0.25, 0.5};
    std::vector<float> binds(32, 0.0f);
    for (std::size_t i : {0, 5, 10, 15}) binds[i] = binds[16 + i] = 1.0f;
    document["skins"] = json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", floats(binds, "MAT4", 2)}}});
    document["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0, "weights": [0, 1]}, {"children": [2]},
                                        {"translation": [0, 1, 0]}])");
    document["scenes"] = json::parse(R"([{"nodes": [0, 1], "extras": {"hf_ambient": [0.5, 0.5, 0.5]}}])");
    const std::size_t times = floats({0, 1}, "SCALAR", 2);
    document["animations"] = json::array({json::object()});
    json& animation = document["animations"][0];
    const auto add = [&](const char* path, int node, const char* way, std::size_t output) {
        animation["samplers"].push_back({{"input", times}, {"output", output}, {"interpolation", way}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    };
    add("rotation", 2, "LINEAR", floats({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4", 2));
    add("scale", 1, "STEP", floats({1, 1, 1, 2, 2, 2}, "VEC3", 2));
    add("translation", 1, "CUBICSPLINE", floats(std::vector<float>(18, 0.5f), "VEC3", 6));
    add("weights", 0, "LINEAR", floats({0, 1, 1, 0}, "SCALAR", 4));
    return document;
}

}  // namespace

std::vector<Seed> gltf_seeds() {
    std::vector<Seed> seeds;
    for (const auto& [name, document] : {std::pair<const char*, json>{"triangle", triangle_document()},
                                         {"textured", textured()},
                                         {"placed", placed()},
                                         {"sparse", sparse()},
                                         {"compressed", compressed()},
                                         {"moving", moving()},
                                         {"beside", beside()}}) {
        seeds.push_back({std::string(name) + ".gltf", document.dump()});
    }
    json binary = triangle_document();
    binary["buffers"][0].erase("uri");
    seeds.push_back({"triangle.glb", glb(binary.dump(), triangle_bytes())});
    return seeds;
}

}  // namespace halfframe::tests
