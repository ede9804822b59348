// Reads signatures and the comment lines above them.
#include "perf/stability/declaration.h"

#include <algorithm>
#include <charconv>
#include <regex>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::stability {
namespace {

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    int depth = 0;
    std::string part;
    for (const char letter : text) {
        if (letter == '(' || letter == '[') ++depth;
        if (letter == ')' || letter == ']') --depth;
        if (letter == separator && depth == 0) {
            parts.push_back(trimmed(part));
            part.clear();
        } else {
            part += letter;
        }
    }
    parts.push_back(trimmed(part));
    std::erase_if(parts, [](const std::string& one) { return one.empty(); });
    return parts;
}

int components_of(const std::string& type) {
    if (type == "float") return 1;
    return type == "vec2" ? 2 : type == "vec3" ? 3 : type == "vec4" ? 4 : 0;
}

[[noreturn]] void refuse(const Declaration& function, const std::string& why) {
    throw Error(Fault::check, fmt::format("{}: {} above {}; perf/stability/README.md lists the lines that can be read",
                                          function.place(), why, function.name));
}

double number_of(const Declaration& function, std::string text) {
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size()) refuse(function, "'" + text + "' is no number");
    return value;
}

void read_range(const Declaration& function, const std::string& text, double& low, double& high) {
    const auto dots = text.find("..");
    if (dots == std::string::npos) refuse(function, "'" + text + "' is no range LOW..HIGH");
    low = number_of(function, trimmed(text.substr(0, dots)));
    high = number_of(function, trimmed(text.substr(dots + 2)));
    if (!(low <= high)) refuse(function, "the range '" + text + "' is upside down");
}

std::size_t parameter_called(const Declaration& function, const std::string& name) {
    const auto found = std::ranges::find(function.parameters, name, &DeclaredParameter::name);
    if (found == function.parameters.end()) refuse(function, "no parameter is called '" + name + "', named");
    return static_cast<std::size_t>(found - function.parameters.begin());
}

Promise promise_of(const Declaration& function, const std::string& text) {
    Promise promise{.text = text};
    if (text == "finite") {
        promise.kind = Promise::Kind::finite;
    } else if (text.starts_with("in ")) {
        promise.kind = Promise::Kind::within;
        read_range(function, trimmed(text.substr(3)), promise.low, promise.high);
    } else if (text.starts_with("error ")) {
        promise.kind = Promise::Kind::error;
        promise.high = number_of(function, trimmed(text.substr(6)));
    } else if (text.starts_with("rising ") || text.starts_with("falling ")) {
        promise.kind = text.starts_with("rising") ? Promise::Kind::rising : Promise::Kind::falling;
        promise.parameter = parameter_called(function, trimmed(text.substr(text.find(' '))));
    } else if (text.starts_with("where ")) {
        const auto colon = text.find(": ");
        if (colon == std::string::npos) refuse(function, "'" + text + "' needs a ': ' behind its condition");
        promise.condition = fmt::format("!({}) || ({})", text.substr(6, colon - 6), text.substr(colon + 2));
    } else {
        promise.condition = text;
    }
    return promise;
}

Exemption exemption_of(const Declaration& function, const std::string& text) {
    static const std::regex kForm(R"(^([a-z_, ]+): (?:at most ([0-9.]+) times|within ([^;]+)); (.+)$)");
    std::smatch found;
    if (!std::regex_match(text, found, kForm))
        refuse(function,
               "'" + text + "' is not 'MODEL, MODEL: at most N times; reason' or '...: within ERROR; reason'");
    Exemption exemption{.models = {}, .at_most = 1.0, .within = trimmed(found[3].str()), .reason = found[4]};
    if (exemption.within.empty()) exemption.at_most = number_of(function, found[2]);
    for (const std::string& wanted : split(found[1].str(), ',')) {
        const auto model = std::ranges::find_if(shader_ir::kModels,
                                                [&](shader_ir::Model one) { return shader_ir::name(one) == wanted; });
        if (model == shader_ir::kModels.end()) refuse(function, "no model is called '" + wanted + "', named");
        exemption.models.push_back(*model);
    }
    return exemption;
}

void read_line(Declaration& function, const std::string& line) {
    const auto space = line.find(' ');
    const std::string word = line.substr(0, space);
    const std::string rest = space == std::string::npos ? "" : trimmed(line.substr(space));
    if (rest.empty()) refuse(function, "nothing stands behind //@" + word);
    if (word == "variant") {
        function.variants.push_back(rest);
    } else if (word == "domain") {
        declare_domain(function, rest);
    } else if (word == "promise") {
        for (const std::string& one : split(rest, ';')) function.promises.push_back(promise_of(function, one));
    } else if (word == "jumps") {
        for (const std::string& one : split(rest, ';')) function.jumps.push_back(one);
    } else if (word == "exempt") {
        function.exemptions.push_back(exemption_of(function, rest));
    } else if (word == "not_run") {
        function.not_run = rest;
    } else {
        refuse(function, "the word //@" + word + " means nothing");
    }
}

/// "FULL vec3 n" and what it says.
DeclaredParameter parameter_of(const std::string& text) {
    DeclaredParameter parameter{.text = text};
    for (const std::string& word : split(text, ' ')) {
        if (word == "FULL" || word == "highp") parameter.full = true;
        else if (word == "out" || word == "inout") parameter.handed_in = false;
        else if (word == "HALF" || word == "mediump" || word == "lowp" || word == "in" || word == "const") continue;
        else if (parameter.type.empty()) parameter.type = word;
        else parameter.name = word;
    }
    parameter.components = components_of(parameter.type);
    return parameter;
}

/// The function whose signature begins in line `at`, if one does.
bool read_signature(const std::vector<std::string>& lines, std::size_t at, Declaration& function) {
    static const std::regex kBeginning(
        R"(^(FULL |HALF |highp |mediump |lowp )?(void|bool|int|float|[bi]?vec[234]|mat[234]) +([A-Za-z_]\w*) *\()");
    std::smatch found;
    if (!std::regex_search(lines[at], found, kBeginning)) return false;
    std::string text;
    for (std::size_t line = at; line < lines.size(); ++line) {
        text += lines[line] + ' ';
        if (text.find_first_of("{;") != std::string::npos) break;
    }
    const auto open = text.find('('), close = text.find(')');
    const auto body = text.find('{');
    if (close == std::string::npos || body == std::string::npos || text.find(';') < body) return false;
    function.line = static_cast<int>(at) + 1;
    function.name = found[3];
    function.returned_type = found[2];
    function.returned = components_of(found[2]);
    function.returns_full = found[1] == "FULL " || found[1] == "highp ";
    for (const std::string& one : split(text.substr(open + 1, close - open - 1), ','))
        function.parameters.push_back(parameter_of(one));
    return true;
}

}  // namespace

std::string Declaration::place() const { return fmt::format("{}:{}", file, line); }

std::string Declaration::mangled() const {
    std::string text = name + "(";
    for (const DeclaredParameter& parameter : parameters)
        text += parameter.components == 1 ? "f1;" : fmt::format("vf{};", parameter.components);
    return text;
}

std::string Exemption::bound() const {
    return within.empty() ? fmt::format("up to {:g} times", at_most) : "up to " + within + " off";
}

const Exemption* Declaration::exemption(shader_ir::Model model) const {
    for (const Exemption& one : exemptions) {
        if (std::ranges::find(one.models, model) != one.models.end()) return &one;
    }
    return nullptr;
}

void declare_domain(Declaration& function, std::string_view text) {
    for (const std::string& item : split(text, ';')) {
        if (item.starts_with("where ")) {
            function.where = item.substr(6);
            continue;
        }
        const auto colon = item.find(':');
        if (colon == std::string::npos) refuse(function, "'" + item + "' is not 'PARAMETER: LOW..HIGH'");
        const std::string range = trimmed(item.substr(colon + 1));
        for (const std::string& name : split(item.substr(0, colon), ',')) {
            DeclaredParameter& parameter = function.parameters[parameter_called(function, name)];
            if (range == "unit" || range == "any") {
                parameter.domain.kind = range == "unit" ? Domain::Kind::unit : Domain::Kind::any;
                if (range == "unit" && parameter.components < 2) refuse(function, "a number is no direction,");
                continue;
            }
            parameter.domain.kind = Domain::Kind::range;
            read_range(function, range, parameter.domain.low, parameter.domain.high);
        }
    }
}

std::string gap_in(const Declaration& function) {
    if (!function.not_run.empty()) return {};
    const std::string subject = fmt::format("{}: {} ", function.place(), function.name);
    if (function.returned == 0) return subject + "returns no float or vector, and no //@not_run says why";
    for (const DeclaredParameter& parameter : function.parameters) {
        if (!parameter.handed_in || parameter.components == 0)
            return subject + "has the parameter '" + parameter.text + "', which cannot be given, and no //@not_run";
        if (parameter.domain.kind == Domain::Kind::missing)
            return subject + "says nothing of its parameter '" + parameter.name + "'; write a line such as //@domain " +
                   parameter.name + ": 0..1 above it";
    }
    return function.parameters.empty() ? subject + "has no parameters, and no //@not_run says why" : std::string{};
}

std::vector<Declaration> functions_of(std::string_view path, std::string_view text) {
    std::vector<std::string> lines;
    for (std::size_t first = 0; first < text.size();) {
        const std::size_t end = std::min(text.find('\n', first), text.size());
        lines.emplace_back(text.substr(first, end - first));
        first = end + 1;
    }
    std::vector<Declaration> functions;
    for (std::size_t at = 0; at < lines.size(); ++at) {
        Declaration function{.file = std::string(path)};
        if (!read_signature(lines, at, function) || function.name == "main") continue;
        std::size_t first = at;
        while (first > 0 && lines[first - 1].starts_with("//")) --first;
        for (std::size_t line = first; line < at; ++line) {
            const std::string& comment = lines[line];
            if (comment.starts_with("//@") && !comment.starts_with("//@insert")) read_line(function, comment.substr(3));
        }
        if (function.variants.empty()) function.variants.emplace_back("TIER_CONSOLE");
        functions.push_back(function);
    }
    return functions;
}

std::vector<Declaration> all_functions(std::span<const gl::ShaderFile> files) {
    std::vector<Declaration> all;
    for (const gl::ShaderFile& file : files) {
        for (Declaration& one : functions_of(file.path, file.text)) all.push_back(std::move(one));
    }
    return all;
}

}  // namespace halfframe::stability
