// The forms of a check's result: places in a file, text, JSON, SARIF, false colours.
#include "perf/check/check_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "perf/check/false_colour.h"
#include "tests/check/planted.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::check {
namespace {

using Json = nlohmann::json;
using namespace halfframe::tests;

/// A triangle with materials 0 (clean) and 1 (charcoal black), drawn with the second, and a normal of length 2.
Json dark_document() {
    Json document = triangle_document();
    document["materials"] = Json::parse(R"([
        {"name": "clean", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.2, 0.2, 1], "metallicFactor": 0,
                                                   "roughnessFactor": 0.5}},
        {"name": "black", "pbrMetallicRoughness": {"baseColorFactor": [0.001, 0.001, 0.001, 1], "metallicFactor": 0,
                                                   "roughnessFactor": 0.5}}])");
    Json& primitive = document["meshes"][0]["primitives"][0];
    primitive["material"] = 1;
    std::string normals;
    append(normals, std::vector<float>{0, 0, 1, 0, 0, 2, 0, 0, 1});
    primitive["attributes"]["NORMAL"] = add_accessor(document, add_view(document, normals), 5126, "VEC3", 3);
    return document;
}

Report report_of(const std::filesystem::path& file) {
    return check_scene(content::load_gltf(file), {.file = file, .thresholds = thresholds()});
}

TEST(Storage, is_what_the_engine_stores_with_its_worst_error) {
    Scene scene = content::open_scene("test_room");
    Image noise{.name = "noise", .width = 64, .height = 64, .srgb = true, .rgba = {}};
    for (std::uint32_t i = 0; i < 64 * 64 * 4; ++i)
        noise.rgba.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>((i * 2654435761u) >> 24));
    Material& material = scene.materials.at(static_cast<std::size_t>(scene.surfaces.at(0).material));
    material.base_color_texture.image = static_cast<int>(scene.images.size());
    scene.images.push_back(noise);
    const StorageFigures figures = check_scene(scene, {.thresholds = thresholds()}).storage;
    // Boxes of 6 x 4 m at most: half a step of 1/65535 along each of three axes is 0.046, 0.031 and 0.023 mm.
    EXPECT_GT(figures.positions_mm.error, 0.001);
    EXPECT_LT(figures.positions_mm.error, 0.06);
    EXPECT_FALSE(figures.positions_mm.where.empty());
    EXPECT_LT(figures.normals_degrees.error, 0.01);  // steps of 1/32767: 0.0036 degrees (engine/README.md)
    EXPECT_LT(figures.vertex_bytes_after, figures.vertex_bytes_before * 7 / 10);
    EXPECT_EQ(figures.full_positions, 0u);
    EXPECT_GT(figures.texture_bytes_before, 64u * 64u * 4u);
    EXPECT_LT(figures.texture_bytes_after, figures.texture_bytes_before / 3);
    EXPECT_EQ(figures.texture_worst_codes.where, "noise");  // blocks of two colours cannot hold noise
    EXPECT_GT(figures.texture_rms_codes.error, 20.0);

    const StorageFigures small = check_scene(scene, {.thresholds = thresholds(), .largest_texture = 16}).storage;
    EXPECT_EQ(small.smaller_images, small.color_images);
    EXPECT_LT(small.texture_bytes_after, figures.texture_bytes_after / 4);

    const Report report = check_scene(scene, {.thresholds = thresholds()});
    const std::string text = check_text(report);
    for (const char* words : {" mm ", " degrees ", " texels ", "display codes  noise", "vertices"})
        EXPECT_NE(text.find(words), std::string::npos) << words << " is not in\n" << text;
    const auto json = check_json(report);
    EXPECT_EQ(json["storage"]["vertices"]["bytes_before"], report.storage.vertex_bytes_before);
    EXPECT_EQ(json["storage"]["color_textures"]["worst_codes"]["where"], "noise");
}

TEST(Storage, says_why_positions_stay_as_they_are) {
    Scene scene = content::open_scene("test_room");
    for (Surface& surface : scene.surfaces) {  // twenty times as large: steps of 16 bits are 2 mm long
        for (int axis = 0; axis < 3; ++axis) surface.world_from_local[axis] *= 20.0f;
    }
    const Report report = check_scene(scene, {.thresholds = thresholds()});
    EXPECT_GT(report.storage.full_positions, 0u);
    const std::string text = check_text(report);
    EXPECT_NE(text.find("would err by up to"), std::string::npos) << text;
    EXPECT_NE(text.find("limit 0.5 mm"), std::string::npos) << text;
}

TEST(Places, are_json_pointers_of_the_file) {
    const TemporaryFolder folder;
    const Report report = report_of(folder.write("dark.gltf", dark_document().dump()));
    ASSERT_EQ(findings_of(report), "error albedo-dark; warning mesh-normals");
    EXPECT_EQ(report.findings[0].place, "/materials/1");
    EXPECT_EQ(report.findings[0].thing, "material 'black'");
    EXPECT_EQ(report.findings[1].place, "/meshes/0/primitives/0/attributes/NORMAL");
    EXPECT_EQ(report.meshes.at(0).place, "/meshes/0");
}

TEST(Places, of_things_that_share_a_name_are_that_of_their_list) {
    const TemporaryFolder folder;
    Json document = dark_document();
    document["materials"][0]["name"] = "black";
    EXPECT_EQ(report_of(folder.write("twins.gltf", document.dump())).findings.at(0).place, "/materials");
    document["materials"][0].erase("name");
    document["materials"][1].erase("name");
    EXPECT_EQ(report_of(folder.write("nameless.gltf", document.dump())).findings.at(0).place, "/materials/1");
}

TEST(FileNormals, of_bytes_and_shorts_are_read_too) {
    const TemporaryFolder folder;
    for (const int type : {5120, 5122}) {
        for (const bool unit : {true, false}) {
            Json document = dark_document();
            std::string bytes;
            const int one = type == 5120 ? 127 : 32767;
            for (int vertex = 0; vertex < 3; ++vertex) {
                const int z = unit || vertex != 1 ? one : one / 2;
                if (type == 5120) append(bytes, std::vector<std::int8_t>{0, 0, static_cast<std::int8_t>(z), 0});
                if (type == 5122) append(bytes, std::vector<std::int16_t>{0, 0, static_cast<std::int16_t>(z), 0});
            }
            const std::size_t view = add_view(document, bytes);
            document["bufferViews"][view]["byteStride"] = type == 5120 ? 4 : 8;
            document["extensionsUsed"] = document["extensionsRequired"] = Json::array({"KHR_mesh_quantization"});
            document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
                add_accessor(document, view, type, "VEC3", 3, true);
            const std::string found = findings_of(report_of(folder.write("n.gltf", document.dump())));
            EXPECT_EQ(found, unit ? "error albedo-dark" : "error albedo-dark; warning mesh-normals") << type;
        }
    }
}

TEST(Text, names_rule_place_figures_and_remedy) {
    const TemporaryFolder folder;
    const std::string text = check_text(report_of(folder.write("dark.gltf", dark_document().dump())));
    for (const char* part : {"error albedo-dark: /materials/1, material 'black'", "wished is 32 to 243", "Brighten",
                             "1 error, 1 warning, 0 notes"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
}

TEST(JsonReport, holds_figures_and_findings) {
    Scene scene = clean_scene();
    paint(scene, kBaseImage, {20, 20, 20, 255});
    const Json json = Json::parse(check_json(check_of(scene)).dump());
    EXPECT_EQ(json.at("errors"), 1);
    EXPECT_EQ(json.at("materials").at(0).at("share_outside").at("albedo-dark"), 1.0);
    EXPECT_NEAR(json.at("materials").at(0).at("albedo").at("p50").get<double>(), 20.0, 0.06);  // half a bin
    EXPECT_EQ(json.at("findings").at(0).at("rule"), "albedo-dark");
    EXPECT_EQ(json.at("meshes").at(0).at("triangles"), 2);
}

/// What SARIF 2.1.0 requires: log 3.13, run 3.14, toolComponent 3.19, reportingDescriptor 3.49, result 3.27,
/// location 3.28.
TEST(Sarif, has_the_members_that_the_standard_requires) {
    const TemporaryFolder folder;
    const Report report = report_of(folder.write("dark box.gltf", dark_document().dump()));
    const Json log = Json::parse(check_sarif(report, "1.2.3").dump());
    EXPECT_EQ(log.at("version"), "2.1.0");
    EXPECT_NE(log.at("$schema").get<std::string>().find("sarif-schema-2.1.0.json"), std::string::npos);
    ASSERT_EQ(log.at("runs").size(), 1u);
    const Json& run = log.at("runs").at(0);
    const Json& driver = run.at("tool").at("driver");
    EXPECT_EQ(driver.at("name"), "halfframe");
    EXPECT_EQ(driver.at("version"), "1.2.3");
    ASSERT_EQ(driver.at("rules").size(), static_cast<std::size_t>(kRuleCount));
    for (const Json& each : driver.at("rules")) {
        for (const char* words : {"shortDescription", "fullDescription", "help"}) {
            EXPECT_FALSE(each.at(words).at("text").get<std::string>().empty()) << each;
        }
    }
    ASSERT_EQ(run.at("results").size(), 2u);
    for (const Json& result : run.at("results")) {
        const auto index = result.at("ruleIndex").get<std::size_t>();
        EXPECT_EQ(driver.at("rules").at(index).at("id"), result.at("ruleId"));
        EXPECT_TRUE(result.at("level") == "error" || result.at("level") == "warning") << result;
        EXPECT_FALSE(result.at("message").at("text").get<std::string>().empty());
        const Json& location = result.at("locations").at(0);
        const std::string uri = location.at("physicalLocation").at("artifactLocation").at("uri");
        EXPECT_TRUE(uri.starts_with("file:///") && uri.ends_with("dark%20box.gltf")) << uri;
        EXPECT_TRUE(location.at("logicalLocations").at(0).at("fullyQualifiedName").get<std::string>().starts_with("/"));
    }
    EXPECT_EQ(run.at("results").at(0).at("locations").at(0).at("logicalLocations").at(0).at("fullyQualifiedName"),
              "/materials/1");
}

TEST(Sarif, of_a_clean_scene_has_no_results_but_a_list_of_them) {
    const Json log = Json::parse(check_sarif(check_of(clean_scene()), "1").dump());
    EXPECT_TRUE(log.at("runs").at(0).at("results").is_array());
    EXPECT_TRUE(log.at("runs").at(0).at("results").empty());
}

TEST(FalseColours, shine_where_a_rule_is_broken_and_are_grey_elsewhere) {
    Scene scene = clean_scene();
    for (std::size_t texel = 0; texel < 64 * 32; ++texel) {  // the upper half is too dark
        std::fill_n(scene.images[kBaseImage].rgba.begin() + static_cast<std::ptrdiff_t>(4 * texel), 3, std::uint8_t{5});
    }
    const Report report = check_of(scene);
    ASSERT_EQ(shown_rules(report), std::vector<RuleId>{RuleId::albedo_dark});
    show_broken_rules(scene, report, thresholds(), 2.0f);
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.emissive, glm::vec3(0.5f));  // the exposure is taken back
    const Image& grey = scene.images.at(static_cast<std::size_t>(material.base_color_texture.image));
    const Image& shine = scene.images.at(static_cast<std::size_t>(material.emissive_texture.image));
    const Image& metal = scene.images.at(static_cast<std::size_t>(material.metallic_roughness_texture.image));
    EXPECT_EQ(metal.rgba.at(2), 255);  // black metal where it shines: nothing else comes from there
    EXPECT_EQ(metal.rgba.at(metal.rgba.size() - 2), 0);
    EXPECT_EQ(grey.rgba.at(0), 0);
    EXPECT_GT(shine.rgba.at(2), 0);
    const std::size_t last = grey.rgba.size() - 4;
    EXPECT_EQ(grey.rgba.at(last), 255);
    EXPECT_EQ(shine.rgba.at(last) + shine.rgba.at(last + 1) + shine.rgba.at(last + 2), 0);
}

TEST(FalseColours, differ_from_each_other) {
    for (int a = 0; a < kTexelRuleCount; ++a) {
        for (int b = 0; b < a; ++b) {
            int difference = 0;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                difference +=
                    std::abs(colour_of(static_cast<RuleId>(a))[channel] - colour_of(static_cast<RuleId>(b))[channel]);
            }
            EXPECT_GE(difference, 40) << rule(static_cast<RuleId>(a)).name << " " << rule(static_cast<RuleId>(b)).name;
        }
    }
}

}  // namespace
}  // namespace halfframe::check
