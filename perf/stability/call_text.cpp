// A wrapper in GLSL, so that the models and a context run one text.
#include "perf/stability/call_text.h"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

namespace halfframe::stability {
namespace {

std::string vector_type(int components) { return components == 1 ? "float" : fmt::format("vec{}", components); }

std::string precision_of(const DeclaredParameter& parameter) {
    if (parameter.type == "bool" || parameter.type.starts_with("bvec")) return "";
    return parameter.full ? "highp " : "";
}

/// The type that stands for it while no texture is read.
std::string held_type(const DeclaredParameter& parameter) {
    if (parameter.type == "sampler2DShadow") return "vec2";
    return parameter.is_sampler() ? "mat2x4" : parameter.type;
}

std::string converted(const DeclaredParameter& parameter, const std::string& pieces) {
    if (parameter.type == "bool") return pieces + " > 0.5";
    if (parameter.type.starts_with("bvec"))
        return fmt::format("greaterThan({}, {}(0.5))", pieces, vector_type(parameter.piece));
    return parameter.type == "float" ? pieces : fmt::format("{}({})", held_type(parameter), pieces);
}

/// "name = vec3(given_name);", or one such line for each element.
std::string assignments(const DeclaredParameter& parameter, const std::string& to) {
    const int elements = std::max(parameter.elements, 1);
    const int pieces = parameter.pieces() / elements;
    std::string text;
    for (int element = 0; element < elements; ++element) {
        std::string from;
        for (int piece = 0; piece < pieces; ++piece) {
            from += piece == 0 ? "" : ", ";
            from += parameter.pieces() == 1 ? "given_" + parameter.name
                                            : fmt::format("given_{}_{}", parameter.name, element * pieces + piece);
        }
        text += fmt::format(" {}{} = {};", to, parameter.elements > 0 ? fmt::format("[{}]", element) : "",
                            converted(parameter, from));
    }
    return text;
}

std::string declaration_of(const DeclaredParameter& parameter, const std::string& name) {
    return fmt::format(" {}{} {}{};", precision_of(parameter), held_type(parameter), name,
                       parameter.elements > 0 ? fmt::format("[{}]", parameter.elements) : "");
}

/// Every scalar of a value, as floats.
void add_scalars(const DeclaredParameter& parameter, const std::string& name, std::vector<std::string>& scalars) {
    const int elements = std::max(parameter.elements, 1);
    const int columns = parameter.pieces() / elements;
    for (int element = 0; element < elements; ++element) {
        for (int column = 0; column < columns; ++column) {
            for (int row = 0; row < parameter.piece; ++row) {
                std::string one = name;
                if (parameter.elements > 0) one += fmt::format("[{}]", element);
                if (columns > 1) one += fmt::format("[{}]", column);
                if (parameter.piece > 1) one += fmt::format("[{}]", row);
                scalars.push_back(parameter.whole ? "float(" + one + ")" : one);
            }
        }
    }
}

constexpr const char* kResult = "declared_result";

/// The call itself, with what stands before it, and the scalars of its results.
std::string body_of(const Declaration& function, std::vector<std::string>& scalars) {
    std::string text, arguments;
    for (const DeclaredParameter& one : function.parameters) {
        if (one.outside && one.name != "nothing") text += assignments(one, one.name);
    }
    for (const DeclaredParameter& one : function.signature) {
        const std::string name = "handed_" + one.name;
        text += declaration_of(one, name);
        if (one.handed_in) text += assignments(one, name);
        arguments += (arguments.empty() ? "" : ", ") + name;
    }
    const std::string call = fmt::format("{}({})", function.name, arguments);
    DeclaredParameter result;
    result.type = function.returned_type;
    result.components = function.returned;
    for (const DeclaredParameter& one : function.signature) result.components -= one.handed_back ? one.components : 0;
    for (const DeclaredParameter& one : function.written) result.components -= one.components;
    if (result.components > 0) {
        const bool matrix = result.type.starts_with("mat");
        result.piece = matrix ? result.type.back() - '0' : result.components;
        result.whole = result.type.find("vec") == 1 || (result.type != "float" && !matrix && result.type[0] != 'v');
        text += fmt::format(" {}{} {} = {};", result.type[0] == 'b' ? "" : "highp ", result.type, kResult, call);
        add_scalars(result, kResult, scalars);
    } else {
        text += " " + call + ";";
    }
    for (const DeclaredParameter& one : function.signature) {
        if (one.handed_back) add_scalars(one, "handed_" + one.name, scalars);
    }
    for (const DeclaredParameter& one : function.written) add_scalars(one, one.name, scalars);
    return text;
}

}  // namespace

std::vector<Piece> pieces_of(const Declaration& function) {
    std::vector<Piece> pieces;
    const bool plain = function.plain();
    for (std::size_t p = 0; p < function.parameters.size(); ++p) {
        const DeclaredParameter& one = function.parameters[p];
        for (int i = 0; i < one.pieces(); ++i)
            pieces.push_back({.name = plain               ? one.name
                                      : one.pieces() == 1 ? "given_" + one.name
                                                          : fmt::format("given_{}_{}", one.name, i),
                              .parameter = p,
                              .first = static_cast<std::size_t>(i * one.piece),
                              .components = one.piece,
                              .full = one.full});
    }
    return pieces;
}

std::string pieces_text(const Declaration& function) {
    std::string text;
    for (const Piece& one : pieces_of(function))
        text += fmt::format("{}{}{} {}", text.empty() ? "" : ", ", one.full ? "highp " : "",
                            vector_type(one.components), one.name);
    return text;
}

std::string unpacked(const Declaration& function) {
    if (function.plain()) return {};
    std::string text;
    for (const DeclaredParameter& one : function.parameters)
        text += declaration_of(one, one.name) + assignments(one, one.name);
    return text;
}

std::size_t calls_of(const Declaration& function) {
    return function.plain() ? 1 : static_cast<std::size_t>(function.returned + 3) / 4;
}

std::string call_name(std::size_t call) { return fmt::format("declared_call_{}", call); }

std::string calls_text(const Declaration& function) {
    if (function.plain()) return {};
    std::vector<std::string> scalars;
    const std::string body = body_of(function, scalars);
    std::string text;
    for (std::size_t call = 0; call < calls_of(function); ++call) {
        const std::size_t count = std::min<std::size_t>(scalars.size() - 4 * call, 4);
        std::string values;
        for (std::size_t s = 0; s < count; ++s) values += (s == 0 ? "" : ", ") + scalars[4 * call + s];
        const std::string type = vector_type(static_cast<int>(count));
        text += fmt::format("highp {} {}({}) {{{} return {}({}); }}\n", type, call_name(call), pieces_text(function),
                            body, type, values);
    }
    return text;
}

std::string outside_begins(const Declaration& function) {
    std::string text = function.vertex ? "precision highp float;\nprecision highp int;\n" : "";
    for (const char* word : {"uniform", "attribute", "varying", "flat", "invariant", "VERTEX_IN", "VERTEX_OUT"})
        text += fmt::format("#define {}\n", word);
    for (const char* word : {"FRAGMENT_IN", "FRAGMENT_UNIFORM"}) text += fmt::format("#undef {0}\n#define {0}\n", word);
    text += "#define main declared_main\n";
    for (const char* type : {"sampler2D", "sampler3D", "samplerCube", "sampler2DArray"})
        text += fmt::format("#define {} mat2x4\n", type);
    text += "#define sampler2DShadow vec2\n";
    constexpr const char* kTexel = "(float((at).x) < 0.5 ? (image)[0] : (image)[1])";
    for (const char* name : {"sample_2d", "sample_cube", "fetch_texel", "sample_compared", "texture", "texture2D",
                             "textureCube"})
        text += fmt::format("#undef {0}\n#define {0}(image, at) {1}\n", name, kTexel);
    for (const char* name : {"sample_cube_lod", "texelFetch", "textureLod", "texture2DLod", "texture2DLodEXT"})
        text += fmt::format("#undef {0}\n#define {0}(image, at, lod) {1}\n", name, kTexel);
    return text + "highp vec4 declared_position;\nhighp float declared_point_size;\n";
}

const char* outside_ends() {
    return "#undef uniform\n#undef flat\n#undef invariant\n#undef main\n#undef sampler2D\n#undef texelFetch\n"
           "#undef texture\n";
}

std::string without_stage(std::string_view text) {
    static const std::regex kLine(R"((^|\n)[ \t]*(#version|#extension|precision +\w+ +\w*sampler\w*|invariant )[^\n]*)");
    static const std::regex kPosition(R"(\bgl_Position\b)"), kSize(R"(\bgl_PointSize\b)"), kColor(R"(\bgl_FragColor\b)");
    std::string kept = std::regex_replace(std::string(text), kLine, "$1");
    kept = std::regex_replace(kept, kPosition, "declared_position");
    kept = std::regex_replace(kept, kSize, "declared_point_size");
    return std::regex_replace(kept, kColor, "fragment_color");
}

bool is_stage(std::string_view text) {
    static const std::regex kStage(R"((^|\n)[ \t]*(#version|void[ \t]+main[ \t]*\())");
    return std::regex_search(text.begin(), text.end(), kStage);
}

}  // namespace halfframe::stability
