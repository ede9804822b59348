// What a masked context refuses in the arguments of a call: limits, formats and targets that its Caps do not grant.
// Only entry_points.cpp includes this. A rule is a pure function of Caps and the arguments, and returns the sentence
// that is broken, or an empty string. Rules allocate only when they refuse.
//
// Not covered: what the driver itself reports as a GL error, and what needs a memory of state (a non-power-of-two
// texture that repeats, a framebuffer whose texture does not render: Caps::renders tells that beforehand).
#pragma once

#include <GLES3/gl3.h>

#include <GLES2/gl2ext.h>

#include <string>
#include <string_view>

#include "engine/gl/call_number.h"
#include "engine/gl/caps.h"

namespace halfframe::gl {

inline constexpr GLenum kTextureCubeMapSeamless = 0x884F;  ///< desktop GL
inline constexpr GLenum kProgramPointSize = 0x8642;        ///< desktop GL
inline constexpr GLenum kFramebufferSrgb = 0x8DB9;         ///< desktop GL, or EXT_sRGB_write_control
inline constexpr GLenum kSamplesPassed = 0x8914;           ///< desktop GL

[[nodiscard]] inline std::string hexadecimal(std::int64_t value) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string out;
    for (int shift = 12; shift >= 0; shift -= 4) out += kDigits[(value >> shift) & 15];
    return "0x" + out;
}

[[nodiscard]] inline std::string over_limit(const char* what, std::int64_t value, const char* limit_name, int limit) {
    return std::string(what) + " " + std::to_string(value) + " is over " + limit_name + " = " + std::to_string(limit);
}

/// True where the rules of ES 3.0 hold.
[[nodiscard]] inline bool es30(const Caps& caps) { return caps.es_version >= 30; }

/// Calls without a rule.
template <Call call>
struct ArgumentRule {
    const Caps& caps;
    template <typename... Arguments>
    std::string operator()(const Arguments&...) const {
        return {};
    }
};

template <>
struct ArgumentRule<Call::ActiveTexture> {
    const Caps& caps;
    std::string operator()(GLenum texture) const {
        const std::int64_t unit = std::int64_t{texture} - GL_TEXTURE0;
        if (unit >= 0 && unit < caps.max_combined_samplers) return {};
        return over_limit("texture unit", unit, "one less than max_combined_samplers", caps.max_combined_samplers);
    }
};

template <>
struct ArgumentRule<Call::EnableVertexAttribArray> {
    const Caps& caps;
    std::string operator()(GLuint index) const {
        if (index < static_cast<GLuint>(caps.max_vertex_attributes)) return {};
        return over_limit("attribute index", index, "one less than max_vertex_attributes", caps.max_vertex_attributes);
    }
};

template <>
struct ArgumentRule<Call::BindAttribLocation> {
    const Caps& caps;
    std::string operator()(GLuint, GLuint index, const GLchar*) const {
        return ArgumentRule<Call::EnableVertexAttribArray>{caps}(index);
    }
};

template <>
struct ArgumentRule<Call::VertexAttribPointer> {
    const Caps& caps;
    std::string operator()(GLuint index, GLint, GLenum type, GLboolean, GLsizei, const void*) const {
        const bool later = type == GL_HALF_FLOAT || type == GL_INT_2_10_10_10_REV ||
                           type == GL_UNSIGNED_INT_2_10_10_10_REV || type == GL_INT || type == GL_UNSIGNED_INT;
        if (later && !es30(caps)) return "vertex attributes of type " + hexadecimal(type) + " need ES 3.0";
        if (type == GL_HALF_FLOAT_OES && !caps.has_extension("GL_OES_vertex_half_float")) {
            return "vertex attributes of type GL_HALF_FLOAT_OES need GL_OES_vertex_half_float";
        }
        return ArgumentRule<Call::EnableVertexAttribArray>{caps}(index);
    }
};

template <>
struct ArgumentRule<Call::DrawElements> {
    const Caps& caps;
    std::string operator()(GLenum, GLsizei, GLenum type, const void*) const {
        if (type == GL_UNSIGNED_INT && !caps.index_uint) {
            return "indices of type GL_UNSIGNED_INT need ES 3.0 or GL_OES_element_index_uint";
        }
        return {};
    }
};

template <>
struct ArgumentRule<Call::BindBuffer> {
    const Caps& caps;
    std::string operator()(GLenum target, GLuint) const {
        if (target == GL_ARRAY_BUFFER || target == GL_ELEMENT_ARRAY_BUFFER || es30(caps)) return {};
        return "buffer target " + hexadecimal(target) + " needs ES 3.0";
    }
};

template <>
struct ArgumentRule<Call::BindTexture> {
    const Caps& caps;
    std::string operator()(GLenum target, GLuint) const {
        if (target == GL_TEXTURE_2D || target == GL_TEXTURE_CUBE_MAP || es30(caps)) return {};
        if (target == GL_TEXTURE_3D && caps.max_texture_3d_size > 0) return {};
        return "texture target " + hexadecimal(target) + " needs ES 3.0";
    }
};

template <>
struct ArgumentRule<Call::BindFramebuffer> {
    const Caps& caps;
    std::string operator()(GLenum target, GLuint) const {
        if (target == GL_FRAMEBUFFER || es30(caps)) return {};
        return "framebuffer target " + hexadecimal(target) + " needs ES 3.0";
    }
};

[[nodiscard]] inline std::string broken_attachment_rule(const Caps& caps, GLenum attachment) {
    const std::int64_t index = std::int64_t{attachment} - GL_COLOR_ATTACHMENT0;
    if (index < 0 || index >= 32 || index < caps.max_draw_buffers) return {};  // negative or large: depth or stencil
    return over_limit("colour attachment", index, "one less than max_draw_buffers", caps.max_draw_buffers);
}

template <>
struct ArgumentRule<Call::FramebufferTexture2D> {
    const Caps& caps;
    std::string operator()(GLenum, GLenum attachment, GLenum, GLuint, GLint level) const {
        if (level != 0 && !es30(caps) && !caps.has_extension("GL_OES_fbo_render_mipmap")) {
            return "drawing to mip level " + std::to_string(level) + " needs ES 3.0 or GL_OES_fbo_render_mipmap";
        }
        return broken_attachment_rule(caps, attachment);
    }
};

template <>
struct ArgumentRule<Call::FramebufferRenderbuffer> {
    const Caps& caps;
    std::string operator()(GLenum, GLenum attachment, GLenum, GLuint) const {
        return broken_attachment_rule(caps, attachment);
    }
};

template <>
struct ArgumentRule<Call::BufferData> {
    const Caps& caps;
    std::string operator()(GLenum, GLsizeiptr, const void*, GLenum usage) const {
        if (usage == GL_STREAM_DRAW || usage == GL_STATIC_DRAW || usage == GL_DYNAMIC_DRAW || es30(caps)) return {};
        return "buffer usage " + hexadecimal(usage) + " needs ES 3.0";
    }
};

template <>
struct ArgumentRule<Call::UniformMatrix4fv> {
    const Caps& caps;
    std::string operator()(GLint, GLsizei, GLboolean transpose, const GLfloat*) const {
        return transpose == GL_FALSE || es30(caps) ? std::string() : "transposing a uniform matrix needs ES 3.0";
    }
};

template <>
struct ArgumentRule<Call::PixelStorei> {
    const Caps& caps;
    std::string operator()(GLenum pname, GLint) const {
        if (pname == GL_PACK_ALIGNMENT || pname == GL_UNPACK_ALIGNMENT || es30(caps)) return {};
        return "pixel store parameter " + hexadecimal(pname) + " needs ES 3.0";
    }
};

/// glEnable and glDisable.
[[nodiscard]] inline std::string broken_switch_rule(const Caps& caps, GLenum capability) {
    switch (capability) {
        case GL_BLEND:
        case GL_CULL_FACE:
        case GL_DEPTH_TEST:
        case GL_DITHER:
        case GL_POLYGON_OFFSET_FILL:
        case GL_SAMPLE_ALPHA_TO_COVERAGE:
        case GL_SAMPLE_COVERAGE:
        case GL_SCISSOR_TEST:
        case GL_STENCIL_TEST: return {};
        // Workaround desktop_point_size_and_seamless_cubes: ES has both always on, a desktop context must be told.
        case kTextureCubeMapSeamless:
        case kProgramPointSize:
        case kFramebufferSrgb:
            return caps.desktop ? std::string()
                                : "capability " + hexadecimal(capability) + " exists on desktop GL alone";
        default: return es30(caps) ? std::string() : "capability " + hexadecimal(capability) + " needs ES 3.0";
    }
}

template <>
struct ArgumentRule<Call::Enable> {
    const Caps& caps;
    std::string operator()(GLenum capability) const { return broken_switch_rule(caps, capability); }
};

template <>
struct ArgumentRule<Call::Disable> {
    const Caps& caps;
    std::string operator()(GLenum capability) const { return broken_switch_rule(caps, capability); }
};

template <>
struct ArgumentRule<Call::TexParameteri> {
    const Caps& caps;
    std::string operator()(GLenum, GLenum pname, GLint) const {
        switch (pname) {
            case GL_TEXTURE_MIN_FILTER:
            case GL_TEXTURE_MAG_FILTER:
            case GL_TEXTURE_WRAP_S:
            case GL_TEXTURE_WRAP_T: return {};
            case GL_TEXTURE_MAX_ANISOTROPY_EXT:
                return caps.anisotropy ? std::string() : "anisotropy needs GL_EXT_texture_filter_anisotropic";
            default: return es30(caps) ? std::string() : "texture parameter " + hexadecimal(pname) + " needs ES 3.0";
        }
    }
};

template <>
struct ArgumentRule<Call::BeginQuery> {
    const Caps& caps;
    std::string operator()(GLenum target, GLuint) const {
        if (target == GL_TIME_ELAPSED_EXT && !caps.timer_query)
            return "GL_TIME_ELAPSED needs GL_EXT_disjoint_timer_query";
        if (target == kSamplesPassed && !caps.samples_passed) return "GL_SAMPLES_PASSED exists on desktop GL alone";
        return {};
    }
};

template <>
struct ArgumentRule<Call::ShaderSource> {
    const Caps& caps;
    std::string operator()(GLuint, GLsizei count, const GLchar* const* text, const GLint*) const {
        // Mesa accepts this text even when it was told to be ES 2.0, so the mask has to refuse it.
        const bool later = count > 0 && std::string_view(text[0]).starts_with("#version 300");
        return later && !es30(caps) ? "\"#version 300 es\" needs ES 3.0" : std::string();
    }
};

/// ES 2.0 section 3.7.1 and the extensions that widen it: the internal format is the format, and few types exist.
[[nodiscard]] inline std::string broken_unsized_rule(const Caps& caps, GLenum internal_format, GLenum format,
                                                     GLenum type) {
    if (internal_format != format) {
        return "internal format " + hexadecimal(internal_format) + " with format " + hexadecimal(format) +
               ": sized internal formats need ES 3.0";
    }
    switch (format) {
        case GL_ALPHA:
        case GL_LUMINANCE:
        case GL_LUMINANCE_ALPHA:
        case GL_RGB:
        case GL_RGBA: break;
        case GL_DEPTH_COMPONENT:
            if (!caps.depth_texture) return "depth textures need ES 3.0 or GL_OES_depth_texture";
            return type == GL_UNSIGNED_SHORT || type == GL_UNSIGNED_INT
                       ? std::string()
                       : "depth textures of type " + hexadecimal(type) + " need ES 3.0";
        case GL_SRGB_EXT:
        case GL_SRGB_ALPHA_EXT:
            if (!caps.srgb_textures) return "sRGB textures need ES 3.0 or GL_EXT_sRGB";
            break;
        default: return "format " + hexadecimal(format) + " needs ES 3.0";
    }
    switch (type) {
        case GL_UNSIGNED_BYTE:
        case GL_UNSIGNED_SHORT_5_6_5:
        case GL_UNSIGNED_SHORT_4_4_4_4:
        case GL_UNSIGNED_SHORT_5_5_5_1: return {};
        case GL_HALF_FLOAT_OES:
            if (caps.has_extension("GL_OES_texture_half_float")) return {};
            return "textures of type GL_HALF_FLOAT_OES need GL_OES_texture_half_float";
        case GL_FLOAT:
            if (caps.has_extension("GL_OES_texture_float")) return {};
            return "textures of type GL_FLOAT need ES 3.0 or GL_OES_texture_float";
        default: return "textures of type " + hexadecimal(type) + " need ES 3.0";
    }
}

template <>
struct ArgumentRule<Call::TexImage2D> {
    const Caps& caps;
    std::string operator()(GLenum target, GLint, GLint internal_format, GLsizei width, GLsizei height, GLint,
                           GLenum format, GLenum type, const void*) const {
        const bool cube = target >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && target <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z;
        const int limit = cube ? caps.max_cube_map_size : caps.max_texture_size;
        const int size = width > height ? width : height;
        if (size > limit) return over_limit("size", size, cube ? "max_cube_map_size" : "max_texture_size", limit);
        if (!caps.sized_formats) {
            return broken_unsized_rule(caps, static_cast<GLenum>(internal_format), format, type);
        }
        if (internal_format == GL_SRGB8_ALPHA8 && !caps.srgb_textures) return "sRGB textures are not granted";
        if (format == GL_DEPTH_COMPONENT && !caps.depth_texture) return "depth textures are not granted";
        // A core profile has no luminance and alpha textures, which every ES has.
        const bool legacy = format == GL_ALPHA || format == GL_LUMINANCE || format == GL_LUMINANCE_ALPHA;
        if (legacy && caps.core_profile)
            return "format " + hexadecimal(format) + " does not exist in a desktop core profile";
        return {};
    }
};

template <>
struct ArgumentRule<Call::CompressedTexImage2D> {
    const Caps& caps;
    std::string operator()(GLenum, GLint, GLenum internal_format, GLsizei width, GLsizei height, GLint, GLsizei,
                           const void*) const {
        const int size = width > height ? width : height;
        if (size > caps.max_texture_size) return over_limit("size", size, "max_texture_size", caps.max_texture_size);
        switch (internal_format) {
            case GL_COMPRESSED_RGB_S3TC_DXT1_EXT:
            case GL_COMPRESSED_RGBA_S3TC_DXT5_EXT:
                return caps.s3tc ? "" : "DXT textures need GL_EXT_texture_compression_s3tc";
            case GL_COMPRESSED_SRGB_S3TC_DXT1_EXT:
            case GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT:
                return caps.s3tc_srgb ? "" : "sRGB DXT textures need GL_EXT_texture_compression_s3tc_srgb";
            default: return "compressed format " + hexadecimal(internal_format) + " is none that halfframe uses";
        }
    }
};

template <>
struct ArgumentRule<Call::RenderbufferStorage> {
    const Caps& caps;
    std::string operator()(GLenum, GLenum internal_format, GLsizei width, GLsizei height) const {
        const int size = width > height ? width : height;
        if (size > caps.max_renderbuffer_size) {
            return over_limit("size", size, "max_renderbuffer_size", caps.max_renderbuffer_size);
        }
        const auto renders = [&](PixelFormat format) {
            return caps.renders[static_cast<std::size_t>(format)]
                       ? std::string()
                       : std::string("renderbuffers of format ") + name(format) + " do not render on this device";
        };
        switch (internal_format) {
            case GL_RGBA4:
            case GL_RGB5_A1:
            case GL_RGB565:
            case GL_DEPTH_COMPONENT16:
            case GL_STENCIL_INDEX8: return {};
            case GL_DEPTH_COMPONENT24: return renders(PixelFormat::depth24);
            case GL_RGBA16F: return renders(PixelFormat::rgba16f);
            case GL_RGBA32F: return renders(PixelFormat::rgba32f);
            case GL_R11F_G11F_B10F: return renders(PixelFormat::r11g11b10f);
            case GL_RGB10_A2: return renders(PixelFormat::rgb10_a2);
            case GL_RGBA8:
                if (caps.sized_formats || caps.has_extension("GL_OES_rgb8_rgba8")) return {};
                return "renderbuffers of format RGBA8 need ES 3.0 or GL_OES_rgb8_rgba8";
            default:
                return es30(caps) ? std::string()
                                  : "renderbuffer format " + hexadecimal(internal_format) + " needs ES 3.0";
        }
    }
};

template <>
struct ArgumentRule<Call::RenderbufferStorageMultisample> {
    const Caps& caps;
    std::string operator()(GLenum target, GLsizei samples, GLenum internal_format, GLsizei width,
                           GLsizei height) const {
        if (samples > caps.max_samples) return over_limit("samples", samples, "max_samples", caps.max_samples);
        return ArgumentRule<Call::RenderbufferStorage>{caps}(target, internal_format, width, height);
    }
};

}  // namespace halfframe::gl
