// halfframe check as its users see it: exit codes, files, the false-colour picture.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "perf/check/false_colour.h"
#include "perf/report/picture_file.h"
#include "tests/content/temporary_gltf.h"
#include "tests/perf/child_process.h"

namespace halfframe::check {
namespace {

const std::string kCommand = HALFFRAME_BINARY_DIR "/halfframe";
using tests::TemporaryFolder;

test::ChildResult check(const std::vector<std::string>& more) {
    std::vector<std::string> words{"check"};
    words.insert(words.end(), more.begin(), more.end());
    return test::run_child(kCommand, words);
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A triangle that faces +Z, of one grey.
std::string triangle_of(double albedo, const std::string& wrong_normal = "") {
    nlohmann::json document = tests::triangle_document();
    document["materials"] = nlohmann::json::array(
        {{{"name", "paint"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {albedo, albedo, albedo, 1.0}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}}}});
    nlohmann::json& primitive = document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    if (!wrong_normal.empty()) {
        std::string normals;
        tests::append(normals, std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 2});
        primitive["attributes"]["NORMAL"] =
            tests::add_accessor(document, tests::add_view(document, normals), 5126, "VEC3", 3);
    }
    return document.dump();
}

TEST(CheckCommand, errors_are_1_warnings_0_and_strict_warnings_1) {
    const TemporaryFolder folder;
    const std::string clean = folder.write("clean.gltf", triangle_of(0.2));
    const std::string dark = folder.write("dark.gltf", triangle_of(0.0005));
    const std::string warned = folder.write("warned.gltf", triangle_of(0.2, "long"));
    EXPECT_EQ(check({clean}).code, 0);
    EXPECT_EQ(check({clean, "--strict"}).code, 0);
    EXPECT_EQ(check({dark}).code, 1);
    const test::ChildResult warning = check({warned});
    EXPECT_EQ(warning.code, 0) << warning.out;
    EXPECT_TRUE(contains(warning.out, "warning mesh-normals")) << warning.out;
    EXPECT_EQ(check({warned, "--strict"}).code, 1);
}

TEST(CheckCommand, thresholds_decide_and_their_mistakes_are_3) {
    const TemporaryFolder folder;
    const std::string dark = folder.write("dark.gltf", triangle_of(0.0005));
    EXPECT_EQ(check({dark, "--thresholds", folder.write("loose.json", R"({"albedo": [0, 255]})").string()}).code, 0);
    const test::ChildResult wrong =
        check({dark, "--thresholds", folder.write("wrong.json", R"({"albdo": 1})").string()});
    EXPECT_EQ(wrong.code, 3);
    EXPECT_TRUE(contains(wrong.err, "did you mean 'albedo'")) << wrong.err;
}

TEST(CheckCommand, json_and_sarif_are_whole) {
    const TemporaryFolder folder;
    const std::string dark = folder.write("dark.gltf", triangle_of(0.0005));
    const std::string sarif = (folder.path() / "dark.sarif").string();
    const test::ChildResult result = check({dark, "--json", "--sarif", sarif});
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out).at("errors"), 1);
    const auto log = nlohmann::json::parse(test::file_text(sarif));
    EXPECT_EQ(log.at("runs").at(0).at("results").at(0).at("ruleId"), "albedo-dark");
}

TEST(CheckCommand, says_what_is_wrong_with_its_words) {
    const TemporaryFolder folder;
    const std::string same = (folder.path() / "same.png").string();
    const std::vector<std::tuple<std::vector<std::string>, int, std::string>> cases{
        {{"no_such_scene"}, 3, "no_such_scene"},
        {{"furnace", "--picture", "x.jpg"}, 2, ".png"},
        {{"furnace", "--picture", same, "--sarif", same}, 2, "named twice"},
        {{"furnace", "--thresholds", "none.json"}, 3, "none.json"},
        {{"furnace", "--device", "es2-minimun"}, 3, "did you mean"},
    };
    for (const auto& [words, code, expected] : cases) {
        const test::ChildResult result = check(words);
        EXPECT_EQ(result.code, code) << expected << "\n" << result.err;
        EXPECT_TRUE(contains(result.err, expected)) << expected << "\n" << result.err;
    }
}

TEST(CheckCommand, the_picture_shows_the_broken_rule_in_its_colour) {
    const test::ChildResult info = test::run_child(kCommand, {"info", "--json"});
    if (info.code == 4) GTEST_SKIP() << "no graphics context here: " << info.err;
    const TemporaryFolder folder;
    const std::string picture = (folder.path() / "false.png").string();
    for (const std::string tier : {"low", "console"}) {
        for (const double albedo : {0.0005, 0.2}) {
            const std::string file = folder.write("triangle.gltf", triangle_of(albedo));
            const test::ChildResult result =
                check({file, "--picture", picture, "--size", "320x240", "--tier", tier, "--cache", "none"});
            if (contains(result.err, "no font")) GTEST_SKIP() << result.err;
            ASSERT_EQ(result.code, albedo < 0.01 ? 1 : 0) << result.err;
            const Picture drawn = perf::read_png(picture);
            const perf::Rgb wished = colour_of(RuleId::albedo_dark);
            std::size_t found = 0;
            for (int y = 60; y < drawn.height; ++y) {  // below the legend
                for (int x = 0; x < drawn.width; ++x) {
                    const std::size_t at = 4 * static_cast<std::size_t>(y * drawn.width + x);
                    int worst = 0;
                    for (std::size_t channel = 0; channel < 3; ++channel) {
                        worst = std::max(worst, std::abs(drawn.rgba[at + channel] - wished[channel]));
                    }
                    // 2 codes: the emission is stored in 8 bits of sRGB; low, console and reference err by 1.
                    found += worst <= 2 ? 1u : 0u;
                }
            }
            const auto pixels = static_cast<std::size_t>(drawn.width) * static_cast<std::size_t>(drawn.height);
            if (albedo < 0.01) {
                EXPECT_GT(found, pixels / 20) << tier;  // the triangle fills about a fifth of the picture
            } else {
                EXPECT_EQ(found, 0u) << tier;
            }
        }
    }
}

}  // namespace
}  // namespace halfframe::check
