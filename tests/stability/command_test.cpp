// halfframe stability as a child process: a stranger's function, the page, exit codes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "perf/process/child_process.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::harness {
namespace {

process::ChildResult stability(const std::vector<std::string>& arguments) {
    process::ChildCommand command{.arguments = {HALFFRAME_BINARY_DIR "/halfframe", "stability"}};
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    return process::run_child(command);
}

/// Sentences are wrapped for a terminal.
std::string in_one_line(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
    return line;
}

/// A file in a folder of this process's own: tests run beside each other.
std::string temporary(const std::string& name, const std::string& text) {
    static const TemporaryFolder folder;
    return folder.write(name, text).string();
}

std::string own_file() {
    return temporary("own.glsl",
                     "// Mine.\n#include \"common/maths.glsl\"\nfloat mine(float x) { return x * x * 0.001; }\n");
}

TEST(StabilityCommand, AStrangersFunctionIsTried) {
    const process::ChildResult broken = stability({own_file(), "--function", "mine", "--domain", "x: 0..1000"});
    EXPECT_EQ(broken.exit_code, 1) << broken.story();
    EXPECT_NE(in_one_line(broken.output).find("mine, half: "), std::string::npos) << broken.output;
    EXPECT_NE(in_one_line(broken.output).find("try x = 256"), std::string::npos) << broken.output;
    const process::ChildResult sound = stability({own_file(), "--function", "mine", "--domain", "x: 1..100"});
    EXPECT_EQ(sound.exit_code, 0) << sound.story();
    const process::ChildResult silent = stability({own_file()});
    EXPECT_EQ(silent.exit_code, 1) << silent.story();
    EXPECT_NE(in_one_line(silent.output).find("write a line such as //@domain x: 0..1"), std::string::npos)
        << silent.output;
}

TEST(StabilityCommand, JsonAndPageHoldTheSameFunction) {
    const TemporaryFolder folder;
    const std::string page = folder / "stability.html";
    const process::ChildResult result = stability({"tone_map", "--json", "--html", page});
    ASSERT_EQ(result.exit_code, 0) << result.story();
    const auto report = nlohmann::json::parse(result.output);
    ASSERT_EQ(report.at("functions").size(), 2u);
    EXPECT_EQ(report.at("not_finite"), 0);
    EXPECT_GT(report.at("inputs").get<int>(), 100000);
    for (const auto& row : report.at("functions").at(0).at("arithmetics")) EXPECT_TRUE(row.at("holds")) << row;
    std::string text;
    std::getline(std::ifstream(page), text, '\0');
    for (const char* words :
         {"<html lang=\"en\">", "inverse_tone_map", "<svg", "halfframe stability tone_map", "</html>"})
        EXPECT_NE(text.find(words), std::string::npos) << words;
    EXPECT_EQ(text.find("http"), std::string::npos) << "a page that stands alone names no other";
}

TEST(StabilityCommand, WhatContradictsItselfIsUsage) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"tonemap"},
                                                      {"tone_map", "--domain", "x: 0..1"},
                                                      {"tone_map", "--ledger", "l.json"},
                                                      {own_file(), "--function", "yours"},
                                                      {"--arguments", "--full"}}) {
        const process::ChildResult result = stability(arguments);
        EXPECT_EQ(result.exit_code, 2) << result.story();
        EXPECT_TRUE(result.output.empty()) << result.output;
    }
    EXPECT_EQ(stability({own_file(), "--function", "mine", "--domain", "x 0..1"}).exit_code, 2);
    const TemporaryFolder folder;
    EXPECT_EQ(stability({"tone_map", "--pictures", folder.path().string()}).exit_code, 2);
    EXPECT_EQ(stability({"/nowhere/f.glsl"}).exit_code, 3);
    const std::string broken = temporary("broken.glsl", "//@domain x: 0..1\nfloat f(float x) { return x +; }\n");
    EXPECT_EQ(stability({broken}).exit_code, 3);
}

TEST(StabilityCommand, OddDomainsAndFunctionsAreRefusedInWords) {
    const std::string file = temporary("odd.glsl",
                                       "precision mediump float;\nfloat plain(float x) { return x; }\n"
                                       "float gone(float x) { if (x > 2.0) discard; return x; }\n"
                                       "float calls(float x) { return gone(x) * 2.0; }\n"
                                       "float forever(float x) { while (true) { x *= 1.5; } return x; }\n");
    struct Odd {
        const char* function;
        const char* domain;
        int code;
        const char* says;
    };
    for (const Odd& odd :
         {Odd{"plain", "x: 1..0", 2, "upside down"}, Odd{"plain", "x: nan..1", 2, "no number"},
          Odd{"plain", "x: 0..nan", 2, "no number"}, Odd{"plain", "x: 0..inf", 2, "has no end"},
          Odd{"plain", "x: 1e30..1e31", 2, "no half lies in the domain of plain"},
          Odd{"plain", "x: 0..1; where x > 5.0", 2, "not one input of plain"},
          Odd{"plain", "x: 0..1; x: 0..2", 2, "'x' is given two domains"},
          Odd{"plain", "y: 0..1", 2, "no parameter is called 'y'"},
          Odd{"plain", "x: 0..1; where nonsense(x)", 3, "nonsense"}, Odd{"gone", "x: 0..3", 3, "gone discards"},
          Odd{"calls", "x: 0..3", 3, "calls discards"}, Odd{"forever", "x: 0..1", 1, "a loop that does not end"}}) {
        const process::ChildResult result = stability({file, "--function", odd.function, "--domain", odd.domain});
        EXPECT_EQ(result.exit_code, odd.code) << odd.domain << result.story();
        EXPECT_NE(in_one_line(result.errors).find(odd.says), std::string::npos) << odd.domain << result.story();
        EXPECT_EQ(result.errors.find("internal error"), std::string::npos) << result.story();
    }
}

}  // namespace
}  // namespace halfframe::harness
