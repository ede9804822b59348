// What glTF's extensions make of a scene, and what a file offers to choose from.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "content/content.h"
#include "content/mesh_tools.h"
#include "engine/error.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using nlohmann::json;

class GltfExtensions : public ::testing::Test {
protected:
    Scene load(const json& document, const content::LoadOptions& options = {}) {
        return content::load_gltf(folder_.write("model.gltf", document.dump()), options);
    }
    std::string refusal(const json& document) { return error_of(folder_.write("model.gltf", document.dump())); }
    TemporaryFolder folder_;
};

/// The triangle with one material, a texture of two pixels and two sets of coordinates.
json textured() {
    json document = triangle_document();
    document["images"] = json::array({{{"uri", "data:image/png;base64," + base64(two_pixel_png())}}});
    document["samplers"] = json::array({json::object()});
    document["textures"] = json::array({{{"source", 0}, {"sampler", 0}}});
    document["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    json& primitive = document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    std::string first, second;
    append(first, std::vector<float>{0, 0, 1, 0, 0, 1});
    append(second, std::vector<float>{5, 5, 6, 5, 5, 6});
    primitive["attributes"]["TEXCOORD_0"] = add_accessor(document, add_view(document, first), 5126, "VEC2", 3);
    primitive["attributes"]["TEXCOORD_1"] = add_accessor(document, add_view(document, second), 5126, "VEC2", 3);
    return document;
}

json& texture_use(json& document) { return document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]; }

TEST_F(GltfExtensions, TextureTransformAndItsOwnSet) {
    json document = textured();
    texture_use(document)["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, -0.25}}, {"scale", {2, 3}}, {"rotation", 0.75}, {"texCoord", 1}};
    const Scene scene = load(document);
    const UvMapping& mapping = scene.materials.at(0).base_color_uv;
    EXPECT_EQ(mapping, (UvMapping{1, {0.5f, -0.25f}, {2.0f, 3.0f}, 0.75f})) << "texCoord of the extension wins";
    EXPECT_EQ(scene.meshes.at(0).uv1.at(1), glm::vec2(6.0f, 5.0f));
    EXPECT_TRUE(load(textured()).meshes.at(0).uv1.empty()) << "nothing reads the second set";
}

TEST_F(GltfExtensions, TangentsFollowTheCoordinatesOfTheNormalMap) {
    json document = textured();
    std::string normals;
    append(normals, std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        add_accessor(document, add_view(document, normals), 5126, "VEC3", 3);
    document["materials"][0]["normalTexture"] = {{"index", 0}};
    const glm::vec4 plain = load(document).meshes.at(0).tangents.at(0);
    document["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {
        {"rotation", std::numbers::pi / 2.0}};
    const glm::vec4 turned = load(document).meshes.at(0).tangents.at(0);
    EXPECT_NEAR(glm::dot(glm::vec3(plain), glm::vec3(turned)), 0.0f, 1e-6f) << "a quarter turn";
}

TEST_F(GltfExtensions, AThirdSetIsSaidToBeLeftOut) {
    json document = textured();
    texture_use(document)["texCoord"] = 2;
    const Scene scene = load(document);
    EXPECT_FALSE(scene.materials.at(0).base_color_texture);
    ASSERT_EQ(scene.notices.size(), 1u);
    EXPECT_NE(scene.notices[0].find("TEXCOORD_2"), std::string::npos);
}

TEST_F(GltfExtensions, EveryFilterAndWrapOfASampler) {
    struct Case {
        int mag, min;
        bool linear, mipmaps, min_linear, between;
    };
    for (const Case& each : {Case{9728, 9728, false, false, false, false}, Case{9728, 9729, false, false, true, false},
                             Case{9729, 9984, true, true, false, false}, Case{9729, 9985, true, true, true, false},
                             Case{9728, 9986, false, true, false, true}, Case{9728, 9987, false, true, true, true},
                             Case{9729, 9987, true, true, true, true}}) {
        json document = textured();
        document["samplers"][0] = {
            {"magFilter", each.mag}, {"minFilter", each.min}, {"wrapS", 33071}, {"wrapT", 33648}};
        const Texture texture = load(document).materials.at(0).base_color_texture;
        const Minify minify = texture.minify.value_or(Minify{texture.linear, texture.linear});
        EXPECT_EQ(texture.linear, each.linear) << each.min;
        EXPECT_EQ(texture.mipmaps, each.mipmaps) << each.min;
        EXPECT_EQ(minify.linear, each.min_linear) << each.min;
        EXPECT_EQ(texture.mipmaps && minify.between, each.between) << each.min;
        EXPECT_EQ(texture.wrap_u, Wrap::clamp);
        EXPECT_EQ(texture.wrap_v, Wrap::mirror);
    }
}

TEST_F(GltfExtensions, MaterialModels) {
    json document = textured();
    json& extensions = document["materials"][0]["extensions"];
    extensions["KHR_materials_ior"] = {{"ior", 2.0}};
    extensions["KHR_materials_specular"] = {{"specularFactor", 0.5},
                                            {"specularColorFactor", {1, 0.5, 20}},
                                            {"specularTexture", {{"index", 0}}},
                                            {"specularColorTexture", {{"index", 0}}}};
    Material material = load(document).materials.at(0);
    EXPECT_EQ(material.ior, 2.0f);
    EXPECT_EQ(glm::vec2(material.specular), glm::vec2(0.5f, 0.25f));
    EXPECT_FLOAT_EQ(material.specular.b, 4.5f) << "a ninth reflects at 2; 20 ninths are cut to 1";
    EXPECT_TRUE(material.specular_texture && material.specular_color_texture);

    extensions = {{"KHR_materials_pbrSpecularGlossiness",
                   {{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                    {"specularFactor", {0.5, 0.6, 0.7}},
                    {"glossinessFactor", 0.25},
                    {"specularGlossinessTexture", {{"index", 0}}}}}};
    material = load(document).materials.at(0);
    EXPECT_EQ(material.model, MaterialModel::specular_glossiness);
    EXPECT_EQ(material.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.specular, glm::vec3(0.5f, 0.6f, 0.7f));
    EXPECT_EQ(material.smoothness, 0.25f);
    EXPECT_FALSE(material.base_color_texture) << "that of the metallic-roughness fallback";
    EXPECT_TRUE(material.specular_smoothness_texture);

    extensions = {{"KHR_materials_unlit", json::object()}};
    material = load(document).materials.at(0);
    EXPECT_EQ(material.model, MaterialModel::unlit);
    EXPECT_TRUE(material.base_color_texture);
}

TEST_F(GltfExtensions, LightsHangOnNodes) {
    json document = triangle_document();
    document["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 2},
        {"type": "point", "name": "bulb", "intensity": 62.8318530718},
        {"type": "spot", "range": 7, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.4}}])");
    for (int i = 0; i < 3; ++i) {
        document["nodes"].push_back({{"translation", {i, 2, 3}},
                                     {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                                     {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
        document["scenes"][0]["nodes"].push_back(i + 1);
    }
    const Scene scene = load(document);
    ASSERT_EQ(scene.lights.size(), 3u);
    const Light& sun = scene.lights[0];
    EXPECT_EQ(sun.kind, LightKind::sun);
    EXPECT_NEAR(sun.color.r, 2.0 / std::numbers::pi, 1e-6) << "a white wall sends back lux over pi";
    EXPECT_NEAR(sun.color.g, 1.0 / std::numbers::pi, 1e-6);
    EXPECT_NEAR(sun.direction.y, -1.0f, 1e-6f) << "-Z of a node that looks down";
    const Light& bulb = scene.lights[1];
    EXPECT_EQ(bulb.name, "bulb");
    EXPECT_EQ(bulb.position, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_NEAR(bulb.range_m, std::sqrt(20.0f / 1e-3f), 0.01f) << "where a thousandth is left";
    const Light& spot = scene.lights[2];
    EXPECT_EQ(spot.kind, LightKind::spot);
    EXPECT_FLOAT_EQ(spot.range_m, 7.0f);
    EXPECT_FLOAT_EQ(spot.inner_cone_rad, 0.1f);
    EXPECT_FLOAT_EQ(spot.outer_cone_rad, 0.4f);
}

json with_variants() {
    json document = triangle_document();
    document["materials"] = json::parse(R"([{"name": "red"}, {"name": "green"}, {"name": "blue"}])");
    document["extensions"]["KHR_materials_variants"]["variants"] =
        json::parse(R"([{"name": "day"}, {"name": "night"}])");
    json& primitive = document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] =
        json::parse(R"([{"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}])");
    return document;
}

TEST_F(GltfExtensions, VariantsByNameAndByNumber) {
    const auto material = [&](const std::string& variant) {
        const Scene scene = load(with_variants(), {.scene = {}, .variant = variant});
        return scene.materials.at(static_cast<std::size_t>(scene.surfaces.at(0).material)).name;
    };
    EXPECT_EQ(material(""), "red");
    EXPECT_EQ(material("day"), "green");
    EXPECT_EQ(material("1"), "blue");
    try {
        (void)material("nigth");
        FAIL() << "a variant that is not there";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        EXPECT_NE(std::string(error.what()).find("did you mean 'night'?"), std::string::npos) << error.what();
    }
    EXPECT_THROW((void)load(triangle_document(), {.scene = {}, .variant = "day"}), Error);
}

TEST_F(GltfExtensions, ScenesByNameAndByNumber) {
    json document = triangle_document();
    document["nodes"].push_back({{"name", "second"}, {"mesh", 0}});
    document["scenes"] = json::parse(R"([{"nodes": [0]}, {"name": "other", "nodes": [1]}])");
    const auto name_of = [&](const std::string& scene) {
        return load(document, {.scene = scene, .variant = {}}).surfaces.at(0).name;
    };
    EXPECT_NE(name_of(""), "second");
    EXPECT_EQ(name_of("other"), "second");
    EXPECT_EQ(name_of("1"), "second");
    EXPECT_THROW((void)name_of("2"), Error);
}

TEST_F(GltfExtensions, InstancesAreSurfacesOfOneMesh) {
    json document = triangle_document();
    std::string translations, rotations, scales;
    append(translations, std::vector<float>{1, 0, 0, 2, 0, 0, 3, 0, 0});
    append(rotations, std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767});
    append(scales, std::vector<float>{1, 1, 1, 2, 2, 2, -1, 1, 1});
    document["nodes"][0]["translation"] = {0, 10, 0};
    document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", add_accessor(document, add_view(document, translations), 5126, "VEC3", 3)},
        {"ROTATION", add_accessor(document, add_view(document, rotations), 5122, "VEC4", 3, true)},
        {"SCALE", add_accessor(document, add_view(document, scales), 5126, "VEC3", 3)}};
    document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = load(document);
    ASSERT_EQ(scene.surfaces.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 2u) << "the mirrored one has faces that turn the other way";
    const glm::vec4 tip = scene.surfaces[1].world_from_local * glm::vec4(1.0f, 0.0f, 0.0f, 1.0f);
    EXPECT_NEAR(tip.x, 2.0f, 1e-3f);  // a quarter turn about Z, twice as long
    EXPECT_NEAR(tip.y, 12.0f, 1e-3f);
    document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = 0;
    EXPECT_NE(refusal(document).find("/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE"),
              std::string::npos);
}

/// The triangle's positions and indices, compressed, with a fallback buffer that has no data.
json compressed() {
    json document = triangle_document();
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::vector<std::uint16_t> indices{0, 1, 2};
    std::vector<unsigned char> vertex_stream(meshopt_encodeVertexBufferBound(3, 12));
    vertex_stream.resize(
        meshopt_encodeVertexBuffer(vertex_stream.data(), vertex_stream.size(), positions.data(), 3, 12));
    const std::vector<unsigned int> wide(indices.begin(), indices.end());
    std::vector<unsigned char> index_stream(meshopt_encodeIndexBufferBound(3, 3));
    index_stream.resize(meshopt_encodeIndexBuffer(index_stream.data(), index_stream.size(), wide.data(), 3));
    std::string bytes(vertex_stream.begin(), vertex_stream.end());
    bytes.append(index_stream.begin(), index_stream.end());
    document["buffers"] =
        json::array({{{"byteLength", bytes.size()}, {"uri", "data:;base64," + base64(bytes)}},
                     {{"byteLength", 42}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}});
    document["bufferViews"] = json::array({{{"buffer", 1},
                                            {"byteOffset", 36},
                                            {"byteLength", 6},
                                            {"extensions",
                                             {{"EXT_meshopt_compression",
                                               {{"buffer", 0},
                                                {"byteOffset", vertex_stream.size()},
                                                {"byteLength", index_stream.size()},
                                                {"byteStride", 2},
                                                {"count", 3},
                                                {"mode", "TRIANGLES"}}}}}},
                                           {{"buffer", 1},
                                            {"byteLength", 36},
                                            {"byteStride", 12},
                                            {"extensions",
                                             {{"EXT_meshopt_compression",
                                               {{"buffer", 0},
                                                {"byteLength", vertex_stream.size()},
                                                {"byteStride", 12},
                                                {"count", 3},
                                                {"mode", "ATTRIBUTES"}}}}}}});
    document["extensionsRequired"] = {"EXT_meshopt_compression"};
    return document;
}

TEST_F(GltfExtensions, MeshoptStreamsAreUnpacked) {
    const Scene scene = load(compressed());
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(scene.meshes.at(0).positions, load(triangle_document()).meshes.at(0).positions);
}

TEST_F(GltfExtensions, DamagedMeshoptStreamsAreRefused) {
    const auto broken = [&](const std::function<void(json&)>& change) {
        json document = compressed();
        change(document["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]);
        return refusal(document);
    };
    EXPECT_NE(broken([](json& e) { e["byteLength"] = 5; }).find("damaged"), std::string::npos);
    EXPECT_NE(broken([](json& e) {
                  e["byteOffset"] = 3;
                  e["byteLength"] = 20;
              }).find("damaged"),
              std::string::npos);
    EXPECT_NE(broken([](json& e) {
                  e["buffer"] = 1;
                  e["byteLength"] = 20;
              }).find("has no data"),
              std::string::npos);
    EXPECT_NE(broken([](json& e) { e["buffer"] = 7; }).find("number 7 of 2 buffers"), std::string::npos);
    EXPECT_NE(broken([](json& e) { e["mode"] = "POINTS"; }).find("POINTS"), std::string::npos);
    EXPECT_NE(broken([](json& e) { e["filter"] = "OCTAHEDRAL"; }).find("does not go with"), std::string::npos);
    EXPECT_NE(broken([](json& e) { e["byteStride"] = 6; }).find("is 6"), std::string::npos);
    EXPECT_NE(broken([](json& e) { e["count"] = 4; }).find("makes 48 bytes"), std::string::npos);
    EXPECT_NE(broken([](json& e) { e["byteLength"] = 100000; }).find("ends at byte"), std::string::npos);
}

TEST_F(GltfExtensions, ZerosWithoutAViewLeaveAlphaAtOne) {
    json document = triangle_document();
    document["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 3}});
    document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = document["accessors"].size() - 1;
    EXPECT_EQ(load(document).meshes.at(0).colors.at(0), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
}

}  // namespace
}  // namespace halfframe::tests
