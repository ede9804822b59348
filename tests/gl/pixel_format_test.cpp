// Pixel formats: sizes, and the bytes of transfers with their row padding.
#include "engine/gl/pixel_format.h"

#include <GLES3/gl3.h>

#include <GLES2/gl2ext.h>

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "engine/error.h"

namespace halfframe::gl {
namespace {

TEST(PixelFormat, NamesDiffer) {
    std::set<std::string> names;
    for (int i = 0; i < kPixelFormatCount; ++i) names.insert(name(static_cast<PixelFormat>(i)));
    EXPECT_EQ(names.size(), static_cast<std::size_t>(kPixelFormatCount));
    EXPECT_THROW((void)name(static_cast<PixelFormat>(kPixelFormatCount)), Mistake);
}

TEST(PixelFormat, SizedFormsMoveAsManyBytesAsTheyStore) {
    for (int i = 0; i < kPixelFormatCount; ++i) {
        const auto format = static_cast<PixelFormat>(i);
        const TransferFormat transfer = transfer_format(format, false);
        EXPECT_EQ(transfer_bytes(transfer.format, transfer.type, 1, 1, 1),
                  static_cast<std::uint64_t>(bytes_per_pixel(format)))
            << name(format);
    }
}

TEST(PixelFormat, UnsizedFormsAreThoseOfEs2) {
    const TransferFormat half = transfer_format(PixelFormat::rgba16f, true);
    EXPECT_EQ(half.internal_format, static_cast<std::uint32_t>(GL_RGBA));
    EXPECT_EQ(half.type, static_cast<std::uint32_t>(GL_HALF_FLOAT_OES));
    const TransferFormat srgb = transfer_format(PixelFormat::srgb8_alpha8, true);
    EXPECT_EQ(srgb.internal_format, srgb.format);
}

TEST(PixelFormat, RowsArePaddedButTheLastIsNot) {
    EXPECT_EQ(transfer_bytes(GL_RGB, GL_UNSIGNED_BYTE, 3, 2, 4), 12u + 9u);
    EXPECT_EQ(transfer_bytes(GL_RGB, GL_UNSIGNED_BYTE, 3, 2, 1), 18u);
    EXPECT_EQ(transfer_bytes(GL_RGBA, GL_HALF_FLOAT, 5, 5, 4), 200u);
    EXPECT_EQ(transfer_bytes(GL_RGBA, GL_FLOAT, 0, 5, 4), 0u);
}

}  // namespace
}  // namespace halfframe::gl
