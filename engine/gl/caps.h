// What a context can do, as plain fields read once, and the masks that make it poorer.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/gl/pixel_format.h"

namespace halfframe::gl {

class EntryPoints;

/// Range and precision of one shader precision qualifier, as glGetShaderPrecisionFormat gives it (log2 values).
struct PrecisionFormat {
    int range_min = 0;
    int range_max = 0;
    int precision = 0;  ///< fraction bits; 0 when the qualifier does not exist in that stage
};

/// Everything the engine asks of a context. Filled by read_caps(), made poorer by masked().
struct Caps {
    std::string renderer;
    std::string vendor;
    std::string version;
    std::string device = "native";  ///< name of the mask in force

    int es_version = 20;        ///< 20, 30, 31, 32: the ES version whose rules we follow here
    bool desktop = false;       ///< a desktop GL context that runs ES text (OSMesa, GL 4.5)
    bool core_profile = false;  ///< desktop core profile: a vertex array object must be bound
    bool software = false;      ///< a CPU rasteriser (llvmpipe, softpipe, SwiftShader)
    bool gathers_uniforms = false;  ///< llvmpipe: fragment uniforms are dear; engine/gl/uniforms_by_vertex.h
    bool rasters_at_flush = false;  ///< llvmpipe: a pass of many triangles is flushed; engine/frame/early_flush.h
    bool fragment_highp = true;
    PrecisionFormat fragment_mediump;
    PrecisionFormat fragment_highp_format;

    // Limits. The defaults are the ES 2.0 minimums.
    int max_texture_size = 64;
    int max_cube_map_size = 16;
    int max_renderbuffer_size = 1;
    int max_vertex_attributes = 8;
    int max_vertex_uniform_vectors = 128;
    int max_fragment_uniform_vectors = 16;
    int max_varying_vectors = 8;
    int max_fragment_samplers = 8;
    int max_vertex_samplers = 0;
    int max_combined_samplers = 8;
    int max_draw_buffers = 1;
    int max_samples = 0;
    int max_texture_3d_size = 0;                   ///< 0: no 3D textures
    std::optional<std::size_t> max_texture_bytes;  ///< of all textures of a scene together; empty: no limit

    // Abilities: true when core in es_version or brought by a named extension.
    bool explicit_lod = false;          ///< textureLod in fragments: ES 3.0 or EXT_shader_texture_lod
    bool derivatives = false;           ///< ES 3.0 or OES_standard_derivatives
    bool index_uint = false;            ///< ES 3.0 or OES_element_index_uint
    bool vertex_array_objects = false;  ///< ES 3.0 or OES_vertex_array_object
    bool sized_formats = false;         ///< ES 3.0: sized internal formats, sRGB textures, RGB10_A2
    bool srgb_textures = false;
    bool depth_texture = false;
    bool float_blend = false;  ///< blends into RGBA32F: EXT_float_blend, or desktop
    bool npot_textures = false;  ///< full use of non-power-of-two textures: ES 3.0 or OES_texture_npot
    bool program_binary = false;
    bool fence_sync = false;
    bool timer_query = false;     ///< EXT_disjoint_timer_query, or core on desktop
    bool samples_passed = false;  ///< exact GL_SAMPLES_PASSED: desktop only
    bool debug_labels = false;    ///< KHR_debug
    bool anisotropy = false;
    bool s3tc = false;                 ///< DXT1 and DXT5: EXT_texture_compression_s3tc
    bool s3tc_srgb = false;            ///< the same, decoded on fetch
    bool prefers_s3tc = false;         ///< a device profile asks for compressed colours
    bool discard_framebuffer = false;  ///< glInvalidateFramebuffer: ES 3.0

    /// Which formats really render: each was drawn to and read back once when the caps were read.
    std::array<bool, kPixelFormatCount> renders{};
    /// Most samples a pixel of a renderbuffer of that format may have; 0: the format is not multisampled here.
    std::array<int, kPixelFormatCount> samples{};

    std::vector<std::string> extensions;  ///< sorted; what the mask lets through

    [[nodiscard]] bool has_extension(const char* extension) const;
};

/// A device to imitate: content/devices/*.json. An empty optional means "as the machine has it".
/// A mask only ever takes away: a limit above the machine's own stays the machine's.
struct DeviceProfile {
    std::string name;
    std::string source;  ///< where the figures come from
    int es_version = 20;
    std::optional<bool> fragment_highp;
    std::optional<std::vector<std::string>> extensions;  ///< those that stay; empty optional: all stay

    std::optional<int> max_texture_size;
    std::optional<int> max_cube_map_size;
    std::optional<int> max_renderbuffer_size;
    std::optional<int> max_vertex_attributes;
    std::optional<int> max_vertex_uniform_vectors;
    std::optional<int> max_fragment_uniform_vectors;
    std::optional<int> max_varying_vectors;
    std::optional<int> max_fragment_samplers;
    std::optional<int> max_vertex_samplers;
    std::optional<int> max_combined_samplers;
    std::optional<int> max_draw_buffers;
    std::optional<int> max_samples;
    std::optional<int> max_texture_3d_size;
    std::optional<std::size_t> max_texture_bytes;  ///< of all textures of a scene together, mip levels included
    std::optional<bool> prefers_s3tc;              ///< colours are compressed where the machine can
};

/// Reads everything once from the current context, and draws to each format to see whether it really renders.
/// Leaves no GL object and no GL error behind.
[[nodiscard]] Caps read_caps(EntryPoints& gl);

/// `caps` as if the machine were the poorer `profile`. Pure.
[[nodiscard]] Caps masked(const Caps& caps, const DeviceProfile& profile);

}  // namespace halfframe::gl
