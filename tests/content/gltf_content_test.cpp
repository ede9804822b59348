// What load_gltf() reads: known answers on files small enough to know by heart.
#include <cmath>

#include <gtest/gtest.h>

#include "content/content.h"
#include "content/gltf_model.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using nlohmann::json;

class GltfContent : public ::testing::Test {
protected:
    Scene load(const json& document) { return content::load_gltf(folder_.write("model.gltf", document.dump())); }

    TemporaryFolder folder_;
};

void expect_near(const glm::vec3& actual, const glm::vec3& expected) {
    for (int axis = 0; axis < 3; ++axis) {
        // 1e-6: a few float roundings of numbers up to 4.
        EXPECT_NEAR(actual[axis], expected[axis], 1e-6) << "axis " << axis;
    }
}

/// Normal of the first triangle as GL sees it (counter-clockwise is front), in the world.
glm::vec3 front_of(const Scene& scene, const Surface& surface) {
    const Mesh& mesh = scene.meshes.at(static_cast<std::size_t>(surface.mesh));
    glm::vec3 corner[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t at = mesh.indices.empty() ? i : mesh.indices[i];
        corner[i] = glm::vec3(surface.world_from_local * glm::vec4(mesh.positions[at], 1.0f));
    }
    return glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
}

TEST_F(GltfContent, TriangleHasItsPlacesAndFlatNormals) {
    const Scene scene = load(triangle_document());
    EXPECT_EQ(scene.name, "model");
    ASSERT_EQ(scene.surfaces.size(), 1u);
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.positions.size(), 3u);
    expect_near(mesh.positions[1], {1, 0, 0});
    ASSERT_EQ(mesh.normals.size(), 3u);
    expect_near(mesh.normals[0], {0, 0, 1});
    EXPECT_TRUE(mesh.uv.empty());
    EXPECT_TRUE(mesh.tangents.empty());
    EXPECT_TRUE(scene.notices.empty());
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "default");
}

TEST_F(GltfContent, EveryIndexWidth) {
    for (const int type : {5121, 5123, 5125}) {
        json document = triangle_document();
        std::string bytes;
        if (type == 5121) append(bytes, std::vector<std::uint8_t>{2, 0, 1});
        if (type == 5123) append(bytes, std::vector<std::uint16_t>{2, 0, 1});
        if (type == 5125) append(bytes, std::vector<std::uint32_t>{2, 0, 1});
        const std::size_t accessor = add_accessor(document, add_view(document, bytes), type, "SCALAR", 3);
        document["meshes"][0]["primitives"][0]["indices"] = accessor;
        const Scene scene = load(document);
        // Flat shading unrolls the indices: the order of the vertices is the order of the indices.
        ASSERT_EQ(scene.meshes.at(0).positions.size(), 3u) << type;
        expect_near(scene.meshes[0].positions[0], {0, 1, 0});
        expect_near(scene.meshes[0].positions[1], {0, 0, 0});
    }
}

TEST_F(GltfContent, AnIndexIsBelowTheCountOrFound) {
    for (const std::uint32_t count : {1u, 3u, 8388608u}) {
        for (const std::uint32_t last : {0u, count - 1, count, count + 1, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
            for (const std::size_t place : {0u, 6u, 8u}) {
                std::vector<std::uint32_t> indices(9, 0);
                indices[place] = last;
                EXPECT_EQ(content::all_below(indices, count), last < count) << last << " of " << count;
            }
        }
    }
    EXPECT_FALSE(content::all_below(std::vector<std::uint32_t>{0}, 0));
    EXPECT_TRUE(content::all_below({}, 0));
}

TEST_F(GltfContent, NoIndices) {
    json document = triangle_document();
    document["meshes"][0]["primitives"][0].erase("indices");
    EXPECT_EQ(load(document).meshes.at(0).positions.size(), 3u);
}

TEST_F(GltfContent, NormalsGivenAreKeptUnitAndIndicesStay) {
    json document = triangle_document();
    std::string bytes;
    append(bytes, std::vector<float>{0, 0, 2, 0, 0, 0, 3, 0, 0});  // too long, zero, too long
    document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        add_accessor(document, add_view(document, bytes), 5126, "VEC3", 3);
    const Scene scene = load(document);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    expect_near(mesh.normals.at(0), {0, 0, 1});
    expect_near(mesh.normals.at(1), {0, 0, 1});  // of its face
    expect_near(mesh.normals.at(2), {1, 0, 0});
    ASSERT_EQ(scene.notices.size(), 1u);
    EXPECT_NE(scene.notices[0].find("1 normals of /meshes/0/primitives/0"), std::string::npos);
}

TEST_F(GltfContent, InterleavedStreamsWithStride) {
    json document = triangle_document();
    std::string bytes;
    for (int i = 0; i < 3; ++i) {  // position, then uv as normalized u16
        append(bytes, std::vector<float>{static_cast<float>(i), 2.0f, static_cast<float>(-i * i)});
        append(bytes, std::vector<std::uint16_t>{static_cast<std::uint16_t>(i * 32767), 65535});
    }
    const std::size_t view = add_view(document, bytes);
    document["bufferViews"][view]["byteStride"] = 16;
    json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    attributes["POSITION"] = add_accessor(document, view, 5126, "VEC3", 3);
    const std::size_t uv = add_accessor(document, view, 5123, "VEC2", 3, true);
    document["accessors"][uv]["byteOffset"] = 12;
    attributes["TEXCOORD_0"] = uv;
    const Scene scene = load(document);
    const Mesh& mesh = scene.meshes.at(0);
    expect_near(mesh.positions.at(2), {2, 2, -4});
    EXPECT_FLOAT_EQ(mesh.uv.at(1).x, 32767.0f / 65535.0f);
    EXPECT_FLOAT_EQ(mesh.uv.at(2).x, 65534.0f / 65535.0f);
    EXPECT_FLOAT_EQ(mesh.uv.at(0).y, 1.0f);
}

TEST_F(GltfContent, ColorsOfEveryType) {
    struct Case {
        int type;
        std::string shape;
        std::string bytes;
        glm::vec4 first;
    };
    std::vector<Case> cases(3);
    cases[0] = {5126, "VEC3", {}, {0.25f, 0.5f, 1.0f, 1.0f}};
    append(cases[0].bytes, std::vector<float>{0.25f, 0.5f, 1.5f, 0, 0, 0, 0, 0, 0});
    cases[1] = {5121, "VEC4", {}, {1.0f, 0.2f, 0.0f, 0.4f}};
    append(cases[1].bytes, std::vector<std::uint8_t>{255, 51, 0, 102, 0, 0, 0, 0, 0, 0, 0, 0});
    cases[2] = {5123, "VEC4", {}, {1.0f, 0.2f, 0.0f, 0.4f}};
    append(cases[2].bytes, std::vector<std::uint16_t>{65535, 13107, 0, 26214, 0, 0, 0, 0, 0, 0, 0, 0});
    for (const Case& each : cases) {
        json document = triangle_document();
        document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
            add_accessor(document, add_view(document, each.bytes), each.type, each.shape, 3, each.type != 5126);
        const Scene scene = load(document);
        for (int i = 0; i < 4; ++i) {
            // 1e-6: one float division.
            EXPECT_NEAR(scene.meshes.at(0).colors.at(0)[i], each.first[i], 1e-6) << each.type << " " << i;
        }
    }
}

TEST_F(GltfContent, SparseAccessorReplacesOverItsBaseAndOverZero) {
    std::string indices;
    append(indices, std::vector<std::uint16_t>{1});
    std::string values;
    append(values, std::vector<float>{5, 6, 7});
    for (const bool with_base : {true, false}) {
        json document = triangle_document();
        const std::size_t index_view = add_view(document, indices);
        const std::size_t value_view = add_view(document, values);
        document["accessors"][1]["sparse"] = {{"count", 1},
                                              {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                                              {"values", {{"bufferView", value_view}}}};
        if (!with_base) {
            document["accessors"][1].erase("bufferView");
        }
        const Scene scene = load(document);
        expect_near(scene.meshes.at(0).positions.at(1), {5, 6, 7});
        expect_near(scene.meshes.at(0).positions.at(2), with_base ? glm::vec3(0, 1, 0) : glm::vec3(0));
    }
}

TEST_F(GltfContent, MatrixAndTranslationRotationScaleAgree) {
    json document = triangle_document();
    const float half = std::sqrt(0.5f);  // a quarter turn around Y
    document["nodes"] =
        json::array({{{"children", {1, 2}}, {"translation", {10, 0, 0}}},
                     {{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}, {"scale", {2, 3, 4}}},
                     {{"mesh", 0}, {"matrix", {0, 0, -2, 0, 0, 3, 0, 0, 4, 0, 0, 0, 1, 2, 3, 1}}}});
    const Scene scene = load(document);
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 1u) << "the mesh is shared";
    for (const Surface& surface : scene.surfaces) {
        expect_near(glm::vec3(surface.world_from_local * glm::vec4(1, 0, 0, 1)), {11, 2, 1});
        expect_near(glm::vec3(surface.world_from_local * glm::vec4(0, 0, 1, 1)), {15, 2, 3});
    }
}

TEST_F(GltfContent, NegativeScaleKeepsFrontsInFront) {
    json document = triangle_document();
    std::string bytes;
    append(bytes, std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        add_accessor(document, add_view(document, bytes), 5126, "VEC3", 3);
    document["nodes"] =
        json::array({{{"mesh", 0}}, {{"mesh", 0}, {"scale", {-1, 1, 1}}}, {{"mesh", 0}, {"scale", {-2, -2, 1}}}});
    document["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = load(document);
    ASSERT_EQ(scene.surfaces.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 2u) << "one mirrored copy, and two negative scales are a rotation";
    for (const Surface& surface : scene.surfaces) {
        expect_near(front_of(scene, surface), {0, 0, 1});
    }
}

TEST_F(GltfContent, ScenesAreTheDefaultTheFirstOrAllRoots) {
    json document = triangle_document();
    document["nodes"] = json::array({{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}});
    document["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {1}}}});
    document["scene"] = 1;
    EXPECT_EQ(load(document).surfaces.at(0).name, "b");
    document.erase("scene");
    EXPECT_EQ(load(document).surfaces.at(0).name, "a");
    document.erase("scenes");
    EXPECT_EQ(load(document).surfaces.size(), 2u);
}

TEST_F(GltfContent, AllSevenModes) {
    const std::vector<Primitive> expected{Primitive::points,      Primitive::lines,     Primitive::line_loop,
                                          Primitive::line_strip,  Primitive::triangles, Primitive::triangle_strip,
                                          Primitive::triangle_fan};
    for (std::size_t mode = 0; mode < expected.size(); ++mode) {
        json document = triangle_document();
        document["meshes"][0]["primitives"][0]["mode"] = mode;
        const Scene scene = load(document);
        ASSERT_EQ(scene.meshes.size(), 1u) << mode;
        // Strips and fans without normals become flat shaded lists.
        EXPECT_EQ(scene.meshes[0].primitive, mode > 4 ? Primitive::triangles : expected[mode]) << mode;
        // Two lines need four vertices: the odd one out is left out, and said.
        EXPECT_EQ(scene.notices.size(), mode == 1 ? 1u : 0u) << mode;
    }
}

TEST_F(GltfContent, CamerasStandWhereTheirNodesStand) {
    json document = triangle_document();
    document["cameras"] = json::array(
        {{{"type", "perspective"}, {"name", "wide"}, {"perspective", {{"yfov", 1.25}, {"znear", 0.5}}}},
         {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 1}, {"zfar", 9}}}}});
    document["nodes"] = json::array({{{"mesh", 0}, {"children", {1, 2}}, {"translation", {0, 0, 5}}},
                                     {{"camera", 0}, {"scale", {3, 3, 3}}},
                                     {{"camera", 1}, {"name", "plan"}}});
    const Scene scene = load(document);
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "wide");
    EXPECT_FLOAT_EQ(scene.cameras[0].fov_y_rad, 1.25f);
    EXPECT_FLOAT_EQ(scene.cameras[0].far_m, 10000.0f) << "an infinite far plane";
    expect_near(glm::vec3(scene.cameras[0].world_from_view[3]), {0, 0, 5});
    expect_near(glm::vec3(scene.cameras[0].world_from_view[0]), {1, 0, 0});  // the scale does not count
    EXPECT_EQ(scene.cameras[1].name, "plan");
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_FLOAT_EQ(scene.cameras[1].half_height_m, 2.0f);
    EXPECT_FLOAT_EQ(scene.cameras[1].far_m, 9.0f);
}

json textured_document() {
    json document = triangle_document();
    std::string uv;
    append(uv, std::vector<float>{0, 1, 1, 1, 0, 0});
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        add_accessor(document, add_view(document, uv), 5126, "VEC2", 3);
    document["meshes"][0]["primitives"][0]["material"] = 0;
    document["images"] = json::array({{{"uri", "data:image/png;base64," + base64(two_pixel_png())}}});
    document["samplers"] =
        json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9729}}});
    document["textures"] = json::array({{{"source", 0}, {"sampler", 0}}, {{"source", 0}}});
    document["materials"] =
        json::array({{{"name", "paint"},
                      {"pbrMetallicRoughness",
                       {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                        {"metallicFactor", 0.25},
                        {"roughnessFactor", 0.75},
                        {"baseColorTexture", {{"index", 0}}},
                        {"metallicRoughnessTexture", {{"index", 1}}}}},
                      {"normalTexture", {{"index", 1}, {"scale", 0.5}}},
                      {"emissiveTexture", {{"index", 1}}},
                      {"emissiveFactor", {0.5, 0.25, 1.0}},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}},
                      {"alphaMode", "MASK"},
                      {"alphaCutoff", 0.125},
                      {"doubleSided", true}}});
    document["extensionsUsed"] = {"KHR_materials_emissive_strength"};
    return document;
}

TEST_F(GltfContent, MaterialsTexturesAndSamplers) {
    const Scene scene = load(textured_document());
    ASSERT_EQ(scene.materials.size(), 1u);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.name, "paint");
    EXPECT_FLOAT_EQ(material.base_color.a, 0.4f);
    EXPECT_FLOAT_EQ(material.metallic, 0.25f);
    EXPECT_FLOAT_EQ(material.roughness, 0.75f);
    expect_near(material.emissive, {2, 1, 4});
    EXPECT_FLOAT_EQ(material.normal_scale, 0.5f);
    EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
    EXPECT_FLOAT_EQ(material.alpha_cutoff, 0.125f);
    EXPECT_TRUE(material.double_sided);
    EXPECT_EQ(material.base_color_texture.wrap_u, Wrap::clamp);
    EXPECT_EQ(material.base_color_texture.wrap_v, Wrap::mirror);
    EXPECT_FALSE(material.base_color_texture.linear);
    EXPECT_FALSE(material.base_color_texture.mipmaps);
    EXPECT_EQ(material.normal_texture.wrap_u, Wrap::repeat);
    EXPECT_TRUE(material.normal_texture.linear);
    EXPECT_TRUE(material.normal_texture.mipmaps);
    ASSERT_EQ(scene.images.size(), 2u) << "one picture as colour and once more as data";
    const Image& color = scene.images.at(static_cast<std::size_t>(material.base_color_texture.image));
    const Image& data = scene.images.at(static_cast<std::size_t>(material.normal_texture.image));
    EXPECT_TRUE(color.srgb);
    EXPECT_FALSE(data.srgb);
    EXPECT_EQ(material.emissive_texture.image, material.base_color_texture.image);
    EXPECT_EQ(color.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
    EXPECT_EQ(data.rgba, color.rgba);
    EXPECT_TRUE(scene.notices.empty()) << scene.notices.at(0);
}

TEST_F(GltfContent, ANormalMapBringsTangents) {
    const Scene scene = load(textured_document());
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
    // u grows along +X; v falls along +Y, which is up in the picture: right-handed.
    expect_near(glm::vec3(mesh.tangents[0]), {1, 0, 0});
    EXPECT_EQ(mesh.tangents[0].w, 1.0f);
}

TEST_F(GltfContent, TangentsOfTheFileAreReadForANormalMapOnly) {
    json document = textured_document();
    std::string normals, tangents;
    append(normals, std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    append(tangents, std::vector<float>{0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1});
    json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = add_accessor(document, add_view(document, normals), 5126, "VEC3", 3);
    attributes["TANGENT"] = add_accessor(document, add_view(document, tangents), 5126, "VEC4", 3);
    document["materials"].push_back({{"name", "without a normal map"}});
    document["meshes"].push_back(document["meshes"][0]);
    document["meshes"][1]["primitives"][0]["material"] = 1;
    document["nodes"].push_back({{"mesh", 1}});
    document["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(document);
    ASSERT_EQ(scene.surfaces.size(), 2u);
    const auto mesh_of = [&](std::size_t i) {
        return scene.meshes.at(static_cast<std::size_t>(scene.surfaces[i].mesh));
    };
    EXPECT_EQ(mesh_of(0).tangents, std::vector<glm::vec4>(3, {0, 1, 0, -1}));
    EXPECT_TRUE(mesh_of(1).tangents.empty());
    EXPECT_EQ(mesh_of(1).normals.size(), 3u);
}

TEST_F(GltfContent, SixteenBitImagesKeepTheirUpperBytes) {
    json document = textured_document();
    document["images"][0]["uri"] = "data:image/png;base64," + base64(sixteen_bit_png());
    EXPECT_EQ(load(document).images.at(0).rgba, (std::vector<std::uint8_t>{0x12, 0x56, 0x9A, 255}));
}

TEST_F(GltfContent, ImageInABufferView) {
    json document = textured_document();
    const std::size_t view = add_view(document, two_pixel_png());
    document["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
    EXPECT_EQ(load(document).images.at(0).width, 2);
}

TEST_F(GltfContent, GlbAndFilesWithPercentSigns) {
    json document = triangle_document();
    document["buffers"][0].erase("uri");
    const Scene binary = content::load_gltf(folder_.write("model.glb", glb(document.dump(), triangle_bytes())));
    EXPECT_EQ(binary.surfaces.size(), 1u);
    folder_.write("my data.bin", triangle_bytes() + "tail");
    document["buffers"][0]["uri"] = "my%20data.bin";
    EXPECT_EQ(load(document).surfaces.size(), 1u);
}

TEST_F(GltfContent, WhatIsLeftOutIsSaidOnce) {
    json document = textured_document();
    document["extensionsUsed"] = {"KHR_materials_clearcoat"};
    document["materials"][0]["emissiveTexture"]["texCoord"] = 2;
    const Scene scene = load(document);
    ASSERT_EQ(scene.notices.size(), 2u);
    EXPECT_NE(scene.notices[0].find("KHR_materials_clearcoat"), std::string::npos);
    EXPECT_NE(scene.notices[1].find("emissiveTexture of /materials/0"), std::string::npos);
    EXPECT_FALSE(scene.materials.at(0).emissive_texture);
}

TEST_F(GltfContent, NothingToDrawIsNoError) {
    const Scene scene = load({{"asset", {{"version", "2.0"}}}});
    EXPECT_TRUE(scene.surfaces.empty());
    ASSERT_EQ(scene.notices.size(), 1u);
    json flat = triangle_document();
    flat["nodes"][0]["scale"] = {0, 0, 0};
    EXPECT_TRUE(load(flat).surfaces.empty());
}

}  // namespace
}  // namespace halfframe::tests
