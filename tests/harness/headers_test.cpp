// Every header compiles alone: whoever includes it needs to include nothing before it. So does the README's example.
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "perf/process/child_process.h"
#include "tests/harness/house_rules.h"

namespace halfframe::harness {
namespace {

/// The include folders that the build gave us. After the compiler's own: /usr/include among them must not come first.
std::vector<std::string> include_arguments(const std::filesystem::path& root) {
    std::vector<std::string> arguments = {"-I" + root.string()};
    std::istringstream folders(HALFFRAME_SYSTEM_INCLUDES);
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (!folder.empty()) arguments.insert(arguments.end(), {"-idirafter", folder});
    }
    return arguments;
}

/// The compiler's words about `file` alone, empty when there is nothing to say. Includes are rooted at `root`.
std::string words_about(const std::filesystem::path& root, const std::filesystem::path& file) {
    process::ChildCommand command{
        .arguments = {HALFFRAME_COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-x", "c++"}};
    for (const std::string& argument : include_arguments(root)) command.arguments.push_back(argument);
    command.arguments.push_back((root / file).string());
    const process::ChildResult result = process::run_child(command);
    // GCC says "#pragma once in main file" for every header compiled as a file, and has no switch for it.
    std::string words;
    std::istringstream lines(result.errors);
    for (std::string line; std::getline(lines, line);) {
        if (line.find("error:") != std::string::npos && line.find("#pragma once in main file") == std::string::npos) {
            words += line + "\n";
        }
    }
    if (words.empty() && result.signal != 0) words = result.story();
    return words;
}

/// Headers that no .cpp of their own includes first. Of the others the build itself shows that they compile alone,
/// because a .cpp includes its own header before all else (IncludeDirections checks that).
std::vector<std::string> headers_without_source() {
    const std::set<std::string> paths = paths_of(HALFFRAME_SOURCE_DIR);
    std::vector<std::string> headers;
    for (const SourceFile& file : read_tree(HALFFRAME_SOURCE_DIR)) {
        if (paths.count(file.path.substr(0, file.path.find_last_of('.')) + ".cpp") != 0) continue;
        const bool room = file.path.starts_with("engine/") || file.path.starts_with("platform/") ||
                          file.path.starts_with("content/") || file.path.starts_with("perf/") ||
                          file.path.starts_with("tests/harness/") || file.path.starts_with("tests/shaders/") ||
                          file.path.starts_with("shaders_es/");
        if (room && file.path.ends_with(".h")) headers.push_back(file.path);
    }
    return headers;
}

TEST(Headers, EachCompilesAlone) {
    const std::vector<std::string> headers = headers_without_source();
    ASSERT_GT(headers.size(), 8u);
    std::atomic<std::size_t> next = 0;
    std::mutex told;
    std::string words;
    const auto work = [&] {
        for (std::size_t index = next++; index < headers.size(); index = next++) {
            const std::string found = words_about(HALFFRAME_SOURCE_DIR, headers[index]);
            const std::lock_guard lock(told);
            words += found;
        }
    };
    std::vector<std::thread> workers;
    for (unsigned worker = 0; worker < std::clamp(std::thread::hardware_concurrency(), 1u, 8u); ++worker) {
        workers.emplace_back(work);
    }
    for (std::thread& worker : workers) worker.join();
    EXPECT_EQ(words, "");
}

/// The text of the first ```cpp block, empty when there is none.
std::string cpp_block(const std::string& markdown) {
    const std::string fence = "```cpp\n";
    const std::size_t start = markdown.find(fence);
    if (start == std::string::npos) return {};
    const std::size_t end = markdown.find("\n```", start);
    return markdown.substr(start + fence.size(), end - start - fence.size()) + "\n";
}

TEST(Readme, ItsLibraryExampleCompilesAndIsShort) {
    std::ifstream file(std::filesystem::path(HALFFRAME_SOURCE_DIR) / "README.md");
    std::stringstream text;
    text << file.rdbuf();
    const std::string example = cpp_block(text.str());
    EXPECT_EQ(example.rfind("#include", 0), 0u) << example;
    EXPECT_LE(std::count(example.begin(), example.end(), '\n'), 20);
    const std::filesystem::path source =
        std::filesystem::temp_directory_path() / ("halfframe_readme_" + std::to_string(getpid()) + ".cpp");
    std::ofstream(source) << example;
    EXPECT_EQ(words_about(HALFFRAME_SOURCE_DIR, source), "");
    std::ofstream(source) << example << "int broken = all_effects;\n";
    EXPECT_NE(words_about(HALFFRAME_SOURCE_DIR, source), "") << "the check itself sees nothing";
    std::filesystem::remove(source);
}

TEST(Headers, OneThatLeansOnAnotherIsFound) {
    const std::filesystem::path root =
        std::filesystem::temp_directory_path() / ("halfframe_headers_" + std::to_string(getpid()));
    std::filesystem::create_directories(root);
    std::ofstream(root / "leans.h") << "#pragma once\ninline std::string name() { return {}; }\n";
    std::ofstream(root / "stands.h") << "#pragma once\n#include <string>\ninline std::string name() { return {}; }\n";
    EXPECT_NE(words_about(root, "leans.h").find("leans.h:2"), std::string::npos);
    EXPECT_EQ(words_about(root, "stands.h"), "");
    std::error_code ignored;
    std::filesystem::remove_all(root, ignored);
}

}  // namespace
}  // namespace halfframe::harness
