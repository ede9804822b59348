// Writes the end of a vertex stage that hands uniforms on. Line by line: the conditions stay for the driver to decide.
#include "engine/gl/uniforms_by_vertex.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/error.h"

namespace halfframe::gl {
namespace {

constexpr std::string_view kWord = "FRAGMENT_UNIFORM ";
constexpr std::string_view kMain = "void main() {";
constexpr std::string_view kInnerMain = "void main_of_its_own() {";

/// "FRAGMENT_UNIFORM HALF vec4 terms[9];  // ..." is type "vec4", name "terms", array "[9]".
struct Declaration {
    std::string_view type;
    std::string_view name;
    std::string_view array;  ///< empty: no array
};

std::string_view next_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(word.size());
    return word;
}

std::optional<Declaration> declaration_in(std::string_view line) {
    if (!line.starts_with(kWord)) return std::nullopt;
    std::string_view rest = line.substr(kWord.size(), line.find(';') - kWord.size());
    static_cast<void>(next_word(rest));  // the precision: a vertex stage is highp, and the two may differ
    Declaration found;
    found.type = next_word(rest);
    found.name = next_word(rest);
    const std::size_t bracket = std::min(found.name.find('['), found.name.size());
    found.array = found.name.substr(bracket);
    found.name = found.name.substr(0, bracket);
    expect(!found.name.empty(),
           [&] { return "a shader line is not FRAGMENT_UNIFORM precision type name; but: " + std::string(line); });
    return found;
}

bool is_condition(std::string_view line) {
    for (const std::string_view word : {"#if", "#el", "#endif"}) {  // #ifdef and #ifndef, #else and #elif
        if (line.starts_with(word)) return true;
    }
    return false;
}

}  // namespace

void hand_on_uniforms(StageText& vertex, const StageText& fragment, Dialect dialect) {
    const char* output = dialect == Dialect::es100 ? "varying" : "flat out";
    std::string declarations;
    std::string assignments;
    bool any = false;
    std::string_view text = fragment.text;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (is_condition(line)) {
            declarations += fmt::format("{}\n", line);
            assignments += fmt::format("{}\n", line);
        } else if (const auto found = declaration_in(line)) {
            any = true;
            declarations += fmt::format("uniform highp {0} {1}{2}{3};\n{4} highp {0} {2}{3};\n", found->type, kHandedOn,
                                        found->name, found->array, output);
            assignments += fmt::format("{0} = {1}{0};\n", found->name, kHandedOn);
        }
    }
    if (!any) return;
    const std::size_t at = vertex.text.rfind(kMain);
    expect(at != std::string::npos, "a vertex stage that hands uniforms on has no line \"void main() {\"");
    vertex.text.replace(at, kMain.size(), kInnerMain);
    vertex.files.emplace_back("<uniforms handed on>");
    const std::size_t file = vertex.files.size() - 1;
    vertex.text += fmt::format("#line {} {}\n{}void main() {{\nmain_of_its_own();\n{}}}\n",
                               static_cast<int>(file) * kLinesPerFile + 1, file, declarations, assignments);
}

}  // namespace halfframe::gl
