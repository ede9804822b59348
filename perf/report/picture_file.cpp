// PNG through stb_image_write, EXR through tinyexr, both encoded in memory.
#include "perf/report/picture_file.h"

#include <array>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#include <tinyexr.h>

#include "engine/error.h"
#include "perf/report/atomic_file.h"

namespace halfframe::perf {
namespace {

std::size_t pixel_count(int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void append(void* bytes, void* data, int size) {
    auto& target = *static_cast<std::vector<std::uint8_t>*>(bytes);
    const auto* first = static_cast<const std::uint8_t*>(data);
    target.insert(target.end(), first, first + size);
}

/// One plane a channel, in the order of the file: EXR readers expect channels sorted by name.
std::vector<std::vector<float>> planes_abgr(const FloatPicture& picture) {
    const std::size_t count = pixel_count(picture.width, picture.height);
    std::vector<std::vector<float>> planes(4, std::vector<float>(count));
    for (std::size_t pixel = 0; pixel < count; ++pixel) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
            planes[3 - channel][pixel] = picture.rgba[4 * pixel + channel];
        }
    }
    return planes;
}

}  // namespace

std::vector<std::uint8_t> png_bytes(const Picture& picture) {
    const std::size_t count = pixel_count(picture.width, picture.height);
    expect(count > 0 && picture.rgba.size() == 4 * count, "a picture has 4 bytes a pixel and is not empty");
    std::vector<std::uint8_t> rgb(3 * count);
    for (std::size_t pixel = 0; pixel < count; ++pixel) {
        std::memcpy(&rgb[3 * pixel], &picture.rgba[4 * pixel], 3);
    }
    std::vector<std::uint8_t> bytes;
    const int written =
        stbi_write_png_to_func(append, &bytes, picture.width, picture.height, 3, rgb.data(), 3 * picture.width);
    expect(written != 0 && !bytes.empty(), "stb_image_write could not encode a PNG");
    return bytes;
}

std::vector<std::uint8_t> exr_bytes(const FloatPicture& picture) {
    expect(picture.rgba.size() == 4 * pixel_count(picture.width, picture.height) && !picture.rgba.empty(),
           "a float picture has 4 values a pixel and is not empty");
    std::vector<std::vector<float>> planes = planes_abgr(picture);
    std::array<unsigned char*, 4> plane_addresses{};
    std::array<EXRChannelInfo, 4> channels{};
    std::array<int, 4> pixel_types{};
    for (std::size_t channel = 0; channel < 4; ++channel) {
        plane_addresses[channel] = reinterpret_cast<unsigned char*>(planes[channel].data());
        channels[channel].name[0] = "ABGR"[channel];
        pixel_types[channel] = TINYEXR_PIXELTYPE_FLOAT;
    }

    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = 4;
    header.channels = channels.data();
    header.pixel_types = pixel_types.data();
    header.requested_pixel_types = pixel_types.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;

    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = 4;
    image.images = plane_addresses.data();
    image.width = picture.width;
    image.height = picture.height;

    unsigned char* memory = nullptr;
    const char* words = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &memory, &words);
    if (size == 0 || memory == nullptr) {
        const std::string message = words != nullptr ? words : "no reason given";
        FreeEXRErrorMessage(words);
        throw Error(Fault::environment, "tinyexr could not encode an EXR of " + std::to_string(picture.width) + "x" +
                                            std::to_string(picture.height) + ": " + message + "; write a .png instead");
    }
    std::vector<std::uint8_t> bytes(memory, memory + size);
    std::free(memory);
    return bytes;
}

Picture read_png(const std::filesystem::path& path) {
    Picture picture;
    int channels = 0;
    stbi_uc* pixels = stbi_load(path.c_str(), &picture.width, &picture.height, &channels, 4);
    if (pixels == nullptr) {
        throw Error(Fault::input, path.string() + ": is no picture that can be read; name a .png file");
    }
    picture.rgba.assign(pixels, pixels + 4 * pixel_count(picture.width, picture.height));
    stbi_image_free(pixels);
    return picture;
}

void write_png(const std::filesystem::path& path, const Picture& picture) { write_file(path, png_bytes(picture)); }

void write_exr(const std::filesystem::path& path, const FloatPicture& picture) { write_file(path, exr_bytes(picture)); }

}  // namespace halfframe::perf
