// Brings a user's shader to the form that is counted.
#include "perf/cost/user_shader.h"

#include <algorithm>
#include <array>
#include <new>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "content/nearest.h"
#include "engine/error.h"
#include "perf/shader_ir/compile.h"
#include "perf/shader_ir/deep_stack.h"
#include "perf/shader_ir/loop_rounds.h"

namespace halfframe::cost {
namespace {

/// The words of ES 1.00 that ES 3.00 spells otherwise.
constexpr const char* kTwin =
    "#define varying in\n"
    "#define attribute in\n"
    "#define texture2D texture\n"
    "#define texture2DProj textureProj\n"
    "#define texture2DLod textureLod\n"
    "#define texture2DLodEXT textureLod\n"
    "#define texture2DProjLodEXT textureProjLod\n"
    "#define texture2DGradEXT textureGrad\n"
    "#define textureCube texture\n"
    "#define textureCubeLod textureLod\n"
    "#define textureCubeLodEXT textureLod\n"
    "#define textureCubeGradEXT textureGrad\n"
    "#define gl_FragDepthEXT gl_FragDepth\n";

constexpr const char* kTwinOfColor =
    "#define gl_FragColor halfframe_fragment_color\n"
    "out mediump vec4 halfframe_fragment_color;\n";

/// A text that names gl_FragData, be it in a remark, and writes gl_FragColor, writes the first of them.

constexpr const char* kTwinOfData =
    "#define gl_FragData halfframe_fragment_data\n"
    "#define gl_FragColor halfframe_fragment_data[0]\n"
    "out mediump vec4 halfframe_fragment_data[4];\n";

/// Words that mean nothing in ES 1.00 and something in ES 3.00: shaders of the former use them as names.
constexpr auto kLaterWords = std::to_array<std::string_view>(
    {"texture",     "textureProj", "textureLod",  "textureProjLod", "textureGrad", "textureOffset",
     "textureSize", "texelFetch",  "round",       "roundEven",      "trunc",       "modf",
     "isnan",       "isinf",       "sinh",        "cosh",           "tanh",        "asinh",
     "acosh",       "atanh",       "determinant", "inverse",        "transpose",   "outerProduct",
     "fma",         "ldexp",       "frexp",       "umulExtended",   "layout",      "centroid",
     "smooth",      "case",        "uint",        "uvec2",          "uvec3",       "uvec4",
     "mat2x2",      "mat2x3",      "mat2x4",      "mat3x2",         "mat3x3",      "mat3x4",
     "mat4x2",      "mat4x3",      "mat4x4",      "sample",         "patch",       "subroutine",
     "common",      "partition",   "active",      "filter",         "resource",    "buffer",
     "shared",      "coherent",    "restrict",    "readonly",       "writeonly",   "precise",
     "image2D",     "bitCount",    "findLSB"});
constexpr std::string_view kRenamed = "halfframe_1_";

/// ES 1.00 text whose names that ES 3.00 keeps for itself are others. Lines stay where they are.
std::string with_own_names(const std::string& text) {
    const auto is_word = [](char letter) {
        return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
               (letter >= '0' && letter <= '9') || letter == '_';
    };
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && is_word(text[end])) ++end;
        if (end == at) {
            result += text[at++];
            continue;
        }
        const std::string_view word = std::string_view(text).substr(at, end - at);
        if (std::ranges::find(kLaterWords, word) != kLaterWords.end()) result += kRenamed;
        result += word;
        at = end;
    }
    return result;
}

/// What draws from a camera's picture is counted as a picture like any other.
constexpr const char* kExternal = "#define samplerExternalOES sampler2D\n";

/// Empties the lines that ask for extensions which change no count and which glslang does not know.
std::string without_free_extensions(std::string text) {
    constexpr auto kFree = std::to_array<std::string_view>(
        {"GL_EXT_draw_buffers", "GL_OES_EGL_image_external", "GL_OES_EGL_image_external_essl3"});
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::istringstream line(text.substr(begin, end - begin));
        std::string mark, word, extension;
        line >> mark;
        if (mark == "#") line >> word;
        if (mark == "#extension" || word == "extension") {
            std::getline(line >> std::ws, extension, ':');
            extension.erase(std::min(extension.find_last_not_of(" \t") + 1, extension.size()));
            if (std::ranges::find(kFree, extension) != kFree.end())
                std::fill(text.begin() + static_cast<std::ptrdiff_t>(begin),
                          text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
        }
        begin = end + 1;
    }
    return text;
}

struct Versioned {
    int version = 100;
    std::string text;  ///< with the #version line emptied, so that lines keep their numbers
};

Versioned versioned(const std::string& file, const std::string& original) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    const std::string text = original.starts_with(kByteOrderMark) ? original.substr(kByteOrderMark.size()) : original;
    const std::regex pattern(R"((^|\n)[ \t]*#[ \t]*version[ \t]+(\d+)([^\n]*))");
    std::smatch found;
    if (!std::regex_search(text, found, pattern)) return {100, text};
    const std::string number = found[2].str();
    const std::string rest = text.substr(0, static_cast<std::size_t>(found.position(0))) + found[1].str() +
                             text.substr(static_cast<std::size_t>(found.position(0) + found.length(0)));
    const bool es = found[3].str().find("es") != std::string::npos;
    if (number == "100") return {100, rest};
    if (es && (number == "300" || number == "310")) return {300, rest};
    throw Error(Fault::input, fmt::format("{}: #version {}{} is not counted; write 100, 300 es or 310 es", file, number,
                                          found[3].str()));
}

const char* precision_words(Precisions precisions) {
    switch (precisions) {
        case Precisions::as_written: return "";
        case Precisions::half: return "#define highp mediump\n";
        // Samplers are lowp where nothing is said, and what they give with them.
        case Precisions::full:
            return "#define mediump highp\n#define lowp highp\nprecision highp sampler2D;\nprecision highp "
                   "samplerCube;\n";
    }
    return "";
}

constexpr std::array<std::pair<const char*, gl::PixelFormat>, 5> kFormats{{{"rgba8", gl::PixelFormat::rgba8},
                                                                           {"rgb10_a2", gl::PixelFormat::rgb10_a2},
                                                                           {"r11g11b10f", gl::PixelFormat::r11g11b10f},
                                                                           {"rgba16f", gl::PixelFormat::rgba16f},
                                                                           {"rgba32f", gl::PixelFormat::rgba32f}}};

}  // namespace

const char* name(Precisions precisions) {
    switch (precisions) {
        case Precisions::as_written: return "as written";
        case Precisions::half: return "half";
        case Precisions::full: return "full";
    }
    return "";
}

namespace {

CountedStage counted_stage(const std::string& file, const std::string& text, Precisions precisions) {
    Versioned shader = versioned(file, text);
    shader.text = without_free_extensions(std::move(shader.text));
    const bool old = shader.version == 100;
    const bool external = shader.text.find("samplerExternalOES") != std::string::npos;
    const std::string head = std::string(external ? kExternal : "") + "#line 1 0\n";
    if (old) shader_ir::check_es100({.text = "#version 100\n" + head + shader.text, .files = {file}});
    gl::StageText stage{.text = "#version 300 es\n", .files = {file}};
    // Appendix A lets the counter of a loop choose a sampler; later versions ask for this extension.
    if (old) stage.text += "#extension GL_EXT_gpu_shader5 : enable\n";
    stage.text += precision_words(precisions);
    if (old) {
        stage.text += kTwin;
        stage.text += shader.text.find("gl_FragData") != std::string::npos ? kTwinOfData : kTwinOfColor;
    }
    stage.text += head + (old ? with_own_names(shader.text) : shader.text);
    const shader_ir::Module written = shader_ir::compile(stage, gl::Stage::fragment);
    CountedStage counted{.module = shader_ir::compile(stage, gl::Stage::fragment, shader_ir::Cleaning::optimised)};
    counted.module.up_converted = old;
    counted.counts = count_shader(counted.module);
    if (external) counted.counts.notices.emplace_back("samplerExternalOES is counted as sampler2D");
    for (const std::uint32_t line : shader_ir::endless_loops(written))
        counted.counts.notices.push_back(fmt::format(
            "{}: nothing ends this loop: no pixel that enters it is ever done, and what such a loop leads to "
            "is not counted",
            written.place(line)));
    for (SamplerUse& use : counted.counts.samplers)
        if (use.name.starts_with(kRenamed)) use.name.erase(0, kRenamed.size());
    return counted;
}

}  // namespace

CountedStage count_user_shader(const std::string& file, const std::string& text, Precisions precisions) {
    CountedStage counted;
    try {
        shader_ir::on_deep_stack([&] { counted = counted_stage(file, text, precisions); });
        return counted;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        // A stranger's shader may hold what neither our parser nor SPIRV-Tools knows; what these say helps no stranger.
        throw Error(
            Fault::check,
            fmt::format("{}: compiles, but holds something that is not counted; leave out functions until it is, "
                        "and the last one left out is the one",
                        file));
    }
}

gl::PixelFormat parse_color_format(const std::string& words, const std::string& option) {
    std::vector<std::string> names;
    for (const auto& [format_name, format] : kFormats) {
        if (words == format_name) return format;
        names.emplace_back(format_name);
    }
    throw Error(Fault::usage,
                fmt::format("{}: unknown format '{}'{} There are rgba8, rgb10_a2, r11g11b10f, rgba16f, rgba32f", option,
                            words, content::did_you_mean(words, names)));
}

UserTexture parse_user_texture(const std::string& words) {
    const std::size_t equals = words.find('=');
    if (equals == std::string::npos || equals == 0)
        throw Error(Fault::usage, fmt::format("--texture {}: write NAME=FORMAT, for example image=rgba16f", words));
    UserTexture texture{.sampler = words.substr(0, equals)};
    std::string format = words.substr(equals + 1);
    if (const std::size_t comma = format.find(','); comma != std::string::npos) {
        if (format.substr(comma + 1) != "trilinear")
            throw Error(Fault::usage, fmt::format("--texture {}: behind the comma only trilinear is known", words));
        texture.trilinear = true;
        format.resize(comma);
    }
    texture.format = parse_color_format(format, "--texture " + words);
    return texture;
}

PassWork user_pass(const ShaderCounts& counts, const std::vector<UserTexture>& textures, const TargetWork& target) {
    std::vector<std::string> read;
    for (const SamplerUse& use : counts.samplers) read.push_back(use.name);
    for (const UserTexture& texture : textures) {
        if (std::ranges::find(read, texture.sampler) != read.end()) continue;
        std::string list;
        for (const std::string& one : read) list += (list.empty() ? "" : ", ") + one;
        throw Error(Fault::usage,
                    fmt::format("--texture {}: the shader reads no such sampler{} It reads {}", texture.sampler,
                                content::did_you_mean(texture.sampler, read), list.empty() ? "none" : list));
    }
    DrawWork draw{.fragments_shaded = target.pixels(),
                  .fragments_written = target.pixels(),
                  .vertices = 3,
                  .triangles = 1,
                  .temporaries = counts.temporaries};
    PassWork pass{.name = "shader", .color = target};
    const std::array paths{&counts.weighted, &counts.shortest, &counts.longest};
    for (std::size_t way = 0; way < paths.size(); ++way) {
        draw.fragment[way].work = paths[way]->work;
        for (std::size_t i = 0; i < counts.samplers.size(); ++i) {
            const auto named = std::ranges::find(textures, counts.samplers[i].name, &UserTexture::sampler);
            const UserTexture texture = named != textures.end() ? *named : UserTexture{};
            draw.fragment[way].fetches.push_back({.count = paths[way]->fetches[i],
                                                  .format = texel_format(texture.format),
                                                  .shape = counts.samplers[i].shape,
                                                  .trilinear = texture.trilinear});
            // As large as the target: read at most once as a whole.
            if (way == 0)
                pass.texture_bytes +=
                    target.pixels() * std::min(1.0, paths[way]->fetches[i]) * gl::bytes_per_pixel(texture.format);
        }
    }
    pass.draws = {draw};
    return pass;
}

}  // namespace halfframe::cost
