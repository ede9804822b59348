// The rules of the house as functions over texts: each returns one sentence for every place that breaks it.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace halfframe::harness {

/// One text file of the repository, or of a made-up one in a test.
struct SourceFile {
    std::string path;  ///< relative to the root, with '/'
    std::string text;
};

/// Every text file below `root`, sorted by path. Left out: folders whose name starts with a dot, and build and out.
/// Text is told by the name's ending; `run`, `test` and LICENSE have none and count as text.
[[nodiscard]] std::vector<SourceFile> read_tree(const std::filesystem::path& root);
/// Every path below `root`, files and folders, text or not, with the same folders left out.
[[nodiscard]] std::set<std::string> paths_of(const std::filesystem::path& root);

using Violations = std::vector<std::string>;

/// Who may include whom (design: "the six rooms"), that quoted includes are rooted at the repository and exist, and
/// that a .cpp includes its own header first. Quoted includes of shaders are rooted at shaders_es/.
[[nodiscard]] Violations include_violations(const std::vector<SourceFile>& files);

/// Words of one dialect of GLSL ES outside shaders_es/dialect/, in shader texts; comments are not read.
[[nodiscard]] Violations dialect_violations(const std::vector<SourceFile>& files);

/// FULL and highp without their reason, in shader texts. A reason is a comment that says "FULL: why" or "highp: why",
/// on the line itself or above it in the same paragraph (lines without an empty one between them). In vertex stages,
/// files .vert and those that begin with "// Vertex stage", floats are highp anyway: only what they hand on is judged.
/// Preprocessor lines are not, nor is dialect/.
[[nodiscard]] Violations precision_violations(const std::vector<SourceFile>& files);

/// READMEs of effects that do not fit one screen: 70 lines, a line counting once for every 120 columns of it.
[[nodiscard]] Violations screen_violations(const std::vector<SourceFile>& files);

/// C++ past 600 lines and shaders past 240 whose first comment does not say "one file because".
[[nodiscard]] Violations length_violations(const std::vector<SourceFile>& files);

/// C++ files and shaders whose first line is not a comment that says what the file is.
[[nodiscard]] Violations first_line_violations(const std::vector<SourceFile>& files);

/// Tests that write into the folder that GoogleTest gives to all of them alike: they run beside each other, and those
/// of another checkout too.
[[nodiscard]] Violations shared_folder_violations(const std::vector<SourceFile>& files);

/// Reminders to oneself, paths of one machine, and talk about how the project was made.
[[nodiscard]] Violations word_violations(const std::vector<SourceFile>& files);

/// Relative links of Markdown files that lead nowhere. `paths` as from paths_of().
[[nodiscard]] Violations link_violations(const std::vector<SourceFile>& files, const std::set<std::string>& paths);

/// What an effect must have: engine/effects/NAME with NAME.h and a README.md, shaders_es/NAME, tests/effects/NAME, and
/// a row of the budget.
struct CardNames {
    std::string name;
    std::string budget_row;
    bool own_shaders = true;  ///< false: it draws with another effect's
};
[[nodiscard]] Violations card_violations(const std::vector<CardNames>& cards, const std::set<std::string>& paths,
                                         const std::set<std::string>& budget_rows);

/// The names in the first column of the table under the heading `## Commands`, in order.
[[nodiscard]] std::vector<std::string> commands_of_readme(std::string_view readme);
/// The subcommands that `halfframe --help` lists, in order.
[[nodiscard]] std::vector<std::string> commands_of_help(std::string_view help);

/// The whole list on separate lines, for the message of a failed test.
[[nodiscard]] std::string joined(const Violations& violations);

}  // namespace halfframe::harness
