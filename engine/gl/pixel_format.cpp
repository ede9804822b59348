// Names, sizes and GL enumerants of the pixel formats.
#include "engine/gl/pixel_format.h"

#include <GLES3/gl3.h>

#include <GLES2/gl2ext.h>

#include <array>
#include <string>

#include "engine/error.h"

namespace halfframe::gl {
namespace {

struct Row {
    const char* name;
    int bytes;
    TransferFormat sized;
    TransferFormat unsized;
};

// The unsized column: ES 2.0 has no sized internal formats. R11F_G11F_B10F has no unsized form that ES 2.0 or its
// extensions know, so its row stays the sized one; caps never grant it there.
constexpr std::array<Row, kPixelFormatCount> kRows = {{
    {"RGBA32F", 16, {GL_RGBA32F, GL_RGBA, GL_FLOAT}, {GL_RGBA, GL_RGBA, GL_FLOAT}},
    {"RGBA16F", 8, {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT}, {GL_RGBA, GL_RGBA, GL_HALF_FLOAT_OES}},
    {"R11G11B10F",
     4,
     {GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV},
     {GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV}},
    {"RGB10_A2",
     4,
     {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV},
     {GL_RGBA, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV}},
    {"RGBA8", 4, {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, {GL_RGBA, GL_RGBA, GL_UNSIGNED_BYTE}},
    {"SRGB8_ALPHA8",
     4,
     {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE},
     {GL_SRGB_ALPHA_EXT, GL_SRGB_ALPHA_EXT, GL_UNSIGNED_BYTE}},
    {"DEPTH16",
     2,
     {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT},
     {GL_DEPTH_COMPONENT, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT}},
    // 24 bits, stored in 32 by every driver we know of; the four bytes are what a budget has to pay.
    {"DEPTH24",
     4,
     {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT},
     {GL_DEPTH_COMPONENT, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT}},
}};

const Row& row(PixelFormat format) {
    const auto index = static_cast<std::size_t>(format);
    expect(index < kRows.size(), [&] { return "there is no pixel format number " + std::to_string(index); });
    return kRows[index];
}

int channels(std::uint32_t format) {
    switch (format) {
        case GL_RGBA:
        case GL_RGBA_INTEGER:
        case GL_SRGB_ALPHA_EXT: return 4;
        case GL_RGB:
        case GL_SRGB_EXT: return 3;
        case GL_RG:
        case GL_LUMINANCE_ALPHA: return 2;
        case GL_RED:
        case GL_ALPHA:
        case GL_LUMINANCE:
        case GL_DEPTH_COMPONENT: return 1;
        default: return 0;
    }
}

/// Bytes of one pixel in client memory, or 0 for a combination that halfframe does not use.
std::uint64_t transfer_bytes_per_pixel(std::uint32_t format, std::uint32_t type) {
    const auto count = static_cast<std::uint64_t>(channels(format));
    switch (type) {
        case GL_UNSIGNED_BYTE: return count;
        case GL_UNSIGNED_SHORT:
        case GL_HALF_FLOAT:
        case GL_HALF_FLOAT_OES: return count * 2;
        case GL_UNSIGNED_INT:
        case GL_FLOAT: return count * 4;
        case GL_UNSIGNED_SHORT_5_6_5:
        case GL_UNSIGNED_SHORT_4_4_4_4:
        case GL_UNSIGNED_SHORT_5_5_5_1: return 2;
        case GL_UNSIGNED_INT_2_10_10_10_REV:
        case GL_UNSIGNED_INT_10F_11F_11F_REV:
        case GL_UNSIGNED_INT_24_8: return 4;
        default: return 0;
    }
}

}  // namespace

const char* name(PixelFormat format) { return row(format).name; }

int bytes_per_pixel(PixelFormat format) { return row(format).bytes; }

bool is_depth(PixelFormat format) { return format == PixelFormat::depth16 || format == PixelFormat::depth24; }

TransferFormat transfer_format(PixelFormat format, bool unsized) {
    return unsized ? row(format).unsized : row(format).sized;
}

std::uint64_t transfer_bytes(std::uint32_t format, std::uint32_t type, int width, int height, int row_alignment) {
    if (width <= 0 || height <= 0) return 0;
    const std::uint64_t row_bytes = static_cast<std::uint64_t>(width) * transfer_bytes_per_pixel(format, type);
    const auto alignment = static_cast<std::uint64_t>(row_alignment);
    const std::uint64_t row_stride = (row_bytes + alignment - 1) / alignment * alignment;
    // GL reads no padding behind the last row.
    return row_stride * (static_cast<std::uint64_t>(height) - 1) + row_bytes;
}

}  // namespace halfframe::gl
