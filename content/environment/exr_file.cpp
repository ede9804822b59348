// Reads OpenEXR through tinyexr, behind checks of our own: tinyexr 1.0.1 believes the sizes in a header.
#include "content/environment/equirectangular.h"

#include <cstdlib>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <tinyexr.h>

#include "engine/error.h"

namespace halfframe::content {
namespace {

const unsigned char* bytes_of(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

[[noreturn]] void fail(const std::string& file, const char* words) {
    const std::string what = words != nullptr ? words : "it is no OpenEXR file, or it was cut off";
    FreeEXRErrorMessage(words);
    std::string line;  // tinyexr ends its sentences with line feeds
    for (const char c : what) line += c == '\n' ? ' ' : c;
    while (line.ends_with(' ') || line.ends_with('.')) line.pop_back();
    throw Error(Fault::input,
                fmt::format("{}: cannot be read as OpenEXR: {}; export it again as one part with R, G and "
                            "B, scan lines, ZIP",
                            file, line));
}

/// A header that is freed again.
struct Header {
    EXRHeader value{};
    Header() { InitEXRHeader(&value); }
    Header(const Header&) = delete;
    Header& operator=(const Header&) = delete;
    ~Header() { FreeEXRHeader(&value); }
};

/// What tinyexr takes on trust.
void check_header(std::string_view bytes, const std::string& file) {
    EXRVersion version{};
    if (ParseEXRVersionFromMemory(&version, bytes_of(bytes), bytes.size()) != TINYEXR_SUCCESS) fail(file, nullptr);
    if (version.multipart != 0 || version.non_image != 0) {
        throw Error(Fault::input,
                    fmt::format("{}: has several parts or deep pixels; export it as one flat part", file));
    }
    Header header;
    const char* words = nullptr;
    if (ParseEXRHeaderFromMemory(&header.value, &version, bytes_of(bytes), bytes.size(), &words) != TINYEXR_SUCCESS) {
        fail(file, words);
    }
    const EXRBox2i& window = header.value.data_window;
    expect_equirectangular(static_cast<long long>(window.max_x) - window.min_x + 1,
                           static_cast<long long>(window.max_y) - window.min_y + 1, file);
    // An environment has 3 or 4; a render with all its layers has tens, and each takes 134 MB at the largest size.
    if (header.value.num_channels < 1 || header.value.num_channels > 8) {
        throw Error(Fault::input,
                    fmt::format("{}: has {} channels; export R, G and B alone", file, header.value.num_channels));
    }
    for (int i = 0; i < header.value.num_channels; ++i) {
        if (header.value.channels[i].x_sampling != 1 || header.value.channels[i].y_sampling != 1) {
            throw Error(Fault::input, fmt::format("{}: channel {} has fewer pixels than the picture; export R, G and B",
                                                  file, header.value.channels[i].name));
        }
    }
    if (header.value.tiled != 0 && (header.value.tile_size_x > kMostPictureWidth || header.value.tile_size_x < 1 ||
                                    header.value.tile_size_y > kMostPictureWidth || header.value.tile_size_y < 1)) {
        throw Error(Fault::input, fmt::format("{}: has tiles of {} x {}; export it in scan lines", file,
                                              header.value.tile_size_x, header.value.tile_size_y));
    }
}

}  // namespace

RawPicture decode_exr(std::string_view bytes, const std::string& file) {
    check_header(bytes, file);
    float* rgba = nullptr;
    RawPicture picture;
    const char* words = nullptr;
    const int result = LoadEXRFromMemory(&rgba, &picture.width, &picture.height, bytes_of(bytes), bytes.size(), &words);
    const std::unique_ptr<float, decltype(&std::free)> owner(rgba, &std::free);
    if (result != TINYEXR_SUCCESS || rgba == nullptr) fail(file, words);
    expect_equirectangular(picture.width, picture.height, file);
    const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    picture.pixels.reserve(count);
    for (std::size_t i = 0; i < count; ++i) picture.pixels.emplace_back(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]);
    return picture;
}

}  // namespace halfframe::content
