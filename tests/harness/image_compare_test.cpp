// The comparison must see one wrong step in one channel of one pixel, and must show it.
#include "tests/harness/image_compare.h"

#include <fstream>

#include <gtest/gtest.h>

namespace halfframe::harness {
namespace {

/// A picture without symmetry, so that a swapped axis or channel shows.
Picture gradient(int width, int height) {
    Picture picture{.width = width, .height = height, .rgba = {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            picture.rgba.insert(picture.rgba.end(),
                                {static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(11 * y),
                                 static_cast<std::uint8_t>(x + y), 255});
        }
    }
    return picture;
}

TEST(ImageCompare, EqualPicturesAreExact) {
    const Picture picture = gradient(13, 7);
    const ImageDifference found = difference(picture, picture);
    EXPECT_TRUE(found.exact());
    EXPECT_EQ(found.bad_fraction, 0.0);
    EXPECT_TRUE(same_picture(picture, picture, "image_compare_equal"));
}

TEST(ImageCompare, OneStepInOneChannelIsFoundAndPlaced) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
        const Picture expected = gradient(13, 7);
        Picture actual = expected;
        std::uint8_t& value = actual.rgba[(3 * 13 + 5) * 4 + channel];
        value = static_cast<std::uint8_t>(value - 1);
        const ImageDifference found = difference(actual, expected);
        EXPECT_FALSE(found.exact());
        EXPECT_EQ(found.max_channel_error, 1) << "channel " << channel;
        EXPECT_DOUBLE_EQ(found.bad_fraction, 1.0 / (13 * 7));
        EXPECT_EQ(found.worst_x, 5);
        EXPECT_EQ(found.worst_y, 3);
        EXPECT_EQ(difference(actual, expected, 1).bad_fraction, 0.0) << "one step is tolerated";
    }
}

TEST(ImageCompare, AFailureWritesThreePictures) {
    const std::filesystem::path base = image_folder() / "image_compare_failure";
    for (const char* ending : {".actual.png", ".expected.png", ".difference.png"}) {
        std::filesystem::remove(base.string() + ending);
    }
    const Picture expected = gradient(13, 7);
    Picture actual = expected;
    actual.rgba[0] = 90;
    const testing::AssertionResult result = same_picture(actual, expected, "image_compare_failure");
    EXPECT_FALSE(result);
    EXPECT_NE(std::string(result.message()).find("max_channel_error 90 (allowed 0) at 0,0"), std::string::npos)
        << result.message();
    for (const char* ending : {".actual.png", ".expected.png", ".difference.png"}) {
        std::ifstream file(base.string() + ending, std::ios::binary);
        char signature[4] = {};
        file.read(signature, 4);
        EXPECT_EQ(std::string(signature + 1, 3), "PNG") << ending;
    }
}

TEST(ImageCompare, BothNumbersOfAToleranceCount) {
    const Picture expected = gradient(10, 10);
    Picture actual = expected;
    actual.rgba[0] = 4;
    actual.rgba[4] = 11;  // both 4 too many: 2 of 100 pixels
    EXPECT_TRUE(similar_picture(actual, expected, {4, 0.02}, "image_compare_tolerance"));
    EXPECT_FALSE(similar_picture(actual, expected, {3, 0.02}, "image_compare_tolerance"));
    EXPECT_FALSE(similar_picture(actual, expected, {4, 0.01}, "image_compare_tolerance"));
}

TEST(ImageCompare, AnotherSizeOrNoDataIsNeverEqual) {
    EXPECT_FALSE(same_picture(gradient(4, 3), gradient(3, 4), "image_compare_size"));
    EXPECT_FALSE(same_picture({}, {}, "image_compare_empty"));
    Picture cut = gradient(4, 3);
    cut.rgba.pop_back();
    EXPECT_FALSE(same_picture(cut, cut, "image_compare_cut"));
}

TEST(Coverage, CountsWhatDiffersFromTheBackground) {
    Picture picture{.width = 4, .height = 2, .rgba = std::vector<std::uint8_t>(32, 10)};
    EXPECT_EQ(coverage(picture), 0.0);
    picture.rgba[4 * 7 + 2] = 12;
    EXPECT_DOUBLE_EQ(coverage(picture), 1.0 / 8.0);
    EXPECT_EQ(coverage(picture, 2), 0.0);
    EXPECT_DOUBLE_EQ(coverage(picture, {10, 10, 12, 10}), 7.0 / 8.0);
    EXPECT_EQ(coverage(Picture{}), 0.0) << "no picture covers nothing";
}

}  // namespace
}  // namespace halfframe::harness
