// Plain text searches; nothing here understands more of C++ or GLSL than comments and include lines.
#include "tests/harness/house_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>

namespace halfframe::harness {
namespace {

constexpr int kCppLineLimit = 600;
constexpr int kShaderLineLimit = 240;

bool ends_with_one_of(std::string_view path, std::initializer_list<std::string_view> endings) {
    return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return path.ends_with(ending); });
}

bool is_cpp(std::string_view path) { return ends_with_one_of(path, {".h", ".cpp", ".inl"}); }
bool is_shader(std::string_view path) {
    return ends_with_one_of(path, {".glsl", ".vert", ".frag"}) ||
           (path.starts_with("shaders_es/") && path.ends_with(".h"));
}
bool is_text(std::string_view path) {
    const std::string_view leaf = path.substr(path.find_last_of('/') + 1);
    return is_cpp(path) || is_shader(path) ||
           ends_with_one_of(path, {".md", ".txt", ".json", ".cmake", ".in", ".sh", ".py", ".html", ".pc"}) ||
           leaf == "run" || leaf == "test" || leaf == "LICENSE";
}

bool is_left_out(const std::filesystem::path& folder) {
    const std::string leaf = folder.filename().string();
    return leaf.starts_with(".") || leaf == "build" || leaf == "out";
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    std::istringstream stream{std::string(text)};
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string place(const SourceFile& file, std::size_t line_index) {
    return file.path + ":" + std::to_string(line_index + 1) + ": ";
}

std::string room_of(std::string_view path) { return std::string(path.substr(0, path.find('/'))); }

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Is `word` in `line`, not as a part of a longer word?
bool has_word(std::string_view line, std::string_view word) {
    for (std::size_t at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool starts = at == 0 || !is_word_character(line[at - 1]);
        const bool ends = end == line.size() || !is_word_character(line[end]);
        if (starts && ends) return true;
    }
    return false;
}

std::string in_lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    return result;
}

/// The text with comments blanked out, lines kept.
std::string without_comments(std::string_view text) {
    std::string result;
    enum class In { code, line, block } in = In::code;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const std::string_view two = text.substr(at, 2);
        if (in == In::code && two == "//") in = In::line;
        if (in == In::code && two == "/*") in = In::block;
        if (in == In::line && text[at] == '\n') in = In::code;
        result += in == In::code || text[at] == '\n' ? text[at] : ' ';
        if (in == In::block && two == "*/") {
            result += ' ';
            ++at;
            in = In::code;
        }
    }
    return result;
}

/// The comment that a file starts with: // lines, or one block.
std::string first_comment(std::string_view text) {
    if (text.starts_with("/*")) return std::string(text.substr(0, text.find("*/")));
    std::string comment;
    for (const std::string& line : lines_of(text)) {
        if (!line.starts_with("//")) break;
        comment += line + " ";
    }
    return comment;
}

struct Include {
    std::string target;
    bool quoted = false;
    std::size_t line_index = 0;
};

std::vector<Include> includes_of(const SourceFile& file) {
    std::vector<Include> includes;
    const std::vector<std::string> lines = lines_of(file.text);
    for (std::size_t index = 0; index < lines.size(); ++index) {
        std::istringstream line(lines[index]);
        char hash = 0;
        if (!(line >> std::ws >> hash) || hash != '#') continue;
        std::string word;
        line >> word;
        std::string rest;
        if (word.starts_with("include") && word.size() > 7) {  // #include"x"
            rest = word.substr(7);
        } else if (word == "include") {
            line >> rest;
        }
        if (rest.size() < 2 || (rest[0] != '"' && rest[0] != '<')) continue;
        const std::size_t end = rest.find(rest[0] == '"' ? '"' : '>', 1);
        includes.push_back({rest.substr(1, end == std::string::npos ? end : end - 1), rest[0] == '"', index});
    }
    return includes;
}

const std::set<std::string>& rooms() {
    static const std::set<std::string> kRooms = {"platform", "shaders_es", "engine", "content", "perf", "tests"};
    return kRooms;
}

/// May a C++ file of `room` include `target`?
bool may_include(const std::string& room, const std::string& target) {
    // Sorted as in the design: what each room may name besides itself. Every room may use the limits of the shaders
    // that the engine may use, because they reach it through the engine's own headers.
    static const std::map<std::string, std::set<std::string>> kAllowed = {
        {"platform", {"platform"}},
        {"engine", {"engine"}},
        {"content", {"content", "engine"}},
        {"perf", {"perf", "content", "engine", "platform", "shaders_es"}},
        {"tests", {"tests", "perf", "content", "engine", "platform", "shaders_es"}},
    };
    const std::string to = room_of(target);
    if (room == "engine" && to == "shaders_es") return target.ends_with("_limits.h");
    const auto allowed = kAllowed.find(room);
    return allowed == kAllowed.end() || allowed->second.count(to) != 0;
}

void check_shader_includes(const SourceFile& file, const std::set<std::string>& known, Violations& violations) {
    for (const Include& include : includes_of(file)) {
        const std::string where = place(file, include.line_index);
        if (file.path.ends_with(".h")) {
            violations.push_back(where + "a header shared with C++ includes nothing, but this one includes " +
                                 include.target);
        } else if (!include.quoted || known.count("shaders_es/" + include.target) == 0) {
            violations.push_back(where + "shaders_es has no file " + include.target +
                                 " (paths are rooted at shaders_es/)");
        }
    }
}

void check_cpp_includes(const SourceFile& file, const std::set<std::string>& known, Violations& violations) {
    const std::string room = room_of(file.path);
    std::optional<std::string> own_header;
    if (file.path.ends_with(".cpp")) {
        const std::string header = file.path.substr(0, file.path.size() - 4) + ".h";
        if (known.count(header) != 0) own_header = header;
    }
    bool first = true;
    for (const Include& include : includes_of(file)) {
        const std::string where = place(file, include.line_index);
        if (first && own_header && include.target != *own_header) {
            violations.push_back(where + "its own header " + *own_header + " comes first");
        }
        first = false;
        const bool ours = rooms().count(room_of(include.target)) != 0 && include.target.find('/') != std::string::npos;
        if (!ours) {
            // Another project's header may be quoted by nobody: quotes say "rooted at the repository".
            if (include.quoted)
                violations.push_back(where + "\"" + include.target + "\" is not rooted at the repository");
            continue;
        }
        if (known.count(include.target) == 0) violations.push_back(where + include.target + " does not exist");
        if (!may_include(room, include.target))
            violations.push_back(where + room + "/ may not include " + include.target);
    }
}

std::string normalised(const std::filesystem::path& path) {
    std::string text = path.lexically_normal().generic_string();
    while (text.ends_with('/')) text.pop_back();
    return text;
}

std::string trimmed(std::string_view text) {
    const std::size_t start = text.find_first_not_of(" \t`");
    if (start == std::string_view::npos) return {};
    return std::string(text.substr(start, text.find_last_not_of(" \t`") - start + 1));
}

}  // namespace

std::vector<SourceFile> read_tree(const std::filesystem::path& root) {
    std::vector<SourceFile> files;
    for (const std::string& path : paths_of(root)) {
        if (!is_text(path) || !std::filesystem::is_regular_file(root / path)) continue;
        std::ifstream stream(root / path, std::ios::binary);
        files.push_back({path, std::string(std::istreambuf_iterator<char>(stream), {})});
    }
    return files;
}

std::set<std::string> paths_of(const std::filesystem::path& root) {
    std::set<std::string> paths;
    auto entry = std::filesystem::recursive_directory_iterator(root);
    for (; entry != std::filesystem::recursive_directory_iterator(); ++entry) {
        if (entry->is_directory() && is_left_out(entry->path())) {
            entry.disable_recursion_pending();
            continue;
        }
        paths.insert(entry->path().lexically_relative(root).generic_string());
    }
    return paths;
}

Violations include_violations(const std::vector<SourceFile>& files) {
    std::set<std::string> known;
    for (const SourceFile& file : files) known.insert(file.path);
    Violations violations;
    for (const SourceFile& file : files) {
        if (is_shader(file.path)) {
            check_shader_includes(file, known, violations);
        } else if (is_cpp(file.path) && rooms().count(room_of(file.path)) != 0) {
            check_cpp_includes(file, known, violations);
        }
    }
    return violations;
}

Violations dialect_violations(const std::vector<SourceFile>& files) {
    static constexpr std::array<std::string_view, 12> kWords = {
        "attribute",      "varying",      "texture2D",   "texture2DLod",    "texture2DProj", "textureCube",
        "textureCubeLod", "gl_FragColor", "gl_FragData", "texture2DLodEXT", "textureLod",    "texture"};
    Violations violations;
    for (const SourceFile& file : files) {
        if (!is_shader(file.path) || !file.path.starts_with("shaders_es/") ||
            file.path.starts_with("shaders_es/dialect/"))
            continue;
        const std::vector<std::string> lines = lines_of(without_comments(file.text));
        for (std::size_t index = 0; index < lines.size(); ++index) {
            for (const std::string_view word : kWords) {
                if (has_word(lines[index], word)) {
                    violations.push_back(place(file, index) + std::string(word) + " belongs in shaders_es/dialect/");
                }
            }
            if (lines[index].find("#version") != std::string::npos) {
                violations.push_back(place(file, index) + "#version is written by the assembly of the shader");
            }
        }
    }
    return violations;
}

Violations precision_violations(const std::vector<SourceFile>& files) {
    Violations violations;
    for (const SourceFile& file : files) {
        if (!is_shader(file.path) || !file.path.starts_with("shaders_es/") ||
            file.path.starts_with("shaders_es/dialect/"))
            continue;
        const bool vertex = file.path.ends_with(".vert") || file.text.starts_with("// Vertex stage");
        const std::vector<std::string> lines = lines_of(file.text), code = lines_of(without_comments(file.text));
        bool reason = false;  // in this paragraph, down to this line
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (lines[i].find_first_not_of(' ') == std::string::npos) reason = false;
            const std::string comment = lines[i].substr(code[i].find_last_not_of(' ') + 1);
            reason =
                reason || comment.find("FULL: ") != std::string::npos || comment.find("highp: ") != std::string::npos;
            const bool says = has_word(code[i], "FULL") || has_word(code[i], "highp");
            if (!says || reason || code[i].find('#') != std::string::npos) continue;
            if (vertex && !has_word(code[i], "VERTEX_OUT")) continue;
            violations.push_back(place(file, i) +
                                 "FULL or highp without its reason: a comment \"FULL: ...\" on the line "
                                 "or above it in its paragraph");
        }
    }
    return violations;
}

Violations screen_violations(const std::vector<SourceFile>& files) {
    constexpr std::size_t kRows = 70, kColumns = 120;
    Violations violations;
    for (const SourceFile& file : files) {
        if (!file.path.starts_with("engine/effects/") || !file.path.ends_with("/README.md")) continue;
        std::size_t rows = 0;
        for (const std::string& line : lines_of(file.text))
            rows += std::max<std::size_t>((line.size() + kColumns - 1) / kColumns, 1);
        if (rows > kRows)
            violations.push_back(file.path + ": " + std::to_string(rows) +
                                 " rows of 120 columns, over one screen of 70");
    }
    return violations;
}

Violations length_violations(const std::vector<SourceFile>& files) {
    Violations violations;
    for (const SourceFile& file : files) {
        const int limit = is_shader(file.path) ? kShaderLineLimit : is_cpp(file.path) ? kCppLineLimit : 0;
        const auto lines = static_cast<int>(std::count(file.text.begin(), file.text.end(), '\n'));
        if (limit == 0 || lines <= limit) continue;
        if (first_comment(file.text).find("one file because") != std::string::npos) continue;
        violations.push_back(file.path + ": " + std::to_string(lines) + " lines, over " + std::to_string(limit) +
                             ", and its first comment does not say \"one file because\"");
    }
    return violations;
}

Violations first_line_violations(const std::vector<SourceFile>& files) {
    Violations violations;
    for (const SourceFile& file : files) {
        if (!is_cpp(file.path) && !is_shader(file.path)) continue;
        const std::string comment = first_comment(file.text);
        if (std::count_if(comment.begin(), comment.end(), is_word_character) < 8) {
            violations.push_back(file.path + ":1: the first line is a comment that says what this file is");
        }
    }
    return violations;
}

Violations shared_folder_violations(const std::vector<SourceFile>& files) {
    Violations violations;
    for (const SourceFile& file : files) {
        if (!is_cpp(file.path)) continue;
        std::istringstream lines(file.text);
        int number = 1;
        for (std::string line; std::getline(lines, line); ++number) {
            // Cut in two, so that this line does not find itself.
            if (line.find("testing::Temp"
                          "Dir") == std::string::npos)
                continue;
            violations.push_back(file.path + ":" + std::to_string(number) +
                                 ": every test writes there; take a harness::TemporaryFolder");
        }
    }
    return violations;
}

Violations word_violations(const std::vector<SourceFile>& files) {
    // Cut in two, so that this list does not find itself.
    static const std::array<std::string, 3> kReminders = {
        "TO"
        "DO",
        "FIX"
        "ME",
        "X"
        "XX"};
    static const std::array<std::string, 4> kMachinePaths = {
        "/wo"
        "rk/",
        "/ro"
        "ot/",
        "/tmp/bui"
        "ld_",
        "/home"
        "/"};
    static const std::array<std::string, 6> kTalk = {
        "age"
        "nt",
        "age"
        "nts",
        "sess"
        "ion",
        "sess"
        "ions",
        "chat"
        "gpt",
        "as an "
        "AI"};
    Violations violations;
    for (const SourceFile& file : files) {
        const std::vector<std::string> lines = lines_of(file.text);
        for (std::size_t index = 0; index < lines.size(); ++index) {
            const auto complain = [&](const std::string& what) {
                violations.push_back(place(file, index) + "\"" + what + "\" does not belong in the project's text");
            };
            for (const std::string& word : kReminders) {
                if (has_word(lines[index], word)) complain(word);
            }
            for (const std::string& path : kMachinePaths) {
                if (lines[index].find(path) != std::string::npos) complain(path);
            }
            for (const std::string& word : kTalk) {
                if (has_word(in_lower_case(lines[index]), in_lower_case(word))) complain(word);
            }
        }
    }
    return violations;
}

Violations link_violations(const std::vector<SourceFile>& files, const std::set<std::string>& paths) {
    Violations violations;
    for (const SourceFile& file : files) {
        if (!file.path.ends_with(".md")) continue;
        const std::vector<std::string> lines = lines_of(file.text);
        for (std::size_t index = 0; index < lines.size(); ++index) {
            const std::string& line = lines[index];
            for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 1)) {
                const std::size_t end = line.find_first_of(" )", at + 2);
                std::string target = line.substr(at + 2, end == std::string::npos ? end : end - at - 2);
                target = target.substr(0, target.find('#'));
                if (target.empty() || target.find("://") != std::string::npos || target.starts_with("mailto:"))
                    continue;
                const std::string full = normalised(std::filesystem::path(file.path).parent_path() / target);
                if (paths.count(full) == 0)
                    violations.push_back(place(file, index) + "the link leads nowhere: " + target);
            }
        }
    }
    return violations;
}

Violations card_violations(const std::vector<CardNames>& cards, const std::set<std::string>& paths,
                           const std::set<std::string>& budget_rows) {
    Violations violations;
    for (const CardNames& card : cards) {
        const std::string code = "engine/effects/" + card.name;
        for (const std::string& part : {code, code + "/" + card.name + ".h", code + "/README.md",
                                        "shaders_es/" + card.name, "tests/effects/" + card.name}) {
            if (part.starts_with("shaders_es/") && !card.own_shaders) continue;
            if (paths.count(part) == 0) violations.push_back(card.name + ": " + part + " is missing");
        }
        if (budget_rows.count(card.budget_row) == 0) {
            violations.push_back(card.name + ": the budget has no row \"" + card.budget_row + "\"");
        }
    }
    return violations;
}

std::vector<std::string> commands_of_readme(std::string_view readme) {
    std::vector<std::string> commands;
    bool inside = false;
    int row = 0;
    for (const std::string& line : lines_of(readme)) {
        if (line.starts_with("## ")) inside = line == "## Commands";
        if (!inside || !line.starts_with("|")) continue;
        if (++row <= 2) continue;  // the heading and its rule
        std::string name = trimmed(std::string_view(line).substr(1, line.find('|', 1) - 1));
        if (name.starts_with("halfframe ")) name = name.substr(10);
        commands.push_back(name.substr(0, name.find(' ')));
    }
    return commands;
}

std::vector<std::string> commands_of_help(std::string_view help) {
    std::vector<std::string> commands;
    bool inside = false;
    for (const std::string& line : lines_of(help)) {
        if (in_lower_case(line).starts_with("subcommands")) {
            inside = true;
        } else if (inside && line.size() > 2 && line.starts_with("  ") && line[2] != ' ') {
            commands.push_back(line.substr(2, line.find(' ', 2) - 2));
        } else if (inside && !line.empty() && line[0] != ' ') {
            inside = false;
        }
    }
    return commands;
}

std::string joined(const Violations& violations) {
    std::string text;
    for (const std::string& violation : violations) text += violation + "\n";
    return text;
}

}  // namespace halfframe::harness
