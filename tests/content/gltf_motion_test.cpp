// Joints, weights, morph targets, skins and animations of glTF files, and what is refused of them.
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "content/content.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using nlohmann::json;

template <typename T>
std::size_t accessor(json& document, const std::vector<T>& values, int component, const std::string& type,
                     std::size_t count, bool normalized = false) {
    std::string bytes;
    append(bytes, values);
    return add_accessor(document, add_view(document, bytes), component, type, count, normalized);
}

json& primitive(json& document) { return document["meshes"][0]["primitives"][0]; }

/// The triangle on two joints (nodes 1 and 2), with two sets of joints and weights: node 0 carries the mesh.
json skinned_document() {
    json document = triangle_document();
    document["nodes"].push_back({{"name", "hip"}, {"children", {2}}, {"translation", {0, 1, 0}}});
    document["nodes"].push_back({{"name", "knee"}, {"translation", {0, 1, 0}}});
    document["scenes"][0]["nodes"] = {0, 1};
    document["nodes"][0]["skin"] = 0;
    document["skins"] = json::array({{{"joints", {1, 2}}}});
    primitive(document)["attributes"]["JOINTS_0"] =
        accessor(document, std::vector<std::uint8_t>{0, 1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 0}, 5121, "VEC4", 3);
    // Byte weights: the second vertex has no sum of 1 until its second set is added.
    primitive(document)["attributes"]["WEIGHTS_0"] = accessor(
        document, std::vector<std::uint8_t>{255, 0, 0, 0, 102, 51, 51, 0, 255, 0, 0, 0}, 5121, "VEC4", 3, true);
    primitive(document)["attributes"]["JOINTS_1"] =
        accessor(document, std::vector<std::uint16_t>{0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, 5123, "VEC4", 3);
    primitive(document)["attributes"]["WEIGHTS_1"] =
        accessor(document, std::vector<float>{0, 0, 0, 0, 0.15f, 0.05f, 0, 0, 0, 0, 0, 0}, 5126, "VEC4", 3);
    return document;
}

/// As above with an animation that moves node 2 up by a cubic and turns it by normalized shorts.
json animated_document() {
    json document = skinned_document();
    const std::size_t times = accessor(document, std::vector<float>{0.5f, 2.0f}, 5126, "SCALAR", 2);
    const std::size_t cubic =
        accessor(document, std::vector<float>{0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0}, 5126, "VEC3", 6);
    const std::size_t turns =
        accessor(document, std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 23170, 23170}, 5122, "VEC4", 2, true);
    document["animations"] = json::array({{{"name", "kick"},
                                           {"samplers",
                                            {{{"input", times}, {"output", cubic}, {"interpolation", "CUBICSPLINE"}},
                                             {{"input", times}, {"output", turns}}}},
                                           {"channels",
                                            {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}},
                                             {{"sampler", 1}, {"target", {{"node", 2}, {"path", "rotation"}}}},
                                             {{"sampler", 1}, {"target", {{"path", "pointer"}}}}}}}});
    return document;
}

/// The triangle with a sparse morph target of float and weights.
json morphing_document() {
    json document = triangle_document();
    std::string index, value;
    append(index, std::vector<std::uint8_t>{2});
    append(value, std::vector<float>{0, 5, 0});
    const std::size_t index_view = add_view(document, index), value_view = add_view(document, value);
    const std::size_t target = document["accessors"].size();
    document["accessors"].push_back({{"componentType", 5126},
                                     {"type", "VEC3"},
                                     {"count", 3},
                                     {"sparse",
                                      {{"count", 1},
                                       {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                                       {"values", {{"bufferView", value_view}}}}}});
    primitive(document)["targets"] = json::array({{{"POSITION", target}}, {{"POSITION", 1}}});
    document["meshes"][0]["weights"] = {0.25, 0.5};
    return document;
}

class GltfMotion : public testing::Test {
protected:
    Scene load(const json& document) { return content::load_gltf(folder_.write("model.gltf", document.dump())); }
    TemporaryFolder folder_;
};

TEST_F(GltfMotion, SkinsKeepTheFourStrongestAndTheirSumIsOne) {
    const Scene scene = load(skinned_document());
    ASSERT_EQ(scene.skins.size(), 1u);
    ASSERT_EQ(scene.nodes.size(), 2u) << "only what moves: the mesh's own node does not";
    EXPECT_EQ(scene.nodes[1].name, "knee");
    EXPECT_EQ(scene.nodes[1].parent, 0);
    EXPECT_EQ(scene.skins[0].joints, (std::vector<int>{0, 1}));
    EXPECT_EQ(scene.skins[0].joint_from_mesh.at(1), glm::mat4(1.0f)) << "no inverse bind matrices: identity";
    EXPECT_EQ(scene.surfaces.at(0).skin, 0);
    EXPECT_TRUE(scene.surfaces.at(0).dynamic);
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.joints.size(), mesh.positions.size());
    for (const glm::vec4& weights : mesh.weights)
        EXPECT_NEAR(weights.x + weights.y + weights.z + weights.w, 1.0f, 1e-6f);
    // Five of them: 0.4, 0.2, 0.2, 0.15, 0.05; the last goes, the rest is scaled by 1 / 0.95.
    std::vector<float> of_second;
    for (const glm::vec4& weights : mesh.weights) {
        if (weights.w > 0.0f) of_second = {weights.x, weights.y, weights.z, weights.w};
    }
    ASSERT_EQ(of_second.size(), 4u);
    EXPECT_NEAR(of_second[0], 0.4f / 0.95f, 1e-5f);
    EXPECT_NEAR(of_second[3], 0.15f / 0.95f, 1e-5f);
    bool said = false;
    for (const std::string& sentence : scene.notices)
        said = said || sentence.find("1 vertices on more than four joints") != std::string::npos;
    EXPECT_TRUE(said);
}

TEST_F(GltfMotion, AnimationsAreReadInEveryFormat) {
    const Scene scene = load(animated_document());
    ASSERT_EQ(scene.animations.size(), 1u);
    const Animation& animation = scene.animations[0];
    EXPECT_EQ(animation.name, "kick");
    EXPECT_FLOAT_EQ(animation.duration_s, 2.0f);
    ASSERT_EQ(animation.channels.size(), 2u);
    EXPECT_EQ(animation.channels[0].interpolation, Interpolation::cubic_spline);
    EXPECT_EQ(animation.channels[0].values.size(), 18u);
    EXPECT_EQ(animation.channels[0].node, 1);
    EXPECT_NEAR(animation.channels[1].values[6], std::sqrt(0.5f), 1e-6f) << "normalized shorts, made unit";
    bool said = false;
    for (const std::string& sentence : scene.notices)
        said = said || sentence.find("1 channels of animation kick") != std::string::npos;
    EXPECT_TRUE(said) << "a channel without a node is left out with a word";
}

TEST_F(GltfMotion, MorphTargetsMayBeSparse) {
    const Scene scene = load(morphing_document());
    ASSERT_EQ(scene.meshes.at(0).morph_targets.size(), 2u);
    ASSERT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].morph_weights, (std::vector<float>{0.25f, 0.5f}));
    EXPECT_EQ(scene.surfaces.at(0).node, 0);
    const MorphTarget& sparse = scene.meshes[0].morph_targets[0];
    float most = 0.0f, sum = 0.0f;
    for (const glm::vec3& at : sparse.positions) {
        most = std::max(most, at.y);
        sum += at.x + at.y + at.z;
    }
    EXPECT_FLOAT_EQ(most, 5.0f);
    EXPECT_FLOAT_EQ(sum, 5.0f);
    json own = morphing_document();
    own["nodes"][0]["weights"] = {1.0, 0.0};
    EXPECT_EQ(load(own).nodes.at(0).morph_weights, (std::vector<float>{1.0f, 0.0f})) << "the node's go first";
}

TEST_F(GltfMotion, WhatStandsStillHasNoNodes) {
    const Scene scene = load(triangle_document());
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_EQ(scene.surfaces.at(0).node, -1);
}

struct Fault {
    const char* name;
    json (*document)();
    std::function<void(json&)> break_it;
    const char* place;
    const char* says;
};

json& sampler(json& d, std::size_t index) { return d["animations"][0]["samplers"][index]; }
json& attributes(json& d) { return primitive(d)["attributes"]; }

const std::vector<Fault>& faults() {
    static const std::vector<Fault> kFaults{
        {"joint_past_the_skin", skinned_document, [](json& d) { d["skins"][0]["joints"] = {1}; },
         "/meshes/0/primitives/0/attributes/JOINTS_0", "of skin 0, which has 1"},
        {"no_joints", skinned_document, [](json& d) { d["skins"][0]["joints"] = json::array(); }, "/skins/0/joints",
         "empty"},
        {"skin_without_joints", skinned_document, [](json& d) { attributes(d).erase("JOINTS_0"); }, "/nodes/0/skin",
         "no JOINTS_0"},
        {"skin_without_mesh", skinned_document, [](json& d) { d["nodes"][1]["skin"] = 0; }, "/nodes/1/skin",
         "without a mesh"},
        {"too_few_matrices", skinned_document,
         [](json& d) { d["skins"][0]["inverseBindMatrices"] = accessor(d, std::vector<float>(16), 5126, "MAT4", 1); },
         "/skins/0/inverseBindMatrices", "1 matrices for 2 joints"},
        {"matrix_not_finite", skinned_document,
         [](json& d) {
             d["skins"][0]["inverseBindMatrices"] =
                 accessor(d, std::vector<float>(32, std::numeric_limits<float>::quiet_NaN()), 5126, "MAT4", 2);
         },
         "/skins/0/inverseBindMatrices", "not a number"},
        {"joint_elsewhere", skinned_document, [](json& d) { d["scenes"][0]["nodes"] = {0}; }, "/skins/0/joints/0",
         "not in the scene"},
        {"negative_weight", skinned_document,
         [](json& d) { attributes(d)["WEIGHTS_0"] = accessor(d, std::vector<float>(12, -1.0f), 5126, "VEC4", 3); },
         "/meshes/0/primitives/0/attributes/WEIGHTS_0", "is -1"},
        {"joints_of_float", skinned_document,
         [](json& d) { attributes(d)["JOINTS_0"] = accessor(d, std::vector<float>(12), 5126, "VEC4", 3); },
         "/meshes/0/primitives/0/attributes/JOINTS_0", "does not allow"},
        {"times_fall", animated_document,
         [](json& d) {
             sampler(d, 0)["input"] = accessor(d, std::vector<float>{1.0f, 1.0f}, 5126, "SCALAR", 2);
         },
         "/animations/0/samplers/0/input", "not after 1 s"},
        {"time_not_a_number", animated_document,
         [](json& d) {
             sampler(d, 0)["input"] = accessor(d, std::vector<float>{0.0f, std::nanf("")}, 5126, "SCALAR", 2);
         },
         "/animations/0/samplers/0/input", "not a number"},
        {"output_too_short", animated_document, [](json& d) { sampler(d, 0).erase("interpolation"); },
         "/animations/0/samplers/0/output", "2 times need 2"},
        {"output_of_wrong_type", animated_document, [](json& d) { sampler(d, 1)["output"] = sampler(d, 0)["output"]; },
         "/animations/0/samplers/1/output", "needs VEC4"},
        {"rotation_of_nothing", animated_document,
         [](json& d) { sampler(d, 1)["output"] = accessor(d, std::vector<float>(8), 5126, "VEC4", 2); },
         "/animations/0/samplers/1/output", "unit quaternion"},
        {"interpolation", animated_document, [](json& d) { sampler(d, 0)["interpolation"] = "SMOOTH"; },
         "/animations/0/samplers/0/interpolation", "SMOOTH"},
        {"path", animated_document, [](json& d) { d["animations"][0]["channels"][0]["target"]["path"] = "colour"; },
         "/animations/0/channels/0/target/path", "colour"},
        {"matrix_animated", animated_document,
         [](json& d) {
             d["nodes"][2].erase("translation");
             d["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
         },
         "/animations/0/channels/0/target/node", "cannot be animated"},
        {"moved_twice", animated_document,
         [](json& d) { d["animations"][0]["channels"].push_back(d["animations"][0]["channels"][0]); },
         "/animations/0/channels/3/target", "moves the translation of node 2 too"},
        {"weights_of_no_target", animated_document,
         [](json& d) { d["animations"][0]["channels"][0]["target"]["path"] = "weights"; },
         "/animations/0/channels/0/target/path", "has none"},
        {"target_of_other_length", morphing_document,
         [](json& d) { primitive(d)["targets"][0]["POSITION"] = accessor(d, std::vector<float>(6), 5126, "VEC3", 2); },
         "/meshes/0/primitives/0/targets/0/POSITION", "2 elements"},
        {"tangent_of_a_target_without_a_normal_map", morphing_document,  // which nothing reads
         [](json& d) {
             primitive(d)["attributes"]["NORMAL"] = primitive(d)["attributes"]["POSITION"];
             primitive(d)["attributes"]["TANGENT"] = accessor(d, std::vector<float>(12, 1.0f), 5126, "VEC4", 3);
             primitive(d)["targets"][0]["TANGENT"] = accessor(d, std::vector<float>(9, std::nanf("")), 5126, "VEC3", 3);
         },
         "/meshes/0/primitives/0/targets/0/TANGENT", "not a number"},
        {"weights_of_other_length", morphing_document, [](json& d) { d["meshes"][0]["weights"] = {1}; },
         "/meshes/0/weights", "2"},
    };
    return kFaults;
}

class GltfMotionFault : public testing::TestWithParam<Fault> {};

TEST_P(GltfMotionFault, NamesFileAndPlace) {
    const TemporaryFolder folder;
    json document = GetParam().document();
    ASSERT_EQ(error_of(folder.write("whole.gltf", document.dump())), "");
    GetParam().break_it(document);
    const std::filesystem::path file = folder.write("broken.gltf", document.dump());
    const std::string message = error_of(file);
    EXPECT_TRUE(message.starts_with(file.string() + ": " + GetParam().place + ": ")) << message;
    EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(All, GltfMotionFault, testing::ValuesIn(faults()),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace halfframe::tests
