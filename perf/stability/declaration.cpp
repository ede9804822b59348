// Reads signatures and the comment lines above them.
#include "perf/stability/declaration.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>
#include <set>

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

/// The numbers or vectors that a value of the type is made of, before any array; no pieces: nothing can be given for
/// it.
struct Shape {
    int pieces = 0, piece = 0;
    bool whole = false;
};

Shape shape_of(const std::string& type) {
    static const std::regex kVector(R"(^([biu]?)vec([234])$)"), kMatrix(R"(^mat([234])(?:x([234]))?$)");
    static const std::regex kSampler(R"(^sampler(2D|3D|Cube|2DArray)$)");
    std::smatch found;
    if (type == "float") return {1, 1, false};
    if (type == "int" || type == "uint" || type == "bool") return {1, 1, true};
    if (std::regex_match(type, found, kVector)) return {1, std::stoi(found[2]), found[1].length() > 0};
    if (std::regex_match(type, found, kMatrix))
        return {std::stoi(found[1]), std::stoi(found[2].matched ? found[2] : found[1]), false};
    // A texture is two texels side by side; one that compares gives one number for each.
    if (std::regex_match(type, kSampler)) return {2, 4, false};
    return type == "sampler2DShadow" ? Shape{1, 2, false} : Shape{};
}

[[noreturn]] void refuse(const Declaration& function, const std::string& why) {
    throw Error(Fault::check, fmt::format("{}: {}, of {}; perf/stability/README.md lists the lines that can be read",
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
    if (std::isinf(low) || std::isinf(high))
        refuse(function, "the range '" + text + "' has no end; write 'any' for everything there is, NaN and inf too");
    if (std::isnan(low) || std::isnan(high)) refuse(function, "the range '" + text + "' has an end that is no number");
    if (!(low <= high)) refuse(function, "the range '" + text + "' is upside down");
}

std::size_t parameter_called(const Declaration& function, const std::string& name) {
    const auto found = std::ranges::find(function.parameters, name, &DeclaredParameter::name);
    if (found == function.parameters.end()) {
        std::string names;
        for (const DeclaredParameter& one : function.parameters) names += (names.empty() ? "" : ", ") + one.name;
        refuse(function, "no parameter is called '" + name + "' (there " +
                             (names.empty() ? "is none" : "is: " + names) +
                             "; what is read from outside goes with its type, as in 'vec4 " + name + ": 0..1'), named");
    }
    return static_cast<std::size_t>(found - function.parameters.begin());
}

/// "FULL vec3 n" and what it says.
DeclaredParameter parameter_of(const std::string& text) {
    DeclaredParameter parameter{.text = text};
    int elements = 1;
    for (std::string word : split(text, ' ')) {
        if (const auto open = word.find('['); open != std::string::npos) {
            const std::string size = trimmed(word.substr(open + 1, word.find(']') - open - 1));
            const bool number = !size.empty() && size.size() < 4 && size.find_first_not_of("0123456789") == size.npos;
            elements *= number ? std::stoi(size) : 0;
            parameter.elements = elements;
            word = word.substr(0, open);
            if (word.empty()) continue;
        }
        if (word == "FULL" || word == "highp") parameter.full = true;
        else if (word == "HALF" || word == "mediump" || word == "lowp") parameter.half = true;
        else if (word == "out" || word == "inout") parameter.handed_back = true, parameter.handed_in = word == "inout";
        else if (word == "in" || word == "const" || word == "uniform") continue;
        else if (parameter.type.empty()) parameter.type = word;
        else parameter.name = word;
    }
    const Shape shape = shape_of(parameter.type);
    parameter.whole = shape.whole;
    parameter.full = parameter.full || shape.whole;
    parameter.piece = elements > 0 ? shape.piece : 0;
    parameter.components = shape.pieces * shape.piece * elements;
    if (parameter.type.find("bool") == 0 || parameter.type.find("bvec") == 0)
        parameter.domain = {.kind = Domain::Kind::range, .low = 0.0, .high = 1.0};
    return parameter;
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
    } else if (word == "stage") {
        if (rest != "vertex" && rest != "fragment") refuse(function, "no stage is called '" + rest + "', named");
        function.vertex = rest == "vertex";
    } else if (word == "writes") {
        for (const std::string& one : split(rest, ';')) {
            function.written.push_back(parameter_of(one));
            if (function.written.back().components == 0 || function.written.back().name.empty())
                refuse(function, "'" + one + "' is not 'TYPE NAME'");
        }
    } else {
        refuse(function, "the word //@" + word + " means nothing");
    }
}

/// Lines without comments, so that what is commented out is no function; and how deep in braces each begins.
struct Code {
    std::vector<std::string> lines;
    std::vector<int> depth;
};

Code code_of(const std::vector<std::string>& lines) {
    Code code;
    bool in_comment = false;
    int depth = 0;
    for (const std::string& line : lines) {
        std::string kept;
        for (std::size_t at = 0; at < line.size(); ++at) {
            if (in_comment) {
                if (line.compare(at, 2, "*/") == 0) in_comment = false, ++at;
            } else if (line.compare(at, 2, "/*") == 0) {
                in_comment = true, ++at;
            } else if (line.compare(at, 2, "//") == 0) {
                break;
            } else {
                kept += line[at] == '\t' || line[at] == '\r' ? ' ' : line[at];
            }
        }
        code.depth.push_back(depth);
        const bool directive = trimmed(kept).starts_with("#");  // the branches of an #if may open a brace twice
        for (const char letter : kept) depth += directive ? 0 : letter == '{' ? 1 : letter == '}' ? -1 : 0;
        code.lines.push_back(std::move(kept));
    }
    return code;
}

/// The function whose signature begins in line `at`, if one does.
bool read_signature(const Code& code, std::size_t at, Declaration& function) {
    static const std::regex kBeginning(
        R"(^ *((?:FULL|HALF|highp|mediump|lowp) +)?([A-Za-z_]\w*)(?: *\[[0-9]*\])? +([A-Za-z_]\w*) *\()");
    static const std::regex kStatement(R"(^(return|else|if|for|while|do|switch|case|layout|struct|precision|define)$)");
    std::smatch found;
    if (code.depth[at] != 0 || !std::regex_search(code.lines[at], found, kBeginning)) return false;
    if (std::regex_match(found[2].str(), kStatement)) return false;
    std::string text;
    for (std::size_t line = at; line < code.lines.size(); ++line) {
        text += code.lines[line] + ' ';
        if (code.lines[line].find_first_of("{;") != std::string::npos) break;
    }
    const auto open = text.find('('), close = text.find(')');
    const auto body = text.find('{');
    if (close == std::string::npos || body == std::string::npos || text.find(';') < body) return false;
    function.line = static_cast<int>(at) + 1;
    function.name = found[3];
    function.returned_type = found[2];
    function.returns_full = trimmed(found[1].str()) == "FULL" || trimmed(found[1].str()) == "highp";
    if (code.lines[at].substr(0, code.lines[at].find('(')).find('[') != std::string::npos)
        function.returned_type += "[]";  // no one type
    for (const std::string& one : split(text.substr(open + 1, close - open - 1), ',')) {
        if (one != "void") function.signature.push_back(parameter_of(one));
    }
    for (const DeclaredParameter& one : function.signature) {
        if (one.handed_in) function.parameters.push_back(one);
    }
    return true;
}

/// What only the whole declaration says: the stage's precision, and how much comes back.
void complete(Declaration& function) {
    const auto settle = [&](DeclaredParameter& one) { one.full = one.full || (function.vertex && !one.half); };
    std::ranges::for_each(function.signature, settle);
    std::ranges::for_each(function.parameters, settle);
    std::ranges::for_each(function.written, settle);
    const Shape shape = shape_of(function.returned_type);
    const bool value = shape.pieces > 0 && function.returned_type.find("ampler") == std::string::npos;
    function.returned = value ? shape.pieces * shape.piece : 0;
    const bool declared_full = function.returns_full || shape.whole || function.vertex;
    function.returns_full = function.returned == 0 || declared_full;
    const auto add = [&](const DeclaredParameter& one) {
        function.returned += one.components;
        function.returns_full = function.returns_full && one.full;
    };
    for (const DeclaredParameter& one : function.signature) {
        if (one.handed_back) add(one);
    }
    std::ranges::for_each(function.written, add);
    if (function.parameters.empty())
        function.parameters.push_back({.name = "nothing",
                                       .text = "float nothing",
                                       .type = "float",
                                       .components = 1,
                                       .piece = 1,
                                       .outside = true,
                                       .domain = {.kind = Domain::Kind::range}});
}

}  // namespace

std::string Declaration::place() const { return fmt::format("{}:{}", file, line); }

bool Declaration::plain() const {
    const auto simple = [](const std::string& type) { return type == "float" || type.starts_with("vec"); };
    return !vertex && written.empty() && simple(returned_type) && !returned_type.ends_with("[]") &&
           std::ranges::all_of(parameters, [&](const DeclaredParameter& one) { return !one.outside; }) &&
           std::ranges::all_of(signature, [&](const DeclaredParameter& one) {
               return simple(one.type) && one.elements == 0 && one.handed_in && !one.handed_back;
           });
}

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

namespace {

void declare_outside(Declaration& function, const std::string& text) {
    DeclaredParameter outside = parameter_of(text);
    if (outside.components == 0 || outside.name.empty())
        refuse(function, "'" + text + "' is not 'TYPE NAME' of something that can be given");
    outside.outside = true;
    outside.full = outside.full || (function.vertex && !outside.half);
    std::erase_if(function.parameters, [&](const DeclaredParameter& one) {
        return one.outside && (one.name == outside.name || one.name == "nothing");
    });
    function.parameters.push_back(std::move(outside));
}

}  // namespace

void declare_domain(Declaration& function, std::string_view text) {
    std::set<std::string> said;
    for (const std::string& item : split(text, ';')) {
        if (item.starts_with("where ")) {
            function.where = item.substr(6);
            continue;
        }
        const auto colon = item.find(':');
        if (colon == std::string::npos) refuse(function, "'" + item + "' is not 'PARAMETER: LOW..HIGH'");
        const std::string range = trimmed(item.substr(colon + 1));
        if (trimmed(item.substr(0, colon)).empty()) refuse(function, "'" + item + "' names no parameter");
        for (const std::string& name : split(item.substr(0, colon), ',')) {
            if (!said.insert(name.substr(name.rfind(' ') + 1)).second)
                refuse(function, "'" + name + "' is given two domains; keep one");
            if (name.find(' ') != std::string::npos) declare_outside(function, name);
            DeclaredParameter& parameter = name.find(' ') != std::string::npos
                                               ? function.parameters.back()
                                               : function.parameters[parameter_called(function, name)];
            if (range == "unit" || (range == "any" && !parameter.whole)) {
                parameter.domain.kind = range == "unit" ? Domain::Kind::unit : Domain::Kind::any;
                if (range == "unit" && (parameter.components < 2 || parameter.pieces() > 1 || parameter.whole))
                    refuse(function, "'" + parameter.name + "' is no vector and has no direction, which 'unit' says");
                continue;
            }
            parameter.domain.kind = Domain::Kind::range;
            if (range == "any")
                parameter.domain = {.kind = Domain::Kind::range,
                                    .low = parameter.type.starts_with("u") ? 0.0 : -2147483648.0,
                                    .high = parameter.type.starts_with("u") ? 4294967040.0 : 2147483520.0};
            else read_range(function, range, parameter.domain.low, parameter.domain.high);
        }
    }
}

std::string gap_in(const Declaration& function) {
    if (!function.not_run.empty()) return {};
    const std::string subject = fmt::format("{}: {} ", function.place(), function.name);
    for (const DeclaredParameter& parameter : function.signature) {
        if (parameter.components == 0)
            return fmt::format(
                "{}has the parameter '{}', of a type that nothing can be given for; write a function of "
                "what it reads of it beside it, or //@not_run and a reason",
                subject, parameter.text);
    }
    if (function.returned == 0)
        return fmt::format(
            "{}returns {}: nothing comes back that could be judged. If it writes a variable, say which "
            "in a line such as //@writes vec3 light; else //@not_run and a reason",
            subject, function.returned_type);
    for (const DeclaredParameter& parameter : function.parameters) {
        if (parameter.domain.kind == Domain::Kind::missing)
            return fmt::format(
                "{}says nothing of its parameter '{}'; write a line such as //@domain {}: 0..1 above it, "
                "or say it with --domain",
                subject, parameter.name, parameter.name);
    }
    return {};
}

std::vector<Declaration> functions_of(std::string_view path, std::string_view text) {
    std::vector<std::string> lines;
    for (std::size_t first = 0; first < text.size();) {
        const std::size_t end = std::min(text.find('\n', first), text.size());
        lines.emplace_back(text.substr(first, end - first));
        first = end + 1;
    }
    const Code code = code_of(lines);
    std::vector<Declaration> functions;
    for (std::size_t at = 0; at < lines.size(); ++at) {
        Declaration function{.file = std::string(path), .vertex = path.ends_with(".vert")};
        if (!read_signature(code, at, function) || function.name == "main") continue;
        std::size_t first = at;
        while (first > 0 && lines[first - 1].starts_with("//")) --first;
        for (std::size_t line = first; line < at; ++line) {
            if (lines[line].starts_with("//@stage")) read_line(function, trimmed(lines[line].substr(3)));
        }
        for (std::size_t line = first; line < at; ++line) {
            const std::string& comment = lines[line];
            if (comment.starts_with("//@") && !comment.starts_with("//@insert"))
                read_line(function, trimmed(comment.substr(3)));
        }
        complete(function);
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
