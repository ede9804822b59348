// Reads a context's abilities, and makes them poorer. One file: each ability's two conditions, native and masked, are
// to be read together.
#include "engine/gl/caps.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "engine/error.h"
#include "engine/gl/call_number.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"

namespace halfframe::gl {
namespace {

constexpr GLenum kContextProfileMask = 0x9126;  // desktop GL 3.2
constexpr GLint kContextCoreProfileBit = 0x1;   // desktop GL 3.2
constexpr int kDesktopFirstWithEs2Text = 41;    // desktop GL 4.1 contains ARB_ES2_compatibility
constexpr int kDesktopFirstWithEs3Text = 43;    // desktop GL 4.3 contains ARB_ES3_compatibility

std::string get_string(EntryPoints& gl, GLenum pname) {
    const auto* text = reinterpret_cast<const char*>(gl.GetString(pname));
    return text != nullptr ? text : "";
}

int get_integer(EntryPoints& gl, GLenum pname) {
    GLint value = 0;
    gl.GetIntegerv(pname, &value);
    return value;
}

/// Errors of before are not ours, and ours must not be seen by who comes after. A lost context answers for ever: stop.
void forget_errors(EntryPoints& gl) {
    for (int i = 0; i < 16 && gl.GetError() != GL_NO_ERROR; ++i) {}
}

struct Version {
    bool desktop = false;
    int number = 0;  ///< 10 * major + minor
};

/// "OpenGL ES 3.2 Mesa 22.3.6", or "4.5 (Core Profile) Mesa 22.3.6" of a desktop context.
Version parse_version(const std::string& text) {
    constexpr std::string_view kPrefix = "OpenGL ES ";
    Version version;
    version.desktop = !text.starts_with(kPrefix);
    const std::string_view digits = std::string_view(text).substr(version.desktop ? 0 : kPrefix.size());
    int major = 0;
    int minor = 0;
    const auto first = std::from_chars(digits.data(), digits.data() + digits.size(), major);
    const bool dotted = first.ec == std::errc() && first.ptr != digits.data() + digits.size() && *first.ptr == '.';
    const auto second = dotted ? std::from_chars(first.ptr + 1, digits.data() + digits.size(), minor) : first;
    if (!dotted || second.ec != std::errc()) {
        throw Error(Fault::context,
                    "GL_VERSION is \"" + text + "\", which names no version: try another context or driver");
    }
    version.number = 10 * major + minor;
    return version;
}

std::vector<std::string> read_extensions(EntryPoints& gl, bool indexed) {
    std::vector<std::string> extensions;
    if (indexed) {
        const int count = get_integer(gl, GL_NUM_EXTENSIONS);
        for (int i = 0; i < count; ++i) {
            const auto* text = reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
            if (text != nullptr) extensions.emplace_back(text);
        }
    } else {
        const std::string all = get_string(gl, GL_EXTENSIONS);
        for (std::size_t begin = 0; begin < all.size();) {
            const std::size_t end = std::min(all.find(' ', begin), all.size());
            if (end > begin) extensions.push_back(all.substr(begin, end - begin));
            begin = end + 1;
        }
    }
    std::sort(extensions.begin(), extensions.end());
    extensions.erase(std::unique(extensions.begin(), extensions.end()), extensions.end());
    return extensions;
}

PrecisionFormat read_precision(EntryPoints& gl, GLenum stage, GLenum precision) {
    GLint range[2] = {0, 0};
    GLint bits = 0;
    gl.GetShaderPrecisionFormat(stage, precision, range, &bits);
    return {range[0], range[1], bits};
}

void read_limits(EntryPoints& gl, Caps& caps) {
    caps.max_texture_size = get_integer(gl, GL_MAX_TEXTURE_SIZE);
    caps.max_cube_map_size = get_integer(gl, GL_MAX_CUBE_MAP_TEXTURE_SIZE);
    caps.max_renderbuffer_size = get_integer(gl, GL_MAX_RENDERBUFFER_SIZE);
    caps.max_vertex_attributes = get_integer(gl, GL_MAX_VERTEX_ATTRIBS);
    caps.max_vertex_uniform_vectors = get_integer(gl, GL_MAX_VERTEX_UNIFORM_VECTORS);
    caps.max_fragment_uniform_vectors = get_integer(gl, GL_MAX_FRAGMENT_UNIFORM_VECTORS);
    caps.max_varying_vectors = get_integer(gl, GL_MAX_VARYING_VECTORS);
    caps.max_fragment_samplers = get_integer(gl, GL_MAX_TEXTURE_IMAGE_UNITS);
    caps.max_vertex_samplers = get_integer(gl, GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS);
    caps.max_combined_samplers = get_integer(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    const bool later = caps.es_version >= 30 || caps.desktop;
    if (later || caps.has_extension("GL_EXT_draw_buffers"))
        caps.max_draw_buffers = get_integer(gl, GL_MAX_DRAW_BUFFERS);
    if (later) caps.max_samples = get_integer(gl, GL_MAX_SAMPLES);
    if (later || caps.has_extension("GL_OES_texture_3D"))
        caps.max_texture_3d_size = get_integer(gl, GL_MAX_3D_TEXTURE_SIZE);
}

void read_abilities(EntryPoints& gl, Caps& caps, const Version& version) {
    const bool es3 = caps.es_version >= 30;
    const auto has = [&](const char* extension) { return caps.has_extension(extension); };
    const auto desktop_since = [&](int number) { return version.desktop && version.number >= number; };
    const auto loaded = [&](Call call) { return gl.loaded(number(call)); };

    caps.explicit_lod = es3 || has("GL_EXT_shader_texture_lod");
    caps.derivatives = es3 || has("GL_OES_standard_derivatives");
    caps.index_uint = es3 || caps.desktop || has("GL_OES_element_index_uint");
    caps.vertex_array_objects =
        loaded(Call::GenVertexArrays) && (es3 || desktop_since(30) || has("GL_OES_vertex_array_object"));
    caps.sized_formats = es3 || caps.desktop;
    caps.srgb_textures = es3 || caps.desktop || has("GL_EXT_sRGB");
    caps.depth_texture = es3 || caps.desktop || has("GL_OES_depth_texture");
    caps.npot_textures = es3 || caps.desktop || has("GL_OES_texture_npot");
    const bool binary_calls = es3 || desktop_since(41) || has("GL_OES_get_program_binary");
    caps.program_binary =
        binary_calls && loaded(Call::ProgramBinary) && get_integer(gl, GL_NUM_PROGRAM_BINARY_FORMATS) > 0;
    caps.fence_sync = loaded(Call::FenceSync) && (es3 || desktop_since(32));
    caps.timer_query = loaded(Call::GetQueryObjectui64v) && (desktop_since(33) || has("GL_EXT_disjoint_timer_query"));
    caps.samples_passed = loaded(Call::GetQueryObjectui64v) && desktop_since(33);
    caps.debug_labels = loaded(Call::ObjectLabel) &&
                        (has("GL_KHR_debug") || desktop_since(43) || (!version.desktop && version.number >= 32));
    caps.float_blend = version.desktop || has("GL_EXT_float_blend");
    caps.anisotropy = has("GL_EXT_texture_filter_anisotropic") || has("GL_ARB_texture_filter_anisotropic");
    // Desktop drivers and ES ones write the name alike.
    caps.s3tc = has("GL_EXT_texture_compression_s3tc") && loaded(Call::CompressedTexImage2D);
    caps.s3tc_srgb = caps.s3tc && (has("GL_EXT_texture_compression_s3tc_srgb") || has("GL_EXT_texture_sRGB"));
    caps.discard_framebuffer = loaded(Call::InvalidateFramebuffer) && (es3 || desktop_since(43));
}

/// Is the format of a colour target accepted, cleared to what was asked for, and read back the same?
bool color_format_renders(EntryPoints& gl, const Caps& caps, PixelFormat format) {
    const bool is_float =
        format == PixelFormat::rgba32f || format == PixelFormat::rgba16f || format == PixelFormat::r11g11b10f;
    const bool unsized = !caps.sized_formats;
    if (unsized && (format == PixelFormat::r11g11b10f || format == PixelFormat::rgb10_a2)) return false;
    constexpr int kSize = 4;                       // pixels
    const float wanted = is_float ? 2.5F : 0.25F;  // 2.5 is exact in every float format, and out of reach of the others
    const Texture texture = create<Kind::texture>(gl);
    const Framebuffer framebuffer = create<Kind::framebuffer>(gl);
    const TransferFormat transfer = transfer_format(format, unsized);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(transfer.internal_format), kSize, kSize, 0, transfer.format,
                  transfer.type, nullptr);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    bool renders = gl.GetError() == GL_NO_ERROR && gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (renders) {
        gl.ClearColor(wanted, wanted, wanted, 1.0F);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        float red = -1.0F;
        if (is_float) {
            float pixel[4] = {-1.0F, -1.0F, -1.0F, -1.0F};
            gl.ReadPixels(1, 1, 1, 1, GL_RGBA, GL_FLOAT, pixel);
            red = pixel[0];
        } else {
            std::uint8_t pixel[4] = {0, 0, 0, 0};
            gl.ReadPixels(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
            red = static_cast<float>(pixel[0]) / 255.0F;
        }
        // 4e-3: one step of eight bits; float formats hold 2.5 exactly.
        renders = gl.GetError() == GL_NO_ERROR && std::abs(red - wanted) < (is_float ? 1e-6F : 4e-3F);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    forget_errors(gl);
    return renders;
}

/// Does a depth renderbuffer of this format make a complete framebuffer together with an RGBA8 texture?
bool depth_format_renders(EntryPoints& gl, const Caps& caps, PixelFormat format) {
    const bool granted = format == PixelFormat::depth16 || caps.sized_formats || caps.has_extension("GL_OES_depth24");
    if (!granted) return false;
    constexpr int kSize = 4;  // pixels
    const Texture texture = create<Kind::texture>(gl);
    const Renderbuffer depth = create<Kind::renderbuffer>(gl);
    const Framebuffer framebuffer = create<Kind::framebuffer>(gl);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, kSize, kSize, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth.name());
    // The sized form, also in ES 2.0: renderbuffers always had it.
    gl.RenderbufferStorage(GL_RENDERBUFFER, transfer_format(format, false).internal_format, kSize, kSize);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
    const bool renders =
        gl.GetError() == GL_NO_ERROR && gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    forget_errors(gl);
    return renders;
}

void probe_formats(EntryPoints& gl, Caps& caps) {
    gl.Disable(GL_SCISSOR_TEST);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (int index = 0; index < kPixelFormatCount; ++index) {
        const auto format = static_cast<PixelFormat>(index);
        // SRGB8_ALPHA8 is a texture format here and never a target, whatever the driver could do with it.
        if (format == PixelFormat::srgb8_alpha8) continue;
        caps.renders[static_cast<std::size_t>(index)] =
            is_depth(format) ? depth_format_renders(gl, caps, format) : color_format_renders(gl, caps, format);
    }
    gl.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
}

/// The driver lists the numbers of samples from the most to the fewest; the first is asked for.
void read_samples(EntryPoints& gl, Caps& caps) {
    if (caps.es_version < 30 || !gl.loaded(number(Call::GetInternalformativ))) return;
    for (std::size_t index = 0; index < caps.samples.size(); ++index) {
        if (!caps.renders[index]) continue;
        GLint most = 0;
        gl.GetInternalformativ(GL_RENDERBUFFER, transfer_format(static_cast<PixelFormat>(index), false).internal_format,
                               GL_SAMPLES, 1, &most);
        if (gl.GetError() == GL_NO_ERROR) caps.samples[index] = std::min(most, caps.max_samples);
    }
}

/// What a profile lets through: extensions and the abilities that hang on them.
class Mask {
public:
    Mask(const Caps& caps, const DeviceProfile& profile) : caps_(caps), profile_(profile) {}

    /// Extensions the profile keeps; without a list, those of the machine.
    [[nodiscard]] bool grants(const char* extension) const {
        if (!profile_.extensions) return caps_.has_extension(extension);
        return std::find(profile_.extensions->begin(), profile_.extensions->end(), extension) !=
               profile_.extensions->end();
    }
    /// An ability that is core in ES 3.0 and that `extension` brings to ES 2.0.
    [[nodiscard]] bool keeps(bool ability, const char* extension) const {
        return ability && (profile_.es_version >= 30 || grants(extension));
    }
    /// As grants(), for what the machine must list itself because it is not core anywhere here.
    [[nodiscard]] bool has(const char* extension) const { return caps_.has_extension(extension) && grants(extension); }

private:
    const Caps& caps_;
    const DeviceProfile& profile_;
};

void lower(int& limit, const std::optional<int>& profile_limit) {
    if (profile_limit) limit = std::min(limit, *profile_limit);
}

void mask_limits(Caps& caps, const Mask& mask, const DeviceProfile& profile) {
    if (caps.es_version < 30) {
        if (!mask.has("GL_EXT_draw_buffers")) caps.max_draw_buffers = std::min(caps.max_draw_buffers, 1);
        if (!mask.has("GL_OES_texture_3D")) caps.max_texture_3d_size = 0;
        caps.max_samples = 0;
    }
    lower(caps.max_texture_size, profile.max_texture_size);
    lower(caps.max_cube_map_size, profile.max_cube_map_size);
    lower(caps.max_renderbuffer_size, profile.max_renderbuffer_size);
    lower(caps.max_vertex_attributes, profile.max_vertex_attributes);
    lower(caps.max_vertex_uniform_vectors, profile.max_vertex_uniform_vectors);
    lower(caps.max_fragment_uniform_vectors, profile.max_fragment_uniform_vectors);
    lower(caps.max_varying_vectors, profile.max_varying_vectors);
    lower(caps.max_fragment_samplers, profile.max_fragment_samplers);
    lower(caps.max_vertex_samplers, profile.max_vertex_samplers);
    lower(caps.max_combined_samplers, profile.max_combined_samplers);
    lower(caps.max_draw_buffers, profile.max_draw_buffers);
    lower(caps.max_samples, profile.max_samples);
    lower(caps.max_texture_3d_size, profile.max_texture_3d_size);
    if (profile.max_texture_bytes)
        caps.max_texture_bytes =
            std::min(caps.max_texture_bytes.value_or(*profile.max_texture_bytes), *profile.max_texture_bytes);
    caps.prefers_s3tc = profile.prefers_s3tc.value_or(caps.prefers_s3tc);
}

void mask_abilities(Caps& caps, const Mask& mask) {
    const bool es3 = caps.es_version >= 30;
    caps.explicit_lod = mask.keeps(caps.explicit_lod, "GL_EXT_shader_texture_lod");
    caps.derivatives = mask.keeps(caps.derivatives, "GL_OES_standard_derivatives");
    caps.index_uint = mask.keeps(caps.index_uint, "GL_OES_element_index_uint");
    caps.vertex_array_objects = mask.keeps(caps.vertex_array_objects, "GL_OES_vertex_array_object");
    caps.srgb_textures = mask.keeps(caps.srgb_textures, "GL_EXT_sRGB");
    caps.depth_texture = mask.keeps(caps.depth_texture, "GL_OES_depth_texture");
    caps.npot_textures = mask.keeps(caps.npot_textures, "GL_OES_texture_npot");
    caps.program_binary = mask.keeps(caps.program_binary, "GL_OES_get_program_binary");
    caps.anisotropy = caps.anisotropy && (mask.grants("GL_EXT_texture_filter_anisotropic") ||
                                          mask.grants("GL_ARB_texture_filter_anisotropic"));
    caps.s3tc = caps.s3tc && mask.grants("GL_EXT_texture_compression_s3tc");
    caps.s3tc_srgb = caps.s3tc_srgb && caps.s3tc;
    caps.sized_formats = caps.sized_formats && es3;
    caps.discard_framebuffer = caps.discard_framebuffer && es3;
    // fence_sync, timer_query, samples_passed and debug_labels stay as the machine has them: they measure and label the
    // frame here, and are no part of how the imitated device would draw it.
}

void mask_formats(Caps& caps, const Mask& mask, const DeviceProfile& profile) {
    const auto keep_if = [&](PixelFormat format, bool keep) {
        bool& renders = caps.renders[static_cast<std::size_t>(format)];
        renders = renders && keep;
    };
    // A desktop context blends them without an extension to its name.
    caps.float_blend = caps.float_blend && (!profile.extensions || mask.grants("GL_EXT_float_blend"));
    // Float targets are core in ES 3.2 and an extension before. Without a list the machine's own finding stands.
    const bool core_float = caps.es_version >= 32 || !profile.extensions;
    const bool float_targets = core_float || mask.grants("GL_EXT_color_buffer_float");
    const bool half_targets = float_targets || mask.grants("GL_EXT_color_buffer_half_float");
    if (caps.es_version >= 30) {
        keep_if(PixelFormat::rgba32f, float_targets);
        keep_if(PixelFormat::r11g11b10f, float_targets);
        keep_if(PixelFormat::rgba16f, half_targets);
        return;
    }
    // ES 2.0: unsized half floats, which the machine itself must know by the extension's enumerant.
    const bool half_textures = mask.has("GL_OES_texture_half_float") && mask.has("GL_EXT_color_buffer_half_float");
    keep_if(PixelFormat::rgba32f, false);
    keep_if(PixelFormat::r11g11b10f, false);
    keep_if(PixelFormat::rgb10_a2, false);
    keep_if(PixelFormat::rgba16f, half_textures);
    keep_if(PixelFormat::depth24, mask.grants("GL_OES_depth24"));
}

}  // namespace

bool Caps::has_extension(const char* extension) const {
    const auto found =
        std::lower_bound(extensions.begin(), extensions.end(), extension,
                         [](const std::string& one, const char* other) { return one.compare(other) < 0; });
    return found != extensions.end() && *found == extension;
}

Caps read_caps(EntryPoints& gl) {
    forget_errors(gl);
    Caps caps;
    caps.renderer = get_string(gl, GL_RENDERER);
    caps.vendor = get_string(gl, GL_VENDOR);
    caps.version = get_string(gl, GL_VERSION);
    const Version version = parse_version(caps.version);
    caps.desktop = version.desktop;
    const bool indexed = gl.loaded(number(Call::GetStringi)) && version.number >= 30;
    caps.extensions = read_extensions(gl, indexed);
    if (!version.desktop) {
        caps.es_version = std::min(version.number, 32);
    } else if (version.number >= kDesktopFirstWithEs3Text || caps.has_extension("GL_ARB_ES3_compatibility")) {
        caps.es_version = 30;
    } else if (version.number >= kDesktopFirstWithEs2Text || caps.has_extension("GL_ARB_ES2_compatibility")) {
        caps.es_version = 20;
    } else {
        throw Error(Fault::context, "the desktop context \"" + caps.version +
                                        "\" does not run ES shaders: use an ES context, or GL 4.1 or later");
    }
    caps.core_profile =
        version.desktop && version.number >= 32 && (get_integer(gl, kContextProfileMask) & kContextCoreProfileBit) != 0;
    for (const char* rasteriser : {"llvmpipe", "softpipe", "SwiftShader", "Software Rasterizer"}) {
        caps.software = caps.software || caps.renderer.find(rasteriser) != std::string::npos;
    }
    caps.gathers_uniforms = caps.rasters_at_flush = caps.renderer.find("llvmpipe") != std::string::npos;
    caps.fragment_mediump = read_precision(gl, GL_FRAGMENT_SHADER, GL_MEDIUM_FLOAT);
    caps.fragment_highp_format = read_precision(gl, GL_FRAGMENT_SHADER, GL_HIGH_FLOAT);
    caps.fragment_highp = caps.fragment_highp_format.precision > 0;
    read_limits(gl, caps);
    read_abilities(gl, caps, version);
    forget_errors(gl);
    probe_formats(gl, caps);
    read_samples(gl, caps);
    forget_errors(gl);
    return caps;
}

Caps masked(const Caps& caps, const DeviceProfile& profile) {
    Caps poorer = caps;
    const Mask mask(caps, profile);
    poorer.device = profile.name;
    poorer.gathers_uniforms = false;  // what it imitates has no such driver, nor varyings to spare
    poorer.rasters_at_flush = false;  // and would pay for it: a tiler stores and loads its tiles at a flush
    poorer.es_version = std::min(caps.es_version, profile.es_version);
    if (profile.fragment_highp && !*profile.fragment_highp) {
        poorer.fragment_highp = false;
        poorer.fragment_highp_format = {};
    }
    std::erase_if(poorer.extensions, [&](const std::string& extension) { return !mask.grants(extension.c_str()); });
    mask_limits(poorer, mask, profile);
    mask_abilities(poorer, mask);
    mask_formats(poorer, mask, profile);
    for (std::size_t index = 0; index < poorer.samples.size(); ++index) {
        poorer.samples[index] = poorer.renders[index] ? std::min(poorer.samples[index], poorer.max_samples) : 0;
    }
    return poorer;
}

}  // namespace halfframe::gl
