// halfframe accuracy as a child process: streams, exit codes, spelling.
#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "perf/process/child_process.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::harness {
namespace {

process::ChildResult accuracy(const std::vector<std::string>& arguments) {
    process::ChildCommand command{.arguments = {HALFFRAME_BINARY_DIR "/halfframe", "accuracy"}};
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    return process::run_child(command);
}

TEST(AccuracyCommand, JsonAloneIsOnStandardOutput) {
    const process::ChildResult result = accuracy({"tone_map", "sky", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    EXPECT_TRUE(result.errors.empty()) << result.errors;
    const auto functions = nlohmann::json::parse(result.output).at("functions");
    ASSERT_EQ(functions.size(), 3u);
    for (const auto& function : functions) {
        EXPECT_TRUE(function.at("violations").empty());
        EXPECT_EQ(function.at("tier"), "console");
        const auto& half = function.at("arithmetic_gap").at("half");
        EXPECT_GT(half.at("largest").get<double>(), 0.0);
        EXPECT_LE(half.at("largest").get<double>(), half.at("bound").get<double>());
        EXPECT_FALSE(function.at("method_gap").at("worst_input").empty());
    }
}

TEST(AccuracyCommand, TheTableHasARowForEachFunction) {
    const process::ChildResult result = accuracy({"tone_map"});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    for (const char* words : {"inverse_tone_map", "method", "ES min", "hold", "Inputs, and the worst of them"}) {
        EXPECT_NE(result.output.find(words), std::string::npos) << words << "\n" << result.output;
    }
    EXPECT_EQ(result.output.find("sky_gradient"), std::string::npos) << result.output;
    EXPECT_EQ(result.output.find("exceeded"), std::string::npos) << result.output;
}

TEST(AccuracyCommand, ModelsFollowTheFunctionsAndCanBeDrawn) {
    const harness::TemporaryFolder folder;
    const std::string maps = folder / "maps.png";
    const process::ChildResult result = accuracy({"surface", "--json", "--maps", maps});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    const auto report = nlohmann::json::parse(result.output);
    for (const auto& element : report.at("models")) {
        EXPECT_GE(element.at("highest").get<double>(), element.at("lowest").get<double>());
        EXPECT_LE(element.at("mean").get<double>(), element.at("mean_bound").get<double>());
        EXPECT_FALSE(element.at("worst_place").empty());
    }
    EXPECT_EQ(report.at("models").size(), 5u);
    EXPECT_GT(std::filesystem::file_size(maps), 1000u);
    std::filesystem::remove(maps);
    const process::ChildResult none = accuracy({"sky", "--maps", maps});
    EXPECT_EQ(none.exit_code, 2) << none.story();
    EXPECT_FALSE(std::filesystem::exists(maps));
}

TEST(AccuracyCommand, TheContextIsNamedAndItsFiguresAreThere) {
    const process::ChildResult result = accuracy({"--json"});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    const auto report = nlohmann::json::parse(result.output);
    if (report.at("context").at("driver").is_null()) GTEST_SKIP() << report.at("context").at("missing");
    for (const auto& function : report.at("functions")) {
        const auto& here = function.at("context_gap");
        EXPECT_LE(here.at("highp").at("largest").get<double>(), here.at("highp").at("bound").get<double>());
        EXPECT_EQ(here.contains("mediump"), function.at("arithmetic") == "half");
    }
    ASSERT_EQ(report.at("storage").size(), 15u);
    for (const auto& row : report.at("storage")) EXPECT_NE(row.contains("missing"), row.contains("largest"));
    ASSERT_EQ(report.at("depth").size(), 2u);
    for (const auto& row : report.at("depth")) EXPECT_EQ(row.at("surface_apart"), 0);
}

TEST(AccuracyCommand, StorageThatIsOfOneEffectIsPrintedWithIt) {
    const process::ChildResult panes = accuracy({"transparent"});
    ASSERT_EQ(panes.exit_code, 0) << panes.story();
    for (const char* words : {"blended", "order by centres", "display values blended"})
        EXPECT_NE(panes.output.find(words), std::string::npos) << words;
    const process::ChildResult depth = accuracy({"depth_prepass"});
    ASSERT_EQ(depth.exit_code, 0) << depth.story();
    EXPECT_EQ(depth.output.find("three panes"), std::string::npos) << depth.output;
    if (panes.output.starts_with("here: nothing was drawn")) GTEST_SKIP() << panes.output.substr(0, 200);
    EXPECT_NE(panes.output.find("three panes"), std::string::npos) << panes.output;
    EXPECT_NE(depth.output.find("surface apart"), std::string::npos) << depth.output;
}

TEST(AccuracyCommand, WithoutADrawableContextTheReasonIsPrinted) {
    const process::ChildResult result = accuracy({"tone_map", "--device", "es2-minimum"});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    EXPECT_NE(result.output.find("nothing was drawn: texelFetch needs ES 3.0"), std::string::npos) << result.output;
    const process::ChildResult json = accuracy({"tone_map", "--device", "es2-minimum", "--json"});
    const auto report = nlohmann::json::parse(json.output);
    EXPECT_TRUE(report.at("functions").at(0).at("context_gap").is_null());
    EXPECT_FALSE(report.at("context").at("missing").get<std::string>().empty());
}

TEST(AccuracyCommand, WholeFramesHaveATableOfTheirOwn) {
    const process::ChildResult refused = accuracy({"tone_map", "--frames"});
    EXPECT_EQ(refused.exit_code, 2) << refused.story();
    const process::ChildResult poor = accuracy({"--frames", "--device", "es2-minimum"});
    EXPECT_EQ(poor.exit_code, 2) << poor.story();
    EXPECT_NE(poor.errors.find("RGBA32F"), std::string::npos) << poor.errors;
}

TEST(AccuracyCommand, AnUnknownEffectIs2AndNamesTheNearest) {
    const process::ChildResult result = accuracy({"tonemap"});
    EXPECT_EQ(result.exit_code, 2) << result.story();
    EXPECT_TRUE(result.output.empty()) << result.output;
    EXPECT_NE(result.errors.find("did you mean 'tone_map'"), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace halfframe::harness
