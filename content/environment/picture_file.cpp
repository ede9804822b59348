// What every equirectangular file must hold, whatever its format.
#include "content/environment/equirectangular.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::content {
namespace {

/// What an infinite value becomes: the largest half, because it is mostly a half that overflowed.
constexpr float kInfinite = 65504.0f;
/// Radiance that no finite value exceeds: two hundred times the sun's disc in units where white paper in sunlight is 1
/// (pi / 6.8e-5 sr = 4.6e4), and small enough that no sum of ours leaves the range of float.
constexpr float kBrightest = 1e7f;

struct Mended {
    std::size_t not_numbers = 0;
    std::size_t infinite = 0;
    std::size_t negative = 0;
    std::size_t too_bright = 0;
};

float mended(float value, Mended& count) {
    if (std::isnan(value)) {
        ++count.not_numbers;
        return 0.0f;
    }
    if (value < 0.0f) {  // minus infinity too
        ++count.negative;
        return 0.0f;
    }
    if (std::isinf(value)) {
        ++count.infinite;
        return kInfinite;
    }
    if (value > kBrightest) {
        ++count.too_bright;
        return kBrightest;
    }
    return value;
}

std::string ending_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    return ending;
}

}  // namespace

void expect_equirectangular(long long width, long long height, const std::string& file) {
    if (width <= 0 || height <= 0) {
        throw Error(Fault::input, fmt::format("{}: is {} x {} pixels; export the picture again", file, width, height));
    }
    if (width != 2 * height) {
        throw Error(Fault::input,
                    fmt::format("{}: is {} x {} pixels, but an equirectangular picture is twice as wide as high; "
                                "convert the environment to equirectangular (also called lat-long), or crop it",
                                file, width, height));
    }
    if (width > kMostPictureWidth) {
        throw Error(Fault::input, fmt::format("{}: is {} pixels wide, more than the {} that are read; 1024 is enough",
                                              file, width, kMostPictureWidth));
    }
}

Equirectangular decode_equirectangular(std::string_view bytes, const std::filesystem::path& file,
                                       std::vector<std::string>& notices) {
    const std::string name = file.string();
    const std::string ending = ending_of(file);
    if (bytes.empty()) {
        throw Error(Fault::input, fmt::format("{}: is empty; copy or export it again", name));
    }
    RawPicture raw = ending == ".exr" ? decode_exr(bytes, name) : decode_hdr(bytes, name);
    expect(raw.pixels.size() == static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height),
           "a decoder gives as many pixels as it says");

    Mended count;
    bool all_black = true;
    for (glm::vec3& pixel : raw.pixels) {
        pixel = {mended(pixel.r, count), mended(pixel.g, count), mended(pixel.b, count)};
        all_black = all_black && pixel == glm::vec3(0.0f);
    }
    if (count.not_numbers + count.infinite + count.negative + count.too_bright > 0) {
        notices.push_back(
            fmt::format("values mended: {} NaN and {} negative to 0, {} infinite to {}, {} over {} to that",
                        count.not_numbers, count.negative, count.infinite, kInfinite, count.too_bright, kBrightest));
    }
    if (all_black) {
        notices.emplace_back("every pixel is black: the environment gives no light");
    }
    return {raw.width, raw.height, std::move(raw.pixels)};
}

}  // namespace halfframe::content
