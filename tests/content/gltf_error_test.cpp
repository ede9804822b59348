// What load_gltf() refuses: each message names the file, the place in it, and what to try.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "content/content.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using nlohmann::json;

struct BrokenDocument {
    const char* name;
    std::function<void(json&)> break_it;
    const char* place;  ///< JSON pointer in the message
    const char* says;   ///< words in the message
};

json& primitive(json& document) { return document["meshes"][0]["primitives"][0]; }

/// Replaces the positions by these floats.
void set_positions(json& document, const std::vector<float>& floats) {
    std::string bytes;
    append(bytes, floats);
    primitive(document)["attributes"]["POSITION"] =
        add_accessor(document, add_view(document, bytes), 5126, "VEC3", floats.size() / 3);
}

const std::vector<BrokenDocument>& faults() {
    static const std::vector<BrokenDocument> kFaults{
        {"version_3", [](json& d) { d["asset"]["version"] = "3.0"; }, "/asset/version", "3.0"},
        {"version_1", [](json& d) { d["asset"]["version"] = "1.0"; }, "/asset/version", "glTF 1.0"},
        {"version_missing", [](json& d) { d["asset"].erase("version"); }, "/asset", "'version' is missing"},
        {"version_is_nonsense", [](json& d) { d["asset"]["version"] = "two"; }, "/asset/version", "two"},
        {"min_version",
         [](json& d) {
             d["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
         },
         "/asset/minVersion", "2.1"},
        {"asset_missing", [](json& d) { d.erase("asset"); }, "/", "'asset' is missing"},
        {"required_extension", [](json& d) { d["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
         "/extensionsRequired/0", "KHR_draco_mesh_compression"},
        {"scene_index", [](json& d) { d["scene"] = 4; }, "/scene", "number 4 of 1 scenes"},
        {"scene_type", [](json& d) { d["scene"] = "first"; }, "/scene", "string"},
        {"scene_node", [](json& d) { d["scenes"][0]["nodes"] = {7}; }, "/scenes/0/nodes/0", "number 7 of 1 nodes"},
        {"scene_child",
         [](json& d) {
             d["nodes"].push_back({{"children", {0}}});
         },
         "/scenes/0/nodes/0", "not a root"},
        {"node_mesh", [](json& d) { d["nodes"][0]["mesh"] = 1; }, "/nodes/0/mesh", "number 1 of 1 meshes"},
        {"node_negative", [](json& d) { d["nodes"][0]["mesh"] = -1; }, "/nodes/0/mesh", "-1"},
        {"node_camera", [](json& d) { d["nodes"][0]["camera"] = 0; }, "/nodes/0/camera", "0 cameras"},
        {"node_child", [](json& d) { d["nodes"][0]["children"] = {9}; }, "/nodes/0/children/0", "number 9 of 1 nodes"},
        {"node_itself", [](json& d) { d["nodes"][0]["children"] = {0}; }, "/nodes/0", "own ancestor"},
        {"node_cycle",
         [](json& d) {
             d["nodes"].push_back({{"children", {2}}});
             d["nodes"].push_back({{"children", {1}}});
         },
         "/nodes/1", "own ancestor"},
        {"node_two_parents",
         [](json& d) {
             d["nodes"].push_back({{"children", {3}}});
             d["nodes"].push_back({{"children", {3}}});
             d["nodes"].push_back(json::object());
         },
         "/nodes/2/children/0", "already a child of node 1"},
        {"projective_matrix",
         [](json& d) {
             d["nodes"][0]["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
         },
         "/nodes/0/matrix", "has 0.5 in its last row"},
        {"node_matrix_and_scale",
         [](json& d) {
             d["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
             d["nodes"][0]["scale"] = {1, 1, 1};
         },
         "/nodes/0", "a matrix and a scale"},
        {"node_translation",
         [](json& d) {
             d["nodes"][0]["translation"] = {1, 2};
         },
         "/nodes/0/translation", "3 numbers"},
        {"node_too_large",
         [](json& d) {
             d["nodes"][0]["translation"] = {1e39, 0, 0};
         },
         "/nodes/0/translation/0", "1e+39"},
        {"node_far_away",
         [](json& d) {
             d["nodes"][0]["translation"] = {1e20, 0, 0};
         },
         "/nodes/0", "reaches beyond"},
        {"node_rotation",
         [](json& d) {
             d["nodes"][0]["rotation"] = {0, 0, 0, 0};
         },
         "/nodes/0/rotation", "quaternion"},
        {"mesh_no_primitives", [](json& d) { d["meshes"][0]["primitives"] = json::array(); }, "/meshes/0/primitives",
         "empty"},
        {"mesh_attribute", [](json& d) { primitive(d)["attributes"]["POSITION"] = 8; },
         "/meshes/0/primitives/0/attributes/POSITION", "number 8 of 2 accessors"},
        {"mesh_attribute_format", [](json& d) { primitive(d)["attributes"]["TEXCOORD_0"] = 1; },
         "/meshes/0/primitives/0/attributes/TEXCOORD_0", "VEC3"},
        {"mesh_attribute_counts",
         [](json& d) {
             std::string bytes;
             append(bytes, std::vector<float>(6));
             primitive(d)["attributes"]["TEXCOORD_0"] = add_accessor(d, add_view(d, bytes), 5126, "VEC2", 2);
         },
         "/meshes/0/primitives/0/attributes/TEXCOORD_0", "2"},
        {"mesh_indices_format", [](json& d) { primitive(d)["indices"] = 1; }, "/meshes/0/primitives/0/indices", "VEC3"},
        {"mesh_material", [](json& d) { primitive(d)["material"] = 0; }, "/meshes/0/primitives/0/material",
         "0 materials"},
        {"mesh_mode", [](json& d) { primitive(d)["mode"] = 7; }, "/meshes/0/primitives/0/mode", "7"},
        {"mesh_target",
         [](json& d) {
             primitive(d)["targets"] = json::array({{{"POSITION", 3}}});
         },
         "/meshes/0/primitives/0/targets/0/POSITION", "number 3"},
        {"index_too_large",
         [](json& d) {
             std::string bytes;
             append(bytes, std::vector<std::uint8_t>{0, 1, 3});
             primitive(d)["indices"] = add_accessor(d, add_view(d, bytes), 5121, "SCALAR", 3);
         },
         "/meshes/0/primitives/0/indices", "is 3 but there are 3 vertices"},
        {"position_nan",
         [](json& d) {
             set_positions(d, {0, 0, 0, 1, std::nanf(""), 0, 0, 1, 0});
         },
         "/meshes/0/primitives/0/attributes/POSITION", "element 1 of accessor 2"},
        {"position_infinite",
         [](json& d) {
             set_positions(d, {0, 0, 0, 1, 0, 0, 0, INFINITY, 0});
         },
         "/meshes/0/primitives/0/attributes/POSITION", "element 2 of accessor 2"},
        {"accessor_view", [](json& d) { d["accessors"][0]["bufferView"] = 2; }, "/accessors/0/bufferView",
         "number 2 of 2"},
        {"accessor_too_long", [](json& d) { d["accessors"][1]["count"] = 4; }, "/accessors/1",
         "byte 48 of buffer view 1, which has 36"},
        {"accessor_offset_wraps", [](json& d) { d["accessors"][1]["byteOffset"] = 9007199254740991; }, "/accessors/1",
         "buffer view 1"},
        {"accessor_offset_huge", [](json& d) { d["accessors"][1]["byteOffset"] = 18446744073709551615u; },
         "/accessors/1/byteOffset", "18446744073709551615"},
        {"accessor_count_zero", [](json& d) { d["accessors"][1]["count"] = 0; }, "/accessors/1/count", "is 0"},
        {"accessor_count_huge",
         [](json& d) {
             d["accessors"][1]["count"] = 4000000000;
             d["accessors"][1].erase("bufferView");
         },
         "/accessors/1/count", "4000000000"},
        {"vertices_too_many",
         [](json& d) {
             d["accessors"][1]["count"] = 16000000;
             d["accessors"][1].erase("bufferView");
         },
         "/meshes/0/primitives/0", "vertices"},
        {"accessor_type", [](json& d) { d["accessors"][1]["type"] = "VEC5"; }, "/accessors/1/type", "VEC4"},
        {"accessor_component", [](json& d) { d["accessors"][1]["componentType"] = 5124; }, "/accessors/1/componentType",
         "5124"},
        {"accessor_normalized_float", [](json& d) { d["accessors"][1]["normalized"] = true; },
         "/accessors/1/normalized", "integers"},
        {"sparse_index",
         [](json& d) {
             std::string indices;
             append(indices, std::vector<std::uint8_t>{3});
             const std::size_t index_view = add_view(d, indices);
             d["accessors"][1]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                                            {"values", {{"bufferView", 1}}}};
         },
         "/accessors/1/sparse/indices", "element 3 of 3"},
        {"sparse_index_of_tangents_without_a_normal_map",  // which nothing reads
         [](json& d) {
             std::string indices, tangents;
             append(indices, std::vector<std::uint8_t>{3});
             append(tangents, std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
             const std::size_t index_view = add_view(d, indices), tangent_view = add_view(d, tangents);
             primitive(d)["attributes"]["NORMAL"] = 1;
             primitive(d)["attributes"]["TANGENT"] = add_accessor(d, tangent_view, 5126, "VEC4", 3);
             d["accessors"][2]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                                            {"values", {{"bufferView", tangent_view}}}};
         },
         "/accessors/2/sparse/indices", "element 3 of 3"},
        {"view_buffer", [](json& d) { d["bufferViews"][0]["buffer"] = 1; }, "/bufferViews/0/buffer",
         "number 1 of 1 buffers"},
        {"view_too_long", [](json& d) { d["bufferViews"][1]["byteLength"] = 37; }, "/bufferViews/1",
         "byte 45 of buffer 0, which has 44"},
        {"view_stride", [](json& d) { d["bufferViews"][1]["byteStride"] = 2; }, "/bufferViews/1/byteStride", "is 2"},
        {"view_stride_small", [](json& d) { d["bufferViews"][1]["byteStride"] = 8; }, "/bufferViews/1/byteStride",
         "12 bytes"},
        {"buffer_short", [](json& d) { d["buffers"][0]["byteLength"] = 45; }, "/buffers/0/byteLength", "only 44"},
        {"buffer_without_data", [](json& d) { d["buffers"][0].erase("uri"); }, "/buffers/0", "no 'uri'"},
        {"buffer_base64", [](json& d) { d["buffers"][0]["uri"] = "data:;base64,AA*A"; }, "/buffers/0/uri",
         "base64 at character 2"},
        {"buffer_missing", [](json& d) { d["buffers"][0]["uri"] = "absent.bin"; }, "/buffers/0/uri", "no file"},
        {"buffer_folder", [](json& d) { d["buffers"][0]["uri"] = "sub"; }, "/buffers/0/uri", "folder"},
        {"buffer_outside", [](json& d) { d["buffers"][0]["uri"] = "sub/../../outside.bin"; }, "/buffers/0/uri",
         "leads out"},
        {"buffer_outside_encoded", [](json& d) { d["buffers"][0]["uri"] = "%2e%2e/outside.bin"; }, "/buffers/0/uri",
         "leads out"},
        {"buffer_absolute", [](json& d) { d["buffers"][0]["uri"] = "/etc/passwd"; }, "/buffers/0/uri", "absolute"},
        {"buffer_outside_encoded_slash", [](json& d) { d["buffers"][0]["uri"] = "..%2Foutside.bin"; }, "/buffers/0/uri",
         "leads out"},
        {"buffer_drive", [](json& d) { d["buffers"][0]["uri"] = "C:\\data.bin"; }, "/buffers/0/uri", "relative"},
        {"buffer_folder_itself", [](json& d) { d["buffers"][0]["uri"] = "."; }, "/buffers/0/uri", "folder"},
        {"buffer_empty_data",
         [](json& d) {
             d["buffers"][0] = {{"byteLength", 44}, {"uri", "data:application/octet-stream;base64,"}};
         },
         "/buffers/0/byteLength", "only 0"},
        {"light_type",
         [](json& d) {
             d["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "area"}}});
         },
         "/extensions/KHR_lights_punctual/lights/0/type", "area"},
        {"light_missing", [](json& d) { d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0; },
         "/nodes/0/extensions/KHR_lights_punctual/light", "number 0 of 0 lights"},
        {"light_cones",
         [](json& d) {
             d["extensions"]["KHR_lights_punctual"]["lights"] =
                 json::array({{{"type", "spot"}, {"spot", {{"innerConeAngle", 1.0}, {"outerConeAngle", 0.5}}}}});
         },
         "/extensions/KHR_lights_punctual/lights/0/spot", "not below"},
        {"variant_missing",
         [](json& d) {
             d["materials"] = json::array({json::object()});
             primitive(d)["extensions"]["KHR_materials_variants"]["mappings"] =
                 json::array({{{"material", 0}, {"variants", {4}}}});
         },
         "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/variants/0", "number 4 of 0"},
        {"transform_numbers",
         [](json& d) {
             d["images"] = json::array({{{"uri", "absent.png"}}});
             d["textures"] = json::array({{{"source", 0}}});
             d["materials"] =
                 json::array({{{"emissiveTexture",
                                {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {1}}}}}}}}}});
         },
         "/materials/0/emissiveTexture/extensions/KHR_texture_transform/scale", "2 numbers"},
        {"ior_below_one",
         [](json& d) {
             d["materials"] = json::array({{{"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}}});
         },
         "/materials/0/extensions/KHR_materials_ior/ior", "0.5"},
        {"buffer_scheme", [](json& d) { d["buffers"][0]["uri"] = "file:///etc/passwd"; }, "/buffers/0/uri", "relative"},
        {"buffer_null", [](json& d) { d["buffers"][0]["uri"] = "a%00b"; }, "/buffers/0/uri", "names no file"},
        {"camera_far",
         [](json& d) {
             d["cameras"] =
                 json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 2}, {"zfar", 1}}}}});
         },
         "/cameras/0/perspective/zfar", "beyond"},
        {"animation_node",
         [](json& d) {
             d["animations"] = json::array({{{"samplers", {{{"input", 0}, {"output", 1}}}},
                                             {"channels", {{{"sampler", 0}, {"target", {{"node", 5}}}}}}}});
         },
         "/animations/0/channels/0/target/node", "number 5 of 1 nodes"},
        {"skin_joint",
         [](json& d) {
             d["skins"] = json::array({{{"joints", {3}}}});
         },
         "/skins/0/joints/0", "number 3 of 1 nodes"},
        {"deep_nesting",
         [](json& d) {
             json deep = 1;
             for (int i = 0; i < 200; ++i) {
                 deep = json::array({deep});
             }
             d["extras"] = deep;
         },
         "line 1, column 479", "64 levels"},
    };
    return kFaults;
}

class GltfFault : public ::testing::TestWithParam<BrokenDocument> {};

TEST_P(GltfFault, NamesFilePlaceAndRemedy) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "sub");
    json document = triangle_document();
    GetParam().break_it(document);
    const std::filesystem::path file = folder.write("broken.gltf", document.dump());
    const std::string message = error_of(file);
    EXPECT_TRUE(message.starts_with(file.string() + ": " + GetParam().place)) << message;
    EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
    EXPECT_NE(message.find(std::string(GetParam().place) + ": "), std::string::npos) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << "no remedy in: " << message;
}

INSTANTIATE_TEST_SUITE_P(All, GltfFault, ::testing::ValuesIn(faults()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(GltfError, TheUnbrokenDocumentLoads) {
    const TemporaryFolder folder;
    EXPECT_EQ(error_of(folder.write("whole.gltf", triangle_document().dump())), "");
}

TEST(GltfError, LinksThatLeadOut) {
    const TemporaryFolder outside, folder;
    outside.write("data.bin", triangle_bytes());
    std::filesystem::create_symlink(outside.path() / "data.bin", folder.path() / "link.bin");
    std::filesystem::create_directory_symlink(outside.path(), folder.path() / "linked");
    folder.write("inside.bin", triangle_bytes());
    std::filesystem::create_symlink("inside.bin", folder.path() / "harmless.bin");
    json document = triangle_document();
    for (const char* uri : {"link.bin", "linked/data.bin"}) {
        document["buffers"][0]["uri"] = uri;
        EXPECT_NE(error_of(folder.write("model.gltf", document.dump())).find("leads out"), std::string::npos) << uri;
    }
    document["buffers"][0]["uri"] = "harmless.bin";
    EXPECT_EQ(error_of(folder.write("model.gltf", document.dump())), "");
}

struct ImageFault {
    const char* name;
    std::string bytes;
    const char* says;
};

TEST(GltfError, Images) {
    const TemporaryFolder folder;
    std::string huge = two_pixel_png();
    huge[18] = 0x7F;  // a width of 32514 pixels in the header
    const std::string cut = two_pixel_png().substr(0, 45);
    for (const ImageFault& each :
         {ImageFault{"gif.png", "GIF89a..........................", "neither a PNG nor a JPEG"},
          ImageFault{"huge.png", huge, "32514 x 1 pixels"}, ImageFault{"cut.png", cut, "cannot be decoded"},
          ImageFault{"empty.png", "", "empty"}}) {
        folder.write(each.name, each.bytes);
        json document = triangle_document();
        document["images"] = json::array({{{"uri", each.name}}});
        document["textures"] = json::array({{{"source", 0}}});
        document["materials"] = json::array({{{"emissiveTexture", {{"index", 0}}}}});
        const std::string message = error_of(folder.write("image.gltf", document.dump()));
        EXPECT_NE(message.find("/images/0"), std::string::npos) << each.name << ": " << message;
        EXPECT_NE(message.find(each.says), std::string::npos) << each.name << ": " << message;
    }
    json document = triangle_document();
    document["images"] = json::array({{{"uri", "absent.png"}}});
    EXPECT_NE(error_of(folder.write("image.gltf", document.dump())).find("/images/0/uri: there is no file"),
              std::string::npos);
}

TEST(GltfError, FarIsWhatIsDrawnAndNotAVertexThatNothingUses) {
    const TemporaryFolder folder;
    json unused = triangle_document();
    set_positions(unused, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1e20f, 0, 0});
    EXPECT_EQ(error_of(folder.write("unused.gltf", unused.dump())), "");
    json used = triangle_document();
    set_positions(used, {0, 0, 0, 1, 0, 0, 0, 1e20f, 0, 1, 1, 0});
    EXPECT_NE(error_of(folder.write("used.gltf", used.dump())).find("/nodes/0: its mesh reaches beyond"),
              std::string::npos);
}

TEST(GltfError, BinaryContainer) {
    const TemporaryFolder folder;
    json document = triangle_document();
    document["buffers"][0].erase("uri");
    const std::string whole = glb(document.dump(), triangle_bytes());
    const auto with = [&](std::size_t byte, const std::string& bytes) {
        return std::string(whole).replace(byte, bytes.size(), bytes);
    };
    const auto message = [&](const std::string& bytes) { return error_of(folder.write("model.glb", bytes)); };
    ASSERT_EQ(message(whole), "");
    EXPECT_NE(message(with(0, "glTX")).find("byte 0: "), std::string::npos);
    EXPECT_NE(message(with(4, std::string("\1\0\0\0", 4))).find("byte 4: this is glTF 1.0"), std::string::npos);
    EXPECT_NE(message(with(4, std::string("\3\0\0\0", 4))).find("byte 4: the GLB has version 3"), std::string::npos);
    EXPECT_NE(message(with(8, "\xFF\xFF\xFF\x7F")).find("byte 8: the GLB says it has 2147483647 bytes"),
              std::string::npos);
    EXPECT_NE(message(with(12, "\xFC\xFF\xFF\xFF")).find("byte 12: chunk 0 says it has 4294967292 bytes"),
              std::string::npos);
    EXPECT_NE(message(with(16, "JSOM")).find("byte 16: the first chunk is not JSON"), std::string::npos);
    EXPECT_NE(message(whole.substr(0, 8)).find("byte 8: the GLB header is cut off"), std::string::npos);
    EXPECT_NE(message(whole.substr(0, whole.size() - 4)).find("byte 8: "), std::string::npos);
    json empty_data = document;  // tinygltf 2.7 dies of this one
    empty_data["buffers"][0] = {{"byteLength", 0}, {"uri", "data:;base64,"}};
    EXPECT_NE(message(glb(empty_data.dump(), triangle_bytes())).find("/buffers/0/byteLength: is 0"), std::string::npos);
}

TEST(GltfError, FilesThatAreNone) {
    const TemporaryFolder folder;
    EXPECT_NE(error_of(folder.path() / "absent.gltf").find("there is no file"), std::string::npos);
    EXPECT_NE(error_of(folder.path()).find("is a folder"), std::string::npos);
    EXPECT_NE(error_of(folder.write("text.gltf", "{\n  \"asset\": nothing\n}")).find("line 2, column 1"),
              std::string::npos);
    EXPECT_NE(error_of(folder.write("array.gltf", "[]")).find("must be an object"), std::string::npos);
    EXPECT_NE(error_of(folder.write("empty.gltf", "")).find("line 1"), std::string::npos);
    EXPECT_NE(error_of(folder.write("old.gltf", R"({"meshes": {"a": {}}})")).find("glTF 1.0"), std::string::npos);
}

TEST(GltfError, EveryCutAndEveryFlippedByteOfAGlbEndsWell) {
    const TemporaryFolder folder;
    json document = triangle_document();
    document["buffers"][0].erase("uri");
    const std::string whole = glb(document.dump(), triangle_bytes());
    int loaded = 0;
    int refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ 0x11);
        (error_of(folder.write("flipped.glb", flipped)).empty() ? loaded : refused) += 1;
        EXPECT_NE(error_of(folder.write("cut.glb", whole.substr(0, at))), "") << "cut at byte " << at;
    }
    EXPECT_GT(loaded, 0);  // a changed coordinate is still a triangle
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace halfframe::tests
