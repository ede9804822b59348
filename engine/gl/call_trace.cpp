// Writes calls as JSON, with parameter names and types taken from the rows of entry_points.inl.
#include "engine/gl/call_trace.h"

#include <GLES3/gl3.h>

#include <GLES2/gl2ext.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/gl/call_number.h"
#include "engine/gl/fingerprint.h"
#include "engine/gl/pixel_format.h"

namespace halfframe::gl {
namespace {

constexpr std::array<std::string_view, kCallCount> kParameterLists = {
#define HALFFRAME_GL(since, result, name, parameters, arguments) #parameters,
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL
};

struct Parameter {
    std::string_view type;
    std::string_view name;
};

/// "(GLenum target, const void* data)" as types and names. No parameter of ours is a function pointer, so commas
/// separate.
std::vector<Parameter> parameters_of(int call) {
    std::string_view list = kParameterLists[static_cast<std::size_t>(call)];
    list = list.substr(1, list.size() - 2);
    std::vector<Parameter> parameters;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        std::string_view one = list.substr(0, comma);
        one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
        const std::size_t space = one.rfind(' ');
        parameters.push_back({one.substr(0, space), one.substr(space + 1)});
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return parameters;
}

struct Enumerant {
    std::int64_t value;
    const char* name;
};

// The enumerants that halfframe uses. 0 and 1 are several things at once and are not here: see enumerant().
#define HALFFRAME_ENUMERANT(name) \
    Enumerant { name, #name }
constexpr auto kEnumerants = std::to_array<Enumerant>({
    HALFFRAME_ENUMERANT(GL_ACTIVE_UNIFORMS),
    HALFFRAME_ENUMERANT(GL_ACTIVE_UNIFORM_MAX_LENGTH),
    HALFFRAME_ENUMERANT(GL_ALPHA),
    HALFFRAME_ENUMERANT(GL_ALWAYS),
    HALFFRAME_ENUMERANT(GL_ARRAY_BUFFER),
    HALFFRAME_ENUMERANT(GL_BACK),
    HALFFRAME_ENUMERANT(GL_BLEND),
    HALFFRAME_ENUMERANT(GL_BYTE),
    HALFFRAME_ENUMERANT(GL_CCW),
    HALFFRAME_ENUMERANT(GL_CLAMP_TO_EDGE),
    HALFFRAME_ENUMERANT(GL_COLOR),
    HALFFRAME_ENUMERANT(GL_COLOR_ATTACHMENT0),
    HALFFRAME_ENUMERANT(GL_COLOR_ATTACHMENT1),
    HALFFRAME_ENUMERANT(GL_COLOR_ATTACHMENT2),
    HALFFRAME_ENUMERANT(GL_COLOR_ATTACHMENT3),
    HALFFRAME_ENUMERANT(GL_COMPARE_REF_TO_TEXTURE),
    HALFFRAME_ENUMERANT(GL_COMPILE_STATUS),
    HALFFRAME_ENUMERANT(GL_COMPRESSED_RGBA_S3TC_DXT5_EXT),
    HALFFRAME_ENUMERANT(GL_COMPRESSED_RGB_S3TC_DXT1_EXT),
    HALFFRAME_ENUMERANT(GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT),
    HALFFRAME_ENUMERANT(GL_COMPRESSED_SRGB_S3TC_DXT1_EXT),
    HALFFRAME_ENUMERANT(GL_CULL_FACE),
    HALFFRAME_ENUMERANT(GL_CW),
    HALFFRAME_ENUMERANT(GL_DEBUG_SOURCE_APPLICATION_KHR),
    HALFFRAME_ENUMERANT(GL_DEPTH),
    HALFFRAME_ENUMERANT(GL_DEPTH_ATTACHMENT),
    HALFFRAME_ENUMERANT(GL_DEPTH_COMPONENT),
    HALFFRAME_ENUMERANT(GL_DEPTH_COMPONENT16),
    HALFFRAME_ENUMERANT(GL_DEPTH_COMPONENT24),
    HALFFRAME_ENUMERANT(GL_DEPTH_TEST),
    HALFFRAME_ENUMERANT(GL_DITHER),
    HALFFRAME_ENUMERANT(GL_DRAW_FRAMEBUFFER),
    HALFFRAME_ENUMERANT(GL_DST_ALPHA),
    HALFFRAME_ENUMERANT(GL_DST_COLOR),
    HALFFRAME_ENUMERANT(GL_DYNAMIC_DRAW),
    HALFFRAME_ENUMERANT(GL_ELEMENT_ARRAY_BUFFER),
    HALFFRAME_ENUMERANT(GL_EQUAL),
    HALFFRAME_ENUMERANT(GL_EXTENSIONS),
    HALFFRAME_ENUMERANT(GL_FLOAT),
    HALFFRAME_ENUMERANT(GL_FRAGMENT_SHADER),
    HALFFRAME_ENUMERANT(GL_FRAMEBUFFER),
    HALFFRAME_ENUMERANT(GL_FRONT),
    HALFFRAME_ENUMERANT(GL_FRONT_AND_BACK),
    HALFFRAME_ENUMERANT(GL_FUNC_ADD),
    HALFFRAME_ENUMERANT(GL_GEQUAL),
    HALFFRAME_ENUMERANT(GL_GREATER),
    HALFFRAME_ENUMERANT(GL_HALF_FLOAT),
    HALFFRAME_ENUMERANT(GL_HALF_FLOAT_OES),
    HALFFRAME_ENUMERANT(GL_HIGH_FLOAT),
    HALFFRAME_ENUMERANT(GL_INFO_LOG_LENGTH),
    HALFFRAME_ENUMERANT(GL_INT),
    HALFFRAME_ENUMERANT(GL_INT_2_10_10_10_REV),
    HALFFRAME_ENUMERANT(GL_LEQUAL),
    HALFFRAME_ENUMERANT(GL_LESS),
    HALFFRAME_ENUMERANT(GL_LINEAR),
    HALFFRAME_ENUMERANT(GL_LINEAR_MIPMAP_LINEAR),
    HALFFRAME_ENUMERANT(GL_LINEAR_MIPMAP_NEAREST),
    HALFFRAME_ENUMERANT(GL_LINK_STATUS),
    HALFFRAME_ENUMERANT(GL_LOW_FLOAT),
    HALFFRAME_ENUMERANT(GL_LUMINANCE),
    HALFFRAME_ENUMERANT(GL_LUMINANCE_ALPHA),
    HALFFRAME_ENUMERANT(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS),
    HALFFRAME_ENUMERANT(GL_MAX_CUBE_MAP_TEXTURE_SIZE),
    HALFFRAME_ENUMERANT(GL_MAX_DRAW_BUFFERS),
    HALFFRAME_ENUMERANT(GL_MAX_RENDERBUFFER_SIZE),
    HALFFRAME_ENUMERANT(GL_MAX_TEXTURE_IMAGE_UNITS),
    HALFFRAME_ENUMERANT(GL_MAX_TEXTURE_SIZE),
    HALFFRAME_ENUMERANT(GL_MAX_VERTEX_ATTRIBS),
    HALFFRAME_ENUMERANT(GL_MEDIUM_FLOAT),
    HALFFRAME_ENUMERANT(GL_MIRRORED_REPEAT),
    HALFFRAME_ENUMERANT(GL_NEAREST),
    HALFFRAME_ENUMERANT(GL_NEAREST_MIPMAP_LINEAR),
    HALFFRAME_ENUMERANT(GL_NEAREST_MIPMAP_NEAREST),
    HALFFRAME_ENUMERANT(GL_NEVER),
    HALFFRAME_ENUMERANT(GL_NOTEQUAL),
    HALFFRAME_ENUMERANT(GL_NUM_EXTENSIONS),
    HALFFRAME_ENUMERANT(GL_NUM_PROGRAM_BINARY_FORMATS),
    HALFFRAME_ENUMERANT(GL_ONE_MINUS_DST_ALPHA),
    HALFFRAME_ENUMERANT(GL_ONE_MINUS_DST_COLOR),
    HALFFRAME_ENUMERANT(GL_ONE_MINUS_SRC_ALPHA),
    HALFFRAME_ENUMERANT(GL_ONE_MINUS_SRC_COLOR),
    HALFFRAME_ENUMERANT(GL_PACK_ALIGNMENT),
    HALFFRAME_ENUMERANT(GL_PACK_ROW_LENGTH),
    HALFFRAME_ENUMERANT(GL_PACK_SKIP_PIXELS),
    HALFFRAME_ENUMERANT(GL_PACK_SKIP_ROWS),
    HALFFRAME_ENUMERANT(GL_PIXEL_PACK_BUFFER),
    HALFFRAME_ENUMERANT(GL_PIXEL_UNPACK_BUFFER),
    HALFFRAME_ENUMERANT(GL_POLYGON_OFFSET_FILL),
    HALFFRAME_ENUMERANT(GL_PROGRAM_BINARY_LENGTH),
    HALFFRAME_ENUMERANT(GL_PROGRAM_BINARY_RETRIEVABLE_HINT),
    HALFFRAME_ENUMERANT(GL_PROGRAM_KHR),
    HALFFRAME_ENUMERANT(GL_BUFFER_KHR),
    HALFFRAME_ENUMERANT(GL_RASTERIZER_DISCARD),
    HALFFRAME_ENUMERANT(GL_SAMPLE_ALPHA_TO_COVERAGE),
    HALFFRAME_ENUMERANT(GL_SAMPLE_COVERAGE),
    HALFFRAME_ENUMERANT(GL_SHADER_KHR),
    HALFFRAME_ENUMERANT(GL_QUERY_KHR),
    HALFFRAME_ENUMERANT(GL_UNPACK_ROW_LENGTH),
    HALFFRAME_ENUMERANT(GL_UNPACK_SKIP_PIXELS),
    HALFFRAME_ENUMERANT(GL_UNPACK_SKIP_ROWS),
    HALFFRAME_ENUMERANT(GL_VERTEX_ARRAY_KHR),
    HALFFRAME_ENUMERANT(GL_QUERY_RESULT),
    HALFFRAME_ENUMERANT(GL_QUERY_RESULT_AVAILABLE),
    HALFFRAME_ENUMERANT(GL_R11F_G11F_B10F),
    HALFFRAME_ENUMERANT(GL_R8),
    HALFFRAME_ENUMERANT(GL_READ_FRAMEBUFFER),
    HALFFRAME_ENUMERANT(GL_RED),
    HALFFRAME_ENUMERANT(GL_RENDERBUFFER),
    HALFFRAME_ENUMERANT(GL_RENDERER),
    HALFFRAME_ENUMERANT(GL_REPEAT),
    HALFFRAME_ENUMERANT(GL_RG),
    HALFFRAME_ENUMERANT(GL_RG8),
    HALFFRAME_ENUMERANT(GL_RGB),
    HALFFRAME_ENUMERANT(GL_RGB10_A2),
    HALFFRAME_ENUMERANT(GL_RGBA),
    HALFFRAME_ENUMERANT(GL_RGBA16F),
    HALFFRAME_ENUMERANT(GL_RGBA32F),
    HALFFRAME_ENUMERANT(GL_RGBA8),
    HALFFRAME_ENUMERANT(GL_SCISSOR_TEST),
    HALFFRAME_ENUMERANT(GL_SHORT),
    HALFFRAME_ENUMERANT(GL_SRC_ALPHA),
    HALFFRAME_ENUMERANT(GL_SRC_ALPHA_SATURATE),
    HALFFRAME_ENUMERANT(GL_SRC_COLOR),
    HALFFRAME_ENUMERANT(GL_SRGB8_ALPHA8),
    HALFFRAME_ENUMERANT(GL_SRGB_ALPHA_EXT),
    HALFFRAME_ENUMERANT(GL_STATIC_DRAW),
    HALFFRAME_ENUMERANT(GL_STENCIL_TEST),
    HALFFRAME_ENUMERANT(GL_STREAM_DRAW),
    HALFFRAME_ENUMERANT(GL_SYNC_GPU_COMMANDS_COMPLETE),
    HALFFRAME_ENUMERANT(GL_TEXTURE),
    HALFFRAME_ENUMERANT(GL_TEXTURE_2D),
    HALFFRAME_ENUMERANT(GL_TEXTURE_BASE_LEVEL),
    HALFFRAME_ENUMERANT(GL_TEXTURE_COMPARE_FUNC),
    HALFFRAME_ENUMERANT(GL_TEXTURE_COMPARE_MODE),
    HALFFRAME_ENUMERANT(GL_TEXTURE_CUBE_MAP),
    HALFFRAME_ENUMERANT(GL_TEXTURE_CUBE_MAP_NEGATIVE_X),
    HALFFRAME_ENUMERANT(GL_TEXTURE_CUBE_MAP_NEGATIVE_Y),
    HALFFRAME_ENUMERANT(GL_TEXTURE_CUBE_MAP_NEGATIVE_Z),
    HALFFRAME_ENUMERANT(GL_TEXTURE_CUBE_MAP_POSITIVE_X),
    HALFFRAME_ENUMERANT(GL_TEXTURE_CUBE_MAP_POSITIVE_Y),
    HALFFRAME_ENUMERANT(GL_TEXTURE_CUBE_MAP_POSITIVE_Z),
    HALFFRAME_ENUMERANT(GL_TEXTURE_MAG_FILTER),
    HALFFRAME_ENUMERANT(GL_TEXTURE_MAX_ANISOTROPY_EXT),
    HALFFRAME_ENUMERANT(GL_TEXTURE_MAX_LEVEL),
    HALFFRAME_ENUMERANT(GL_TEXTURE_MIN_FILTER),
    HALFFRAME_ENUMERANT(GL_TEXTURE_WRAP_S),
    HALFFRAME_ENUMERANT(GL_TEXTURE_WRAP_T),
    HALFFRAME_ENUMERANT(GL_TIME_ELAPSED_EXT),
    HALFFRAME_ENUMERANT(GL_UNPACK_ALIGNMENT),
    HALFFRAME_ENUMERANT(GL_UNSIGNED_BYTE),
    HALFFRAME_ENUMERANT(GL_UNSIGNED_INT),
    HALFFRAME_ENUMERANT(GL_UNSIGNED_INT_10F_11F_11F_REV),
    HALFFRAME_ENUMERANT(GL_UNSIGNED_INT_24_8),
    HALFFRAME_ENUMERANT(GL_UNSIGNED_INT_2_10_10_10_REV),
    HALFFRAME_ENUMERANT(GL_UNSIGNED_SHORT),
    HALFFRAME_ENUMERANT(GL_UNSIGNED_SHORT_5_6_5),
    HALFFRAME_ENUMERANT(GL_VENDOR),
    HALFFRAME_ENUMERANT(GL_VERSION),
    HALFFRAME_ENUMERANT(GL_VERTEX_SHADER),
    // Desktop GL alone: used by the named workarounds of the desktop contexts and by exact fragment counting.
    Enumerant{0x8642, "GL_PROGRAM_POINT_SIZE"},
    Enumerant{0x884F, "GL_TEXTURE_CUBE_MAP_SEAMLESS"},
    Enumerant{0x8914, "GL_SAMPLES_PASSED"},
    Enumerant{0x8DB9, "GL_FRAMEBUFFER_SRGB"},
    Enumerant{0x9126, "GL_CONTEXT_PROFILE_MASK"},
});
#undef HALFFRAME_ENUMERANT

/// What the number in a GLuint parameter of this call names.
NameSpace name_space(Call call, std::string_view parameter) {
    if (parameter == "buffer" || parameter == "buffers") return NameSpace::buffer;
    if (parameter == "texture" || parameter == "textures") return NameSpace::texture;
    if (parameter == "framebuffer" || parameter == "framebuffers") return NameSpace::framebuffer;
    if (parameter == "renderbuffer" || parameter == "renderbuffers") return NameSpace::renderbuffer;
    if (parameter == "array" || parameter == "arrays") return NameSpace::vertex_array;
    if (parameter == "program" || parameter == "shader") return NameSpace::program;
    if (parameter == "ids" || (parameter == "id" && call != Call::PushDebugGroup)) return NameSpace::query;
    return NameSpace::none;
}

/// The kind behind the identifier of glObjectLabel.
NameSpace labelled_space(std::int64_t identifier) {
    switch (identifier) {
        case GL_BUFFER_KHR: return NameSpace::buffer;
        case GL_TEXTURE: return NameSpace::texture;
        case GL_FRAMEBUFFER: return NameSpace::framebuffer;
        case GL_RENDERBUFFER: return NameSpace::renderbuffer;
        case GL_VERTEX_ARRAY_KHR: return NameSpace::vertex_array;
        case GL_QUERY_KHR: return NameSpace::query;
        case GL_SHADER_KHR:
        case GL_PROGRAM_KHR: return NameSpace::program;
        default: return NameSpace::none;
    }
}

std::string in_quotes(std::string_view text) {
    std::string out = "\"";
    for (const char letter : text) {
        if (letter == '"' || letter == '\\') {
            out += '\\';
            out += letter;
        } else if (static_cast<unsigned char>(letter) < 0x20) {
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
        } else {
            out += letter;
        }
    }
    return out + '"';
}

std::string enumerant(Call call, std::string_view parameter, std::int64_t value) {
    if (parameter == "mode" && (call == Call::DrawArrays || call == Call::DrawElements)) {
        constexpr std::array kModes = {"GL_POINTS",    "GL_LINES",          "GL_LINE_LOOP",   "GL_LINE_STRIP",
                                       "GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN"};
        if (value >= 0 && value < static_cast<std::int64_t>(kModes.size())) {
            return in_quotes(kModes[static_cast<std::size_t>(value)]);
        }
    }
    if (value == 0) return call == Call::BlendFuncSeparate ? "\"GL_ZERO\"" : "\"GL_NONE\"";
    if (value == 1) return call == Call::BlendFuncSeparate ? "\"GL_ONE\"" : "1";
    if (call == Call::ActiveTexture) return fmt::format("\"GL_TEXTURE{}\"", value - GL_TEXTURE0);
    const auto* found =
        std::find_if(kEnumerants.begin(), kEnumerants.end(), [&](const Enumerant& one) { return one.value == value; });
    return found != kEnumerants.end() ? in_quotes(found->name) : fmt::format("\"0x{:04X}\"", value);
}

std::string bits(Call call, std::int64_t value) {
    if (call == Call::ClientWaitSync)
        return value == GL_SYNC_FLUSH_COMMANDS_BIT ? "\"GL_SYNC_FLUSH_COMMANDS_BIT\"" : "0";
    if (call != Call::Clear) return fmt::format("{}", value);
    std::string out;
    for (const auto& [bit, name] :
         {std::pair{GL_COLOR_BUFFER_BIT, "GL_COLOR_BUFFER_BIT"}, std::pair{GL_DEPTH_BUFFER_BIT, "GL_DEPTH_BUFFER_BIT"},
          std::pair{GL_STENCIL_BUFFER_BIT, "GL_STENCIL_BUFFER_BIT"}}) {
        if ((value & bit) == 0) continue;
        if (!out.empty()) out += '|';
        out += name;
    }
    return in_quotes(out);
}

/// The shortest text that reads back as the same float; JSON has no infinities, so those are strings.
std::string real(double value) {
    if (!std::isfinite(value)) return fmt::format("\"{}\"", value);
    return fmt::format("{}", static_cast<float>(value));
}

std::string block(const void* data, std::uint64_t bytes) {
    return fmt::format("{{\"bytes\":{},\"hash\":\"{:016x}\"}}", bytes,
                       fingerprint({static_cast<const char*>(data), static_cast<std::size_t>(bytes)}));
}

template <typename T, typename Write>
std::string array(const void* data, std::int64_t count, Write write) {
    const auto* values = static_cast<const T*>(data);
    std::string out = "[";
    for (std::int64_t i = 0; i < count; ++i) {
        if (i > 0) out += ',';
        out += write(values[i]);
    }
    out += ']';
    return out;
}

/// One call being written: its parameters beside their values.
struct Line {
    Call call;
    std::vector<Parameter> parameters;
    std::span<const TraceValue> values;
    int row_alignment;
    TracedNames& names;

    [[nodiscard]] std::int64_t integer(std::string_view name) const {
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            if (parameters[i].name == name) return values[i].integer;
        }
        return 0;
    }
    [[nodiscard]] const void* pointer(std::string_view name) const {
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            if (parameters[i].name == name) return values[i].pointer;
        }
        return nullptr;
    }
    [[nodiscard]] std::uint64_t pixel_bytes() const {
        return transfer_bytes(static_cast<std::uint32_t>(integer("format")),
                              static_cast<std::uint32_t>(integer("type")), static_cast<int>(integer("width")),
                              static_cast<int>(integer("height")), row_alignment);
    }

    /// All strings of a glShaderSource as one block.
    [[nodiscard]] std::string source() const {
        const auto* texts = static_cast<const char* const*>(pointer("text"));
        const auto* lengths = static_cast<const GLint*>(pointer("length"));
        std::string whole;
        for (std::int64_t i = 0; i < integer("count"); ++i) {
            if (lengths != nullptr && lengths[i] >= 0) {
                whole.append(texts[i], static_cast<std::size_t>(lengths[i]));
            } else {
                whole += texts[i];
            }
        }
        return block(whole.data(), whole.size());
    }

    /// `length` of KHR_debug: negative when the text ends with a zero.
    [[nodiscard]] std::string text(const void* data) const {
        const auto* begin = static_cast<const char*>(data);
        const bool counted = call == Call::ObjectLabel || call == Call::PushDebugGroup;
        const std::int64_t length = counted ? integer("length") : -1;
        return in_quotes(length >= 0 ? std::string_view(begin, static_cast<std::size_t>(length))
                                  : std::string_view(begin));
    }

    [[nodiscard]] std::string pointed(const Parameter& parameter, const void* data) const {
        if (parameter.name == "offset") return fmt::format("{}", reinterpret_cast<std::uintptr_t>(data));
        if (data == nullptr) return "null";
        if (parameter.type == "const GLchar*") return text(data);
        if (parameter.type == "const GLchar* const*") return source();
        if (parameter.type == "const GLfloat*") {
            const int floats = call == Call::UniformMatrix4fv ? 16 : 4;
            return array<GLfloat>(data, integer("count") * floats,
                                  [](GLfloat x) { return real(static_cast<double>(x)); });
        }
        if (parameter.type == "GLuint*" || parameter.type == "const GLuint*") {
            return array<GLuint>(data, integer("n"), [&](GLuint name) {
                return fmt::format("{}", names.number(name_space(call, parameter.name), name));
            });
        }
        if (parameter.type == "const GLenum*") {
            return array<GLenum>(data, integer("count"), [&](GLenum x) { return enumerant(call, parameter.name, x); });
        }
        switch (call) {
            case Call::BufferData:
            case Call::BufferSubData: return block(data, static_cast<std::uint64_t>(integer("size")));
            case Call::CompressedTexImage2D: return block(data, static_cast<std::uint64_t>(integer("image_size")));
            case Call::TexImage2D: return block(data, pixel_bytes());
            case Call::ReadPixels: return fmt::format("{{\"bytes\":{}}}", pixel_bytes());
            // The driver's own format: its bytes are not ours to promise.
            case Call::ProgramBinary: return fmt::format("{{\"bytes\":{}}}", integer("length"));
            default: return "null";
        }
    }

    /// A GLuint: the trace's number of an object, or the value itself.
    [[nodiscard]] std::int64_t named(std::string_view parameter, std::int64_t value) const {
        const bool label = call == Call::ObjectLabel && parameter == "name";
        const NameSpace space = label ? labelled_space(integer("identifier")) : name_space(call, parameter);
        return space == NameSpace::none ? value : names.number(space, static_cast<std::uint32_t>(value));
    }

    /// After a glDelete*: its names mean nothing any more.
    void forget_deleted() const {
        if (call == Call::DeleteProgram)
            return names.forget(NameSpace::program, static_cast<std::uint32_t>(integer("program")));
        if (call == Call::DeleteShader)
            return names.forget(NameSpace::program, static_cast<std::uint32_t>(integer("shader")));
        if (!std::string_view(call_name(number(call))).starts_with("glDelete") || parameters.size() != 2) return;
        const auto* deleted = static_cast<const GLuint*>(values[1].pointer);
        for (std::int64_t i = 0; i < integer("n"); ++i) names.forget(name_space(call, parameters[1].name), deleted[i]);
    }

    [[nodiscard]] std::string argument(std::size_t index) const {
        const Parameter& parameter = parameters[index];
        const TraceValue& value = values[index];
        if (parameter.type.ends_with('*')) return pointed(parameter, value.pointer);
        if (parameter.type == "GLfloat") return real(value.real);
        if (parameter.type == "GLenum" || parameter.name == "internal_format") {
            return enumerant(call, parameter.name, value.integer);
        }
        if (parameter.type == "GLuint") return fmt::format("{}", named(parameter.name, value.integer));
        if (parameter.type == "GLbitfield") return bits(call, value.integer);
        if (parameter.type == "GLboolean") return value.integer != 0 ? "true" : "false";
        // Filters and wraps are enumerants from 0x2600 on; levels and ratios are small numbers.
        if (call == Call::TexParameteri && parameter.name == "value" && value.integer >= 0x200) {
            return enumerant(call, parameter.name, value.integer);
        }
        return fmt::format("{}", value.integer);
    }
};

bool result_is_a_name(Call call) { return call == Call::CreateShader || call == Call::CreateProgram; }

}  // namespace

int TracedNames::number(NameSpace space, std::uint32_t name) {
    if (name == 0) return 0;
    const auto [found, is_new] = numbers_.try_emplace({space, name}, 0);
    if (is_new) found->second = ++last_[space];
    return found->second;
}

void TracedNames::forget(NameSpace space, std::uint32_t name) { numbers_.erase({space, name}); }

void CallTrace::record(int call_index, std::string_view pass, std::span<const TraceValue> values,
                       const TraceValue* result, int row_alignment) {
    const auto call = static_cast<Call>(call_index);
    const Line line{call, parameters_of(call_index), values, row_alignment, names_};
    std::string out = fmt::format("[{},\"{}\",[", in_quotes(pass), call_name(call_index));
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out += ',';
        out += line.parameters[i].type == "GLsync" ? sync_index(values[i].pointer) : line.argument(i);
    }
    out += ']';
    if (call == Call::FenceSync && result != nullptr) {
        syncs_.push_back(result->pointer);
        out += ',' + sync_index(result->pointer);
    } else if (result_is_a_name(call) && result != nullptr) {
        out += fmt::format(",{}", names_.number(NameSpace::program, static_cast<std::uint32_t>(result->integer)));
    }
    out += ']';
    line.forget_deleted();
    if (!lines_.empty()) lines_ += ",\n";
    lines_ += out;
}

std::string CallTrace::sync_index(const void* sync) {
    for (std::size_t i = syncs_.size(); i > 0; --i) {
        if (syncs_[i - 1] == sync) return std::to_string(i - 1);
    }
    return "null";  // made before the trace was opened
}

std::string CallTrace::json() const { return "[\n" + lines_ + (lines_.empty() ? "]\n" : "\n]\n"); }

}  // namespace halfframe::gl
