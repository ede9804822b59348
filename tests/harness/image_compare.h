// Compares pictures: exactly, or by two numbers; counts coverage; shows what differs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "engine/frame/image.h"

namespace halfframe::harness {

/// How two pictures of one size differ. All four channels count.
struct ImageDifference {
    bool same_size = false;
    int max_channel_error = 0;  ///< largest difference of one channel, 0..255
    double bad_fraction = 0.0;  ///< pixels with a channel beyond `tolerated`, as a share of all, 0..1
    int worst_x = 0;            ///< a pixel with the largest error, from the left and the top
    int worst_y = 0;
    [[nodiscard]] bool exact() const { return same_size && max_channel_error == 0; }
};

/// `tolerated`: channel errors up to this are not bad [1/255]. It changes bad_fraction alone.
[[nodiscard]] ImageDifference difference(const Picture& a, const Picture& b, int tolerated = 0);

/// The limits of a comparison that is not exact. State the cause of both beside the use.
struct ImageTolerance {
    int max_channel_error = 0;      ///< no channel may differ more [1/255]
    double max_bad_fraction = 0.0;  ///< at most this share of pixels may differ at all, 0..1
};

/// Success, or a failure that names the worst pixel. A failure writes NAME.expected.png, NAME.actual.png and
/// NAME.difference.png to image_folder() and says so.
[[nodiscard]] testing::AssertionResult same_picture(const Picture& actual, const Picture& expected,
                                                    const std::string& name);
[[nodiscard]] testing::AssertionResult similar_picture(const Picture& actual, const Picture& expected,
                                                       const ImageTolerance& tolerance, const std::string& name);

/// Share of pixels whose colour differs from `background` by more than `tolerated` in a channel, 0..1.
[[nodiscard]] double coverage(const Picture& picture, const std::uint8_t (&background)[4], int tolerated = 0);
/// As above; the background is the colour of the top left pixel. 0 says that the picture is one flat colour.
[[nodiscard]] double coverage(const Picture& picture, int tolerated = 0);

/// The channel differences, brightened 8 times so that one step is visible; opaque.
[[nodiscard]] Picture difference_picture(const Picture& a, const Picture& b);

/// Where pictures of failed comparisons go: <build>/test_images.
[[nodiscard]] std::filesystem::path image_folder();
/// Writes an 8-bit PNG beside its name first, then renames it. Throws std::runtime_error naming the file.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace halfframe::harness
