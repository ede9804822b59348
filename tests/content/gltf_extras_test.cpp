// The keys hf_* of glTF's extras: what they do, what is refused, and that the schema tells the truth.
#include "content/gltf_extras.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "content/content.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using nlohmann::json;

json with_everything() {
    json document = triangle_document();
    document["scenes"][0]["extras"] = json::parse(R"({"hf_ambient": [0.1, 0.2, 0.3], "hf_bloom_strength": 0.5,
        "hf_sky_zenith": [0, 0, 1], "hf_background": [1, 0, 0], "somebody_elses": {"deep": []}})");
    document["nodes"][0]["extras"] = {{"hf_dynamic", true}};
    document["nodes"][0]["camera"] = 0;
    document["cameras"] = json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1},
        "extras": {"hf_exposure": 2.5}}])");
    document["extensions"]["KHR_lights_punctual"]["lights"] =
        json::parse(R"([{"type": "point", "extras": {"hf_radius_m": 0.25}}])");
    document["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    return document;
}

TEST(GltfExtras, SayWhatGltfHasNoWordFor) {
    const TemporaryFolder folder;
    const Scene scene = content::load_gltf(folder.write("model.gltf", with_everything().dump()));
    EXPECT_EQ(scene.ambient, glm::vec3(0.1f, 0.2f, 0.3f));
    ASSERT_TRUE(scene.bloom && scene.sky);
    EXPECT_EQ(scene.bloom->strength, 0.5f);
    EXPECT_EQ(scene.sky->zenith, glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(scene.sky->horizon, Sky{}.horizon) << "one colour given, the others stay";
    EXPECT_EQ(scene.background, glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_TRUE(scene.surfaces.at(0).dynamic);
    EXPECT_EQ(scene.cameras.at(0).exposure, 2.5f);
    EXPECT_EQ(scene.lights.at(0).radius_m, 0.25f);
    json mesh = triangle_document();
    mesh["meshes"][0]["extras"] = {{"hf_dynamic", 1}};
    EXPECT_TRUE(content::load_gltf(folder.write("model.gltf", mesh.dump())).surfaces.at(0).dynamic);
}

TEST(GltfExtras, WrongOnesAreNamed) {
    const TemporaryFolder folder;
    const auto refusal = [&](const char* pointer, const json& value) {
        json document = with_everything();
        document[json::json_pointer(pointer)] = value;
        return error_of(folder.write("model.gltf", document.dump()));
    };
    const std::string unknown = refusal("/nodes/0/extras/hf_dynamc", true);
    EXPECT_NE(unknown.find("/nodes/0/extras: a node has no key 'hf_dynamc', did you mean 'hf_dynamic'?"),
              std::string::npos)
        << unknown;
    const std::string elsewhere = refusal("/nodes/0/extras/hf_exposure", 1);
    EXPECT_NE(elsewhere.find("it belongs to a camera"), std::string::npos) << elsewhere;
    const std::string range = refusal("/scenes/0/extras/hf_bloom_strength", 1.5);
    EXPECT_NE(range.find("/scenes/0/extras/hf_bloom_strength: is 1.5 but must lie from 0 to 1"), std::string::npos)
        << range;
    const std::string type = refusal("/cameras/0/extras/hf_exposure", "bright");
    EXPECT_NE(type.find("/cameras/0/extras/hf_exposure: must be a number but is string"), std::string::npos) << type;
    const std::string count = refusal("/scenes/0/extras/hf_ambient", {1, 2});
    EXPECT_NE(count.find("must hold 3 numbers but holds 2"), std::string::npos) << count;
}

/// The triangle, its material with `keys`, and one texture.
json with_water(const json& keys) {
    json document = triangle_document();
    document["materials"] = json::array({{{"name", "ground"}, {"extras", keys}}});
    document["meshes"][0]["primitives"][0]["material"] = 0;
    // A white pixel.
    document["images"] = json::parse(R"([{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mP8/x8AAwMCAO+ip1sAAAAASUVORK5CYII="}])");
    document["textures"] = json::parse(R"([{"source": 0}])");
    return document;
}

TEST(GltfExtras, SayHowWetASceneIsAndWhatTakesUpWater) {
    const TemporaryFolder folder;
    json document = with_water({{"hf_water", "texture"}, {"hf_water_texture", 0}, {"hf_puddle_depth_m", 0.1}});
    document["scenes"][0]["extras"] = {
        {"hf_wetness", 0.4}, {"hf_wetness_live", true}, {"hf_rain_ended_s", 12}, {"hf_drying_s", 90}, {"hf_puddles", 0.7}};
    const Scene scene = content::load_gltf(folder.write("wet.gltf", document.dump()));
    ASSERT_TRUE(scene.wetness && scene.puddles);
    EXPECT_EQ(scene.wetness->level, 0.4f);
    EXPECT_FALSE(scene.wetness->is_static);
    EXPECT_EQ(scene.wetness->since_s, 12.0f);
    EXPECT_EQ(scene.wetness->dry_s, 90.0f);
    EXPECT_EQ(scene.puddles->level, 0.7f);
    const Material& material = scene.materials.at(static_cast<std::size_t>(scene.surfaces.at(0).material));
    EXPECT_EQ(material.water, WaterMask::texture);
    EXPECT_TRUE(material.water_texture);
    EXPECT_EQ(material.deepest_puddle_m, 0.1f);
    // And out again.
    const Scene back = content::load_gltf(folder.write("back.glb", content::gltf_binary(scene)));
    EXPECT_EQ(back.wetness->since_s, 12.0f);
    EXPECT_EQ(back.puddles->level, 0.7f);
    EXPECT_EQ(back.materials.at(0).water, WaterMask::texture);
    EXPECT_TRUE(back.materials.at(0).water_texture);
    EXPECT_EQ(back.materials.at(0).deepest_puddle_m, 0.1f);
}

TEST(GltfExtras, WrongWaterIsNamed) {
    const TemporaryFolder folder;
    const auto refusal = [&](const json& document) { return error_of(folder.write("wet.gltf", document.dump())); };
    const auto expect_words = [](const std::string& error, const char* words) {
        EXPECT_NE(error.find(words), std::string::npos) << error;
    };
    json too_wet = with_water(json::object());
    too_wet["scenes"][0]["extras"] = {{"hf_wetness", 1.2}};
    expect_words(refusal(too_wet), "/scenes/0/extras/hf_wetness: is 1.2 but must lie from 0 to 1");
    too_wet["scenes"][0]["extras"] = {{"hf_puddles", -0.1}};
    expect_words(refusal(too_wet), "/scenes/0/extras/hf_puddles: is -0.1 but must lie from 0 to 1");
    expect_words(refusal(with_water({{"hf_water", "vertx"}})), "did you mean 'vertex'?");
    expect_words(refusal(with_water({{"hf_water", "texture"}})), "/materials/0/extras/hf_water: the mask is in a texture");
    expect_words(refusal(with_water({{"hf_water", "texture"}, {"hf_water_texture", 3}})),
                 "/materials/0/extras/hf_water_texture: there is no texture 3");
    json glass = with_water({{"hf_water", "vertex"}});
    glass["materials"][0]["alphaMode"] = "BLEND";
    expect_words(refusal(glass), "the alpha of the vertices is needed for coverage");
}

TEST(GltfExtras, TheSchemaIsThatOfTheTable) {
    std::ifstream file(std::string(HALFFRAME_SOURCE_DIR) + "/content/extras_schema.json");
    const std::string written{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(written, content::extras_schema()) << "write this text into content/extras_schema.json";
}

}  // namespace
}  // namespace halfframe::tests
