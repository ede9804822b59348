// Thresholds: the talk's values, files of one's own, and how strict they are read.
#include "perf/check/thresholds.h"

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::check {
namespace {

std::string message_of(const std::string& text) {
    const tests::TemporaryFolder folder;
    try {
        (void)thresholds(folder.write("my.json", text).string());
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        return error.what();
    }
    return {};
}

TEST(Thresholds, built_in_ones_are_those_of_the_talk) {
    const Thresholds limits = thresholds();
    EXPECT_EQ(limits.albedo.lowest, 32.0);
    EXPECT_EQ(limits.albedo.highest, 243.0);
    EXPECT_EQ(limits.dielectric_specular.lowest, 43.0);
    EXPECT_EQ(limits.dielectric_specular.highest, 65.0);
    EXPECT_EQ(limits.metal_specular.lowest, 186.0);
    EXPECT_EQ(limits.metal_specular.highest, 255.0);
}

TEST(Thresholds, a_file_changes_what_it_names_and_leaves_the_rest) {
    const tests::TemporaryFolder folder;
    const Thresholds limits =
        thresholds(folder.write("my.json", R"({"albedo": [10, 240], "largest_texture_side": 512})").string());
    EXPECT_EQ(limits.albedo.lowest, 10.0);
    EXPECT_EQ(limits.albedo.highest, 240.0);
    EXPECT_EQ(limits.largest_texture_side, 512);
    EXPECT_EQ(limits.metal_specular.lowest, 186.0);
}

TEST(Thresholds, what_is_wrong_is_named_with_its_place) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({"albeto": [1, 2]})", "did you mean 'albedo'"},
        {R"({"albedo": [1, 2, 3]})", "/albedo"},
        {R"({"albedo": [1, 300]})", "/albedo/1"},
        {R"({"albedo": [200, 100]})", "lower end"},
        {R"({"warning_share": 0.9})", "error_share"},
        {R"({"error_share": 2})", "/error_share"},
        {R"({"largest_texture_side": 0})", "/largest_texture_side"},
        {R"({"dielectric_specular": [43, 190]})", "metal_specular"},
        {R"([])", "object"},
        {"{", "line 1"},
    };
    for (const auto& [text, expected] : cases) {
        const std::string message = message_of(text);
        EXPECT_NE(message.find(expected), std::string::npos) << text << "\n" << message;
        EXPECT_NE(message.find("my.json"), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace halfframe::check
