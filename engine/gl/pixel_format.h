// The target and texture formats halfframe knows, and what each costs in memory.
#pragma once

#include <cstdint>

namespace halfframe::gl {

/// Formats of targets and textures. The order of the colour formats is the storage ladder, highest first.
enum class PixelFormat : std::uint8_t {
    rgba32f,
    rgba16f,
    r11g11b10f,
    rgb10_a2,
    rgba8,
    srgb8_alpha8,  ///< textures only: sRGB-decoded on fetch
    depth16,
    depth24,
};

inline constexpr int kPixelFormatCount = 8;

/// "RGBA16F" and so on, as printed in plans and reports.
[[nodiscard]] const char* name(PixelFormat format);

/// Bytes of one pixel, without padding.
[[nodiscard]] int bytes_per_pixel(PixelFormat format);

[[nodiscard]] bool is_depth(PixelFormat format);

/// The three enumerants of glTexImage2D.
struct TransferFormat {
    std::uint32_t internal_format;
    std::uint32_t format;
    std::uint32_t type;
};

/// `unsized` is the ES 2.0 form, where the internal format equals the format (and half floats are GL_HALF_FLOAT_OES).
[[nodiscard]] TransferFormat transfer_format(PixelFormat format, bool unsized);

/// Bytes that glTexImage2D or glReadPixels moves in client memory, row padding included and none behind the last row.
/// `row_alignment`: GL_UNPACK_ALIGNMENT or GL_PACK_ALIGNMENT (4 unless set). 0 for a format and type unknown here.
[[nodiscard]] std::uint64_t transfer_bytes(std::uint32_t format, std::uint32_t type, int width, int height,
                                           int row_alignment);

}  // namespace halfframe::gl
