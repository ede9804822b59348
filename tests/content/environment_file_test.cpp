// Environments from files: what they hold, what is mended, what is refused and in which words.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <tinyexr.h>

#include "content/content.h"
#include "content/environment/equirectangular.h"
#include "engine/error.h"
#include "tests/content/temporary_gltf.h"
#include "tests/harness/assets.h"

namespace halfframe::tests {
namespace {

using content::Equirectangular;

/// Flat RGBE pixels under a header; `extra` lines end in line feeds.
std::string hdr(int width, int height, const std::vector<std::uint8_t>& pixels, const std::string& extra = {}) {
    std::string bytes = "#?RADIANCE\n" + extra + "FORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                        std::to_string(width) + "\n";
    bytes.append(pixels.begin(), pixels.end());
    return bytes;
}

std::vector<std::uint8_t> flat(std::size_t count) {
    std::vector<std::uint8_t> pixels;
    for (std::size_t i = 0; i < count; ++i) {
        for (const int byte : {128 + static_cast<int>(i % 100), 64, 32, 129})
            pixels.push_back(static_cast<std::uint8_t>(byte));
    }
    return pixels;
}

/// R, G and B as floats. `type`: TINYEXR_PIXELTYPE_*.
std::string exr(int width, int height, const std::vector<glm::vec3>& pixels, int compression = 3,
                int type = TINYEXR_PIXELTYPE_FLOAT) {
    std::array<std::vector<float>, 3> planes;
    for (const glm::vec3& pixel : pixels) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            planes[channel].push_back(pixel[2 - static_cast<int>(channel)]);
    }
    EXRHeader header;
    InitEXRHeader(&header);
    EXRImage image;
    InitEXRImage(&image);
    std::array<EXRChannelInfo, 3> channels{};
    std::array<int, 3> stored{type, type, type};
    std::array<int, 3> given{TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT};
    std::array<unsigned char*, 3> addresses{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        channels[channel].name[0] = "BGR"[channel];
        addresses[channel] = reinterpret_cast<unsigned char*>(planes[channel].data());
    }
    header.num_channels = image.num_channels = 3;
    header.channels = channels.data();
    header.pixel_types = given.data();
    header.requested_pixel_types = stored.data();
    header.compression_type = compression;
    image.images = addresses.data();
    image.width = width;
    image.height = height;
    unsigned char* memory = nullptr;
    const char* words = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &memory, &words);
    EXPECT_GT(size, 0u) << (words != nullptr ? words : "");
    std::string bytes(reinterpret_cast<char*>(memory), size);
    std::free(memory);
    return bytes;
}

/// Says that the pixels reach to (max_x, max_y).
std::string with_data_window(std::string bytes, std::int32_t max_x, std::int32_t max_y) {
    const std::string key("dataWindow\0box2i\0", 17);
    const std::size_t at = bytes.find(key);
    EXPECT_NE(at, std::string::npos);
    std::memcpy(bytes.data() + at + key.size() + 4 + 8, &max_x, 4);  // after the size and the lower corner
    std::memcpy(bytes.data() + at + key.size() + 4 + 12, &max_y, 4);
    return bytes;
}

std::vector<glm::vec3> ramp(int count) {
    std::vector<glm::vec3> pixels;
    for (int i = 0; i < count; ++i) pixels.emplace_back(0.25f * static_cast<float>(i), 1.5f, 300.0f);
    return pixels;
}

Equirectangular decoded(const std::string& bytes, const char* name, std::vector<std::string>* notices = nullptr) {
    std::vector<std::string> unread;
    return content::decode_equirectangular(bytes, name, notices != nullptr ? *notices : unread);
}

/// The message of the Error(input); empty when there was none.
std::string refusal(const std::string& bytes, const char* name) {
    try {
        (void)decoded(bytes, name);
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input) << error.what();
        EXPECT_TRUE(std::string(error.what()).starts_with(std::string(name) + ": ")) << error.what();
        return error.what();
    }
    return {};
}

TEST(EnvironmentFile, RadianceFilesReadAsStbReadsThem) {
    const auto assets = harness::assets_folder();
    if (!assets) GTEST_SKIP() << harness::assets_missing();
    const std::filesystem::path file = *assets / "environments" / "spiaggia_di_mondello_1k.hdr";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file.string() << " among the assets";
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    const Equirectangular picture = decoded(bytes, "beach.hdr");
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<float, decltype(&stbi_image_free)> expected(
        stbi_loadf_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width,
                               &height, &channels, 3),
        &stbi_image_free);
    ASSERT_NE(expected, nullptr);
    ASSERT_EQ(picture.width, width);
    ASSERT_EQ(picture.height, height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            ASSERT_EQ(picture.pixels[i][channel], expected.get()[3 * i + static_cast<std::size_t>(channel)]) << i;
        }
    }
}

TEST(EnvironmentFile, FlatPixelsOldRunsAndExposureAreRead) {
    const Equirectangular plain = decoded(hdr(4, 2, flat(8)), "flat.hdr");
    EXPECT_EQ(plain.pixels[3], glm::vec3(131.0f, 64.0f, 32.0f) / 128.0f);
    EXPECT_EQ(decoded(hdr(4, 2, flat(8), "EXPOSURE=2\nEXPOSURE= 4\n"), "e.hdr").pixels[3], plain.pixels[3] / 8.0f);
    // One pixel, then 1 1 1 3: three more of it.
    std::vector<std::uint8_t> runs{128, 64, 32, 129, 1, 1, 1, 3, 128, 128, 128, 130, 1, 1, 1, 3};
    const Equirectangular old = decoded(hdr(4, 2, runs), "old.hdr");
    EXPECT_EQ(old.pixels[3], glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(old.pixels[7], glm::vec3(2.0f));
    EXPECT_EQ(decoded(hdr(4, 2, flat(8)) + "more", "long.hdr").pixels, plain.pixels);
}

TEST(EnvironmentFile, OpenExrIsReadInEveryCompression) {
    const std::vector<glm::vec3> pixels = ramp(64 * 32);
    for (int compression = TINYEXR_COMPRESSIONTYPE_NONE; compression <= TINYEXR_COMPRESSIONTYPE_PIZ; ++compression) {
        for (const int type : {TINYEXR_PIXELTYPE_HALF, TINYEXR_PIXELTYPE_FLOAT}) {
            const Equirectangular picture = decoded(exr(64, 32, pixels, compression, type), "ramp.EXR");
            ASSERT_EQ(picture.width, 64);
            ASSERT_EQ(picture.pixels.size(), pixels.size());
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                // Quarters below 512 are exact in half too.
                ASSERT_EQ(picture.pixels[i], pixels[i]) << compression << " " << type << " " << i;
            }
        }
    }
}

TEST(EnvironmentFile, ValuesThatNoLightHasAreMendedWithANotice) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::vector<glm::vec3> pixels = ramp(8);
    pixels[0] = glm::vec3(std::numeric_limits<float>::quiet_NaN(), -1.0f, kInfinity);
    pixels[1] = glm::vec3(-kInfinity, 3e38f, 2.0f);
    std::vector<std::string> notices;
    const Equirectangular picture = decoded(exr(4, 2, pixels), "odd.exr", &notices);
    EXPECT_EQ(picture.pixels[0], glm::vec3(0.0f, 0.0f, 65504.0f));
    EXPECT_EQ(picture.pixels[1], glm::vec3(0.0f, 1e7f, 2.0f));
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("1 NaN and 2 negative"), std::string::npos) << notices[0];
    // And nothing odd comes out at the other end.
    const TemporaryFolder folder;
    const std::string file = folder.write("odd.exr", exr(4, 2, pixels)).string();
    const content::LoadedEnvironment loaded = content::environment(file, {.size = 16, .threads = 1});
    for (const auto& level : loaded.map.levels) {
        for (const glm::vec3& texel : level) ASSERT_TRUE(texel.r >= 0.0f && texel.g >= 0.0f && texel.b < 1e30f);
    }
}

TEST(EnvironmentFile, BlackIsAnEnvironmentWithANotice) {
    const TemporaryFolder folder;
    const std::string file = folder.write("black.hdr", hdr(4, 2, std::vector<std::uint8_t>(32, 0))).string();
    const content::LoadedEnvironment loaded = content::environment(file, {.size = 16, .threads = 1});
    ASSERT_EQ(loaded.notices.size(), 1u);
    EXPECT_NE(loaded.notices[0].find("black"), std::string::npos);
    for (const glm::vec3& texel : loaded.map.levels[0]) ASSERT_EQ(texel, glm::vec3(0.0f));
}

struct Refused {
    const char* name;
    std::string bytes;
    const char* says;
};

TEST(EnvironmentFile, BrokenFilesAreRefusedInWords) {
    const std::vector<std::uint8_t> eight = flat(8);
    std::string runs = hdr(8, 4, {2, 2, 0, 8});
    std::string wrong_length = hdr(8, 4, {2, 2, 0, 9});
    std::string over_the_row = hdr(8, 4, {2, 2, 0, 8, 128 + 9, 0});
    std::string empty_run = hdr(8, 4, {2, 2, 0, 8, 0, 0, 0, 0});
    const std::vector<Refused> faults{
        {"empty.hdr", "", "is empty"},
        {"words.hdr", "no picture at all\n", "#?RADIANCE"},
        {"header.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe", "header does not end"},
        {"xyze.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 2 +X 4\n", "not RGBE"},
        {"format.hdr", "#?RADIANCE\n\n-Y 2 +X 4\n", "no FORMAT"},
        {"turned.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 2 +X 4\n", "top row first"},
        {"exposure.hdr", hdr(4, 2, eight, "EXPOSURE=0\n"), "EXPOSURE"},
        {"exposed.hdr", hdr(4, 2, eight, "EXPOSURE=nan\n"), "EXPOSURE"},
        {"square.hdr", hdr(4, 4, eight), "twice as wide"},
        {"none.hdr", hdr(0, 0, eight), "0 x 0"},
        {"enormous.hdr", hdr(2000000000, 1000000000, eight), "8192"},
        {"overflow.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999999999 +X 4\n", "top row first"},
        {"cut.hdr", hdr(4, 2, flat(7)), "cut off"},
        {"runs.hdr", runs, "cut off"},
        {"length.hdr", wrong_length, "another length"},
        {"over.hdr", over_the_row, "leaves its row"},
        {"nothing.hdr", empty_run, "leaves its row"},
        {"first.hdr", hdr(4, 2, {1, 1, 1, 3}), "leaves its row"},
        {"words.exr", "no picture at all, but long enough to hold a header", "OpenEXR"},
        {"square.exr", exr(4, 4, ramp(16)), "twice as wide"},
        {"wide.exr", with_data_window(exr(4, 2, ramp(8)), 8195, 4097), "8192"},
        {"overflow.exr", with_data_window(exr(4, 2, ramp(8)), 2147483647, 1073741823), "8192"},
        {"upside_down.exr", with_data_window(exr(4, 2, ramp(8)), -5, -5), ""},
        {"larger.exr", with_data_window(exr(4, 2, ramp(8)), 2047, 1023), "OpenEXR"},
    };
    for (const Refused& fault : faults) {
        const std::string message = refusal(fault.bytes, fault.name);
        EXPECT_FALSE(message.empty()) << fault.name;
        EXPECT_NE(message.find(fault.says), std::string::npos) << fault.name << ": '" << message << "'";
        EXPECT_NE(message.find("; "), std::string::npos) << "no word of what to try: " << message;
    }
}

TEST(EnvironmentFile, FilesCutAnywhereAreRefused) {
    std::string run_rows;
    for (int row = 0; row < 8; ++row) {
        append(run_rows, std::vector<std::uint8_t>{2, 2, 0, 16, 144, 128, 144, 64, 16});
        append(run_rows, std::vector<std::uint8_t>(16, 32));
        append(run_rows, std::vector<std::uint8_t>{144, 129});
    }
    const std::string whole_hdr = hdr(16, 8, {}) + run_rows;
    EXPECT_EQ(refusal(whole_hdr, "whole.hdr"), "");
    for (std::size_t size = 0; size < whole_hdr.size(); ++size) {
        EXPECT_NE(refusal(whole_hdr.substr(0, size), "cut.hdr"), "") << size;
    }
    const std::string whole_exr = exr(64, 32, ramp(64 * 32));
    EXPECT_EQ(refusal(whole_exr, "whole.exr"), "");
    for (std::size_t size = 0; size < whole_exr.size(); size += 7) {
        EXPECT_NE(refusal(whole_exr.substr(0, size), "cut.exr"), "") << size;
    }
}

TEST(EnvironmentFile, BytesChangedAnywhereCrashNothing) {
    std::mt19937 random(40951);
    const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random() % end); };
    const std::vector<std::pair<const char*, std::string>> files{
        {"a.hdr", hdr(8, 4, flat(32))},
        {"b.exr", exr(64, 32, ramp(64 * 32), TINYEXR_COMPRESSIONTYPE_ZIP)},
        {"c.exr", exr(64, 32, ramp(64 * 32), TINYEXR_COMPRESSIONTYPE_PIZ, TINYEXR_PIXELTYPE_HALF)},
        {"d.exr", exr(64, 32, ramp(64 * 32), TINYEXR_COMPRESSIONTYPE_RLE)}};
    int refused = 0;
    for (const auto& [name, whole] : files) {
        for (int round = 0; round < 300; ++round) {
            std::string bytes = whole;
            // Half of them in the header, where sizes and offsets are.
            const std::size_t end = round % 2 == 0 ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
            for (int i = 0; i < 3; ++i) bytes[below(end)] = static_cast<char>(random());
            refused += refusal(bytes, name).empty() ? 0 : 1;
        }
    }
    EXPECT_GT(refused, 100);  // measured 600 of 1200: the others changed a pixel
}

TEST(EnvironmentFile, NamesAndOptionsAreCheckedFirst) {
    const auto message = [](const std::string& name, const content::EnvironmentOptions& options, Fault fault) {
        try {
            (void)content::environment(name, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), fault) << error.what();
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(message("night-sky", {}, Fault::input).find("did you mean 'night_sky'"), std::string::npos);
    EXPECT_NE(message("sky.png", {}, Fault::input).find("studio"), std::string::npos);
    EXPECT_NE(message("gone.hdr", {}, Fault::input).find("there is no file"), std::string::npos);
    for (const int size : {-1, 0, 8, 100, 1024}) {
        EXPECT_NE(message("studio", {.size = size}, Fault::usage).find("512"), std::string::npos) << size;
    }
    EXPECT_NE(message("studio", {.threads = -1}, Fault::usage).find("threads"), std::string::npos);
}

}  // namespace
}  // namespace halfframe::tests
