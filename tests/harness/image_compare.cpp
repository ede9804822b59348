// Pixel loops and the PNG writer of the tests.
#include "tests/harness/image_compare.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <stb/stb_image_write.h>
#include <unistd.h>

namespace halfframe::harness {
namespace {

std::size_t pixel_count(const Picture& picture) {
    return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

bool whole(const Picture& picture) {
    return picture.width > 0 && picture.height > 0 && picture.rgba.size() == pixel_count(picture) * 4;
}

/// Largest channel difference of one pixel.
int pixel_error(const std::uint8_t* a, const std::uint8_t* b) {
    int error = 0;
    for (int channel = 0; channel < 4; ++channel) error = std::max(error, std::abs(a[channel] - b[channel]));
    return error;
}

testing::AssertionResult failed(const Picture& actual, const Picture& expected, const std::string& name,
                                const std::string& why) {
    if (!whole(actual) || !whole(expected)) return testing::AssertionFailure() << name << ": " << why;
    const std::filesystem::path base = image_folder() / name;
    write_png(base.string() + ".actual.png", actual);
    write_png(base.string() + ".expected.png", expected);
    if (actual.width == expected.width && actual.height == expected.height) {
        write_png(base.string() + ".difference.png", difference_picture(actual, expected));
    }
    return testing::AssertionFailure() << name << ": " << why << "; see " << base.string() << ".*.png";
}

}  // namespace

ImageDifference difference(const Picture& a, const Picture& b, int tolerated) {
    ImageDifference result;
    result.same_size = whole(a) && whole(b) && a.width == b.width && a.height == b.height;
    if (!result.same_size) return result;
    std::size_t bad = 0;
    for (std::size_t pixel = 0; pixel < pixel_count(a); ++pixel) {
        const int error = pixel_error(&a.rgba[pixel * 4], &b.rgba[pixel * 4]);
        if (error > tolerated) ++bad;
        if (error > result.max_channel_error) {
            result.max_channel_error = error;
            result.worst_x = static_cast<int>(pixel % static_cast<std::size_t>(a.width));
            result.worst_y = static_cast<int>(pixel / static_cast<std::size_t>(a.width));
        }
    }
    result.bad_fraction = static_cast<double>(bad) / static_cast<double>(pixel_count(a));
    return result;
}

testing::AssertionResult same_picture(const Picture& actual, const Picture& expected, const std::string& name) {
    return similar_picture(actual, expected, {}, name);
}

testing::AssertionResult similar_picture(const Picture& actual, const Picture& expected,
                                         const ImageTolerance& tolerance, const std::string& name) {
    const ImageDifference found = difference(actual, expected);
    if (!found.same_size) {
        return failed(actual, expected, name,
                      fmt::format("{}x{} with {} bytes against {}x{} with {} bytes", actual.width, actual.height,
                                  actual.rgba.size(), expected.width, expected.height, expected.rgba.size()));
    }
    if (found.max_channel_error <= tolerance.max_channel_error && found.bad_fraction <= tolerance.max_bad_fraction) {
        return testing::AssertionSuccess();
    }
    return failed(actual, expected, name,
                  fmt::format("max_channel_error {} (allowed {}) at {},{}; bad_fraction {:.6f} (allowed {:.6f})",
                              found.max_channel_error, tolerance.max_channel_error, found.worst_x, found.worst_y,
                              found.bad_fraction, tolerance.max_bad_fraction));
}

double coverage(const Picture& picture, const std::uint8_t (&background)[4], int tolerated) {
    if (!whole(picture)) return 0.0;
    std::size_t covered = 0;
    for (std::size_t pixel = 0; pixel < pixel_count(picture); ++pixel) {
        if (pixel_error(&picture.rgba[pixel * 4], background) > tolerated) ++covered;
    }
    return static_cast<double>(covered) / static_cast<double>(pixel_count(picture));
}

double coverage(const Picture& picture, int tolerated) {
    if (!whole(picture)) return 0.0;
    const std::uint8_t corner[4] = {picture.rgba[0], picture.rgba[1], picture.rgba[2], picture.rgba[3]};
    return coverage(picture, corner, tolerated);
}

Picture difference_picture(const Picture& a, const Picture& b) {
    if (!difference(a, b).same_size) throw std::invalid_argument("difference_picture: the pictures differ in size");
    Picture result = a;
    for (std::size_t index = 0; index < a.rgba.size(); ++index) {
        const int error = std::abs(a.rgba[index] - b.rgba[index]);
        result.rgba[index] = static_cast<std::uint8_t>(index % 4 == 3 ? 255 : std::min(255, error * 8));
    }
    return result;
}

std::filesystem::path image_folder() { return std::filesystem::path(HALFFRAME_BINARY_DIR) / "test_images"; }

void write_png(const std::filesystem::path& file, const Picture& picture) {
    if (!whole(picture)) throw std::runtime_error(file.string() + ": the picture is empty or its data is cut off");
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    // Tests run at the same time: the name beside it holds the process.
    const std::string beside = file.string() + "." + std::to_string(getpid()) + ".tmp";
    const bool written = stbi_write_png(beside.c_str(), picture.width, picture.height, 4, picture.rgba.data(), 0) != 0;
    std::error_code problem;
    if (written) std::filesystem::rename(beside, file, problem);
    if (!written || problem)
        throw std::runtime_error(file.string() + ": cannot be written; is the build folder writable?");
}

}  // namespace halfframe::harness
