// Picture files come back as they went in, and appear whole or not at all.
#include "perf/report/picture_file.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <tinyexr.h>

#include "engine/error.h"
#include "perf/report/atomic_file.h"
#include "tests/perf/child_process.h"

namespace halfframe::perf {
namespace {

/// Every channel and every pixel differs from its neighbours, so that a swap of any two shows.
Picture sample_picture(int width, int height) {
    Picture picture{.width = width, .height = height, .rgba = {}};
    for (int index = 0; index < width * height; ++index) {
        for (int channel = 0; channel < 4; ++channel) {
            picture.rgba.push_back(static_cast<std::uint8_t>((index * 37 + channel * 59) % 256));
        }
    }
    return picture;
}

TEST(PictureFile, png_comes_back_as_it_went_in) {
    const Picture picture = sample_picture(7, 5);
    const std::vector<std::uint8_t> bytes = png_bytes(picture);
    int width = 0;
    int height = 0;
    int channels = 0;
    stbi_uc* pixels =
        stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 0);
    ASSERT_NE(pixels, nullptr) << stbi_failure_reason();
    ASSERT_EQ(width, 7);
    ASSERT_EQ(height, 5);
    ASSERT_EQ(channels, 3);
    for (std::size_t pixel = 0; pixel < 35; ++pixel) {
        EXPECT_EQ(std::memcmp(pixels + 3 * pixel, &picture.rgba[4 * pixel], 3), 0) << "pixel " << pixel;
    }
    stbi_image_free(pixels);
}

TEST(PictureFile, png_bytes_depend_on_the_pixels_alone) {
    EXPECT_EQ(png_bytes(sample_picture(33, 9)), png_bytes(sample_picture(33, 9)));
    Picture other = sample_picture(33, 9);
    other.rgba[0] = static_cast<std::uint8_t>(other.rgba[0] ^ 1u);
    EXPECT_NE(png_bytes(sample_picture(33, 9)), png_bytes(other));
}

TEST(PictureFile, exr_keeps_every_value_nan_and_inf_included) {
    FloatPicture picture{.width = 3, .height = 2, .rgba = {}};
    for (int value = 0; value < 24; ++value) {
        picture.rgba.push_back(static_cast<float>(value) * 1234.5f - 7.0f);
    }
    picture.rgba[4] = std::numeric_limits<float>::infinity();
    picture.rgba[9] = std::numeric_limits<float>::quiet_NaN();
    picture.rgba[14] = 1e-40f;  // a subnormal
    const std::vector<std::uint8_t> bytes = exr_bytes(picture);
    float* values = nullptr;
    int width = 0;
    int height = 0;
    const char* words = nullptr;
    ASSERT_EQ(LoadEXRFromMemory(&values, &width, &height, bytes.data(), bytes.size(), &words), TINYEXR_SUCCESS)
        << (words != nullptr ? words : "");
    ASSERT_EQ(width, 3);
    ASSERT_EQ(height, 2);
    // By bits: NaN equals nothing.
    EXPECT_EQ(std::memcmp(values, picture.rgba.data(), picture.rgba.size() * sizeof(float)), 0);
    std::free(values);
    EXPECT_EQ(bytes, exr_bytes(picture));
}

TEST(PictureFile, a_wrong_size_is_our_mistake) {
    Picture picture = sample_picture(4, 4);
    picture.rgba.pop_back();
    EXPECT_THROW((void)png_bytes(picture), Mistake);
    EXPECT_THROW((void)exr_bytes(FloatPicture{}), Mistake);
}

TEST(AtomicFile, replaces_a_file_and_leaves_nothing_beside_it) {
    const test::TemporaryFolder folder;
    write_file(folder / "a.txt", std::string_view("first"));
    write_file(folder / "a.txt", std::string_view("second"));
    EXPECT_EQ(test::file_text(folder / "a.txt"), "second");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, a_missing_folder_is_named_with_what_to_try) {
    const test::TemporaryFolder folder;
    try {
        write_png(folder / "missing/a.png", sample_picture(2, 2));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::environment);
        EXPECT_NE(std::string(error.what()).find("missing/a.png"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("make its folder first"), std::string::npos) << error.what();
    }
}

TEST(AtomicFile, refuses_what_is_no_regular_file) {
    EXPECT_THROW(write_file("/dev/null", std::string_view("x")), Error);
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_file(folder.path(), std::string_view("x")), Error);
}

TEST(AtomicFile, the_early_check_leaves_no_trace) {
    const test::TemporaryFolder folder;
    expect_can_write(folder / "a.png");
    EXPECT_TRUE(folder.names().empty());
    EXPECT_THROW(expect_can_write(folder / "missing/a.png"), Error);
}

/// A full disk, played by a limit on the size of files in a child process: write() fails half way.
TEST(AtomicFile, a_full_disk_keeps_the_old_file_and_removes_the_partial_one) {
    const test::TemporaryFolder folder;
    write_file(folder / "a.bin", std::string_view("old"));
    const std::string big(100000, 'x');
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_file(folder / "a.bin", std::string_view(big));
        } catch (const Error& error) {
            const bool tells = std::strstr(error.what(), "free some space") != nullptr;
            ::_exit(error.fault() == Fault::environment && tells ? 42 : 43);
        }
        ::_exit(44);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 42) << "43: wrong error, 44: no error";
    EXPECT_EQ(test::file_text(folder / "a.bin"), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.bin"});
}

}  // namespace
}  // namespace halfframe::perf
