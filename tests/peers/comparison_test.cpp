// What is said of samples, who draws when, and who is refused.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "perf/peers/comparison.h"

namespace halfframe::peers {
namespace {

TEST(Spread, is_median_and_quartiles_whatever_the_order) {
    const Spread odd = spread({5.0, 1.0, 4.0, 2.0, 3.0});
    EXPECT_DOUBLE_EQ(odd.median, 3.0);
    EXPECT_DOUBLE_EQ(odd.low, 2.0);
    EXPECT_DOUBLE_EQ(odd.high, 4.0);
    EXPECT_DOUBLE_EQ(spread({4.0, 1.0, 2.0, 3.0}).median, 2.5);
    EXPECT_DOUBLE_EQ(spread({7.0}).high, 7.0);
    EXPECT_THROW((void)spread({}), Mistake);
}

TEST(Ratio, cancels_what_slows_a_whole_round_down) {
    // The machine is ten times slower in round 2; a is half of b in every round.
    const Spread half = ratio({1.0, 10.0, 1.2}, {2.0, 20.0, 2.4});
    EXPECT_DOUBLE_EQ(half.low, 0.5);
    EXPECT_DOUBLE_EQ(half.median, 0.5);
    EXPECT_DOUBLE_EQ(half.high, 0.5);
    EXPECT_THROW((void)ratio({1.0}, {1.0, 2.0}), Mistake);
}

TEST(Interleaving, lets_everybody_draw_once_a_round_and_changes_neighbours) {
    constexpr int kCount = 4;
    std::set<std::pair<int, int>> neighbours;
    std::set<int> first;
    for (int round = 0; round < 8; ++round) {
        const std::vector<int> order = order_of_round(kCount, round);
        std::vector<int> sorted = order;
        std::ranges::sort(sorted);
        EXPECT_EQ(sorted, (std::vector<int>{0, 1, 2, 3})) << "round " << round;
        first.insert(order.front());
        for (std::size_t i = 1; i < order.size(); ++i) neighbours.emplace(order[i - 1], order[i]);
    }
    EXPECT_EQ(first.size(), 4u) << "everybody starts a round sometimes";
    EXPECT_EQ(neighbours.size(), 8u) << "each is preceded by both of its neighbours in the list";
}

TEST(Batches, are_filled_with_whole_frames) {
    EXPECT_EQ(frames_for(10.0, 700.0), 70);
    EXPECT_EQ(frames_for(9.9, 100.0), 11);
    EXPECT_EQ(frames_for(5000.0, 700.0), 2);
    EXPECT_EQ(frames_for(0.0, 700.0), 400);
}

TEST(Drivers, other_than_llvmpipe_are_refused_by_name) {
    EXPECT_FALSE(refused_driver("three.js", "ANGLE (Mesa/X.org, llvmpipe (LLVM 15.0.6 256 bits), OpenGL ES 3.2)"));
    EXPECT_FALSE(refused_driver("Filament", "llvmpipe (LLVM 15.0.6, 256 bits)"));
    const auto swiftshader = refused_driver(
        "three.js", "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)");
    ASSERT_TRUE(swiftshader);
    EXPECT_NE(swiftshader->find("three.js draws with"), std::string::npos) << *swiftshader;
    EXPECT_NE(swiftshader->find("libegl-mesa0"), std::string::npos) << *swiftshader;
    EXPECT_TRUE(refused_driver("Filament", "softpipe"));
    EXPECT_TRUE(refused_driver("three.js", "hidden by the browser"));
    EXPECT_TRUE(refused_driver("three.js", ""));
}

Picture flat(int width, int height, const glm::ivec3& color) {
    Picture picture{.width = width, .height = height, .rgba = {}};
    for (int i = 0; i < width * height; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            picture.rgba.push_back(static_cast<std::uint8_t>(color[channel]));
        }
        picture.rgba.push_back(255);
    }
    return picture;
}

TEST(Cover, counts_what_is_not_background) {
    const glm::vec3 magenta(1.0f, 0.0f, 1.0f);
    Picture picture = flat(10, 10, {255, 1, 254});  // as far off as rounding may bring it
    EXPECT_DOUBLE_EQ(fraction(cover(picture, magenta)), 0.0);
    for (std::size_t i = 0; i < 25; ++i) picture.rgba[4 * i + 1] = 128;
    const std::vector<bool> quarter = cover(picture, magenta);
    EXPECT_DOUBLE_EQ(fraction(quarter), 0.25);
    EXPECT_NEAR(mean_brightness(picture, quarter), (255.0 + 128.0 + 254.0) / (3.0 * 255.0), 1e-9);
}

TEST(Overlap, is_pixels_of_both_over_pixels_of_either) {
    EXPECT_DOUBLE_EQ(overlap({true, true, false, false}, {true, false, true, false}), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(overlap({true, false}, {true, false}), 1.0);
    EXPECT_DOUBLE_EQ(overlap({false, false}, {false, false}), 0.0) << "two empty pictures prove nothing";
}

TEST(Aim, is_the_share_of_the_peer_or_one_and_a_half_floors) {
    EXPECT_DOUBLE_EQ(target(100.0, 0.5, 20.0).ms, 50.0);
    EXPECT_FALSE(target(100.0, 0.5, 20.0).by_floor);
    EXPECT_DOUBLE_EQ(target(100.0, 0.25, 20.0).ms, 30.0);
    EXPECT_TRUE(target(100.0, 0.25, 20.0).by_floor);
}

TEST(Pictures, are_encoded_and_turned_over) {
    Picture picture = flat(1, 3, {0, 55, 255});
    picture.rgba[0] = 9;
    flip(picture);
    EXPECT_EQ(picture.rgba[8], 9);
    EXPECT_EQ(picture.rgba[0], 0);
    encode_srgb(picture);
    EXPECT_EQ(picture.rgba[1], 128);  // 55/255 = 0.2157 linear is sRGB 0.5019 (IEC 61966-2-1)
    EXPECT_EQ(picture.rgba[2], 255);
    EXPECT_EQ(picture.rgba[3], 255);
}

}  // namespace
}  // namespace halfframe::peers
