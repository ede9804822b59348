// halfframe accuracy as a child process: streams, exit codes, spelling.
#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "tests/harness/child_process.h"

namespace halfframe::harness {
namespace {

ChildResult accuracy(const std::vector<std::string>& arguments) {
    ChildCommand command{.arguments = {HALFFRAME_BINARY_DIR "/halfframe", "accuracy"}};
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    return run_child(command);
}

TEST(AccuracyCommand, JsonAloneIsOnStandardOutput) {
    const ChildResult result = accuracy({"tone_map", "sky", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    EXPECT_TRUE(result.errors.empty()) << result.errors;
    const auto functions = nlohmann::json::parse(result.output);
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
    const ChildResult result = accuracy({"tone_map"});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    for (const char* words : {"inverse_tone_map", "method", "ES min", "hold", "Inputs, and the worst of them"}) {
        EXPECT_NE(result.output.find(words), std::string::npos) << words << "\n" << result.output;
    }
    EXPECT_EQ(result.output.find("sky_gradient"), std::string::npos) << result.output;
    EXPECT_EQ(result.output.find("exceeded"), std::string::npos) << result.output;
}

TEST(AccuracyCommand, ModelsFollowTheFunctionsAndCanBeDrawn) {
    const std::string maps = testing::TempDir() + "halfframe_accuracy_maps.png";
    std::filesystem::remove(maps);
    const ChildResult result = accuracy({"surface", "--json", "--maps", maps});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    std::size_t models = 0;
    for (const auto& element : nlohmann::json::parse(result.output)) {
        EXPECT_NE(element.contains("function"), element.contains("model"));
        if (!element.contains("model")) continue;
        EXPECT_GE(element.at("highest").get<double>(), element.at("lowest").get<double>());
        EXPECT_LE(element.at("mean").get<double>(), element.at("mean_bound").get<double>());
        EXPECT_FALSE(element.at("worst_place").empty());
        ++models;
    }
    EXPECT_EQ(models, 5u);
    EXPECT_GT(std::filesystem::file_size(maps), 1000u);
    std::filesystem::remove(maps);
    const ChildResult none = accuracy({"sky", "--maps", maps});
    EXPECT_EQ(none.exit_code, 2) << none.story();
    EXPECT_FALSE(std::filesystem::exists(maps));
}

TEST(AccuracyCommand, AnUnknownEffectIs2AndNamesTheNearest) {
    const ChildResult result = accuracy({"tonemap"});
    EXPECT_EQ(result.exit_code, 2) << result.story();
    EXPECT_TRUE(result.output.empty()) << result.output;
    EXPECT_NE(result.errors.find("did you mean 'tone_map'"), std::string::npos) << result.errors;
}

TEST(AccuracyCommand, AnEffectWithoutFunctionsIs2AndNamesThoseThatHaveSome) {
    const ChildResult result = accuracy({"depth_prepass"});
    EXPECT_EQ(result.exit_code, 2) << result.story();
    EXPECT_NE(result.errors.find("these have: "), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace halfframe::harness
