// The order in which a frame draws its surfaces.
#include "engine/effects/surface/draw_order.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace halfframe::tests {
namespace {

/// Looks along -Z from the origin, half of the picture's height at 45 degrees.
View view_from_origin() {
    Camera camera;
    camera.fov_y_rad = 1.5707963f;
    return view_of(camera, 160, 90);
}

View parallel_view(float half_height_m) {
    Camera camera;
    camera.orthographic = true;
    camera.half_height_m = half_height_m;
    return view_of(camera, 160, 90);
}

std::vector<DrawOrder> ordered(const std::vector<DrawPlace>& places, const View& view, OrderBy by) {
    std::vector<DrawOrder> order(places.size()), spare(places.size());
    order_draws(places, view, by, order, spare);
    return order;
}

std::vector<int> draws(const std::vector<DrawPlace>& places, const View& view, OrderBy by) {
    std::vector<int> list;
    for (const DrawOrder& one : ordered(places, view, by)) list.push_back(static_cast<int>(one.draw));
    return list;
}

DrawPlace place(float depth, float half, std::uint32_t state) {
    return {.centre = {0.0f, 0.0f, -depth}, .half = glm::vec3(half), .state = state};
}

using List = std::vector<int>;

TEST(DrawOrder, LargeOnesGoNearBeforeFarWhateverTheirState) {
    EXPECT_EQ(draws({place(30, 5, 0), place(10, 5, 1), place(20, 5, 0)}, view_from_origin(), OrderBy::large_first),
              (List{1, 2, 0}));
}

TEST(DrawOrder, LargeOnesAboutAsNearGoByState) {
    // Squares of the nearest distances: 103, 100, 103 and 96, which is in the sixteenth of an octave before.
    EXPECT_EQ(draws({place(15.149f, 5, 0), place(15, 5, 1), place(15.148f, 5, 0), place(14.8f, 5, 3)},
                    view_from_origin(), OrderBy::large_first),
              (List{3, 2, 0, 1}));
}

TEST(DrawOrder, AHullGoesBeforeWhatItHolds) {
    // The centre of what it holds is nearer.
    EXPECT_EQ(draws({place(19, 2, 0), place(20, 6, 1)}, view_from_origin(), OrderBy::large_first), (List{1, 0}));
}

TEST(DrawOrder, FloorAndRoomGoAfterWhatStandsThere) {
    const DrawPlace floor{.centre = {0.0f, -1.7f, -20.0f}, .half = {30.0f, 0.05f, 30.0f}};
    const DrawPlace room{.centre = {0.0f, 0.0f, -20.0f}, .half = glm::vec3(30.0f)};
    for (const DrawPlace& around : {floor, room})
        EXPECT_EQ(draws({around, place(8, 1, 1)}, view_from_origin(), OrderBy::large_first), (List{1, 0}));
}

TEST(DrawOrder, SmallOnesFollowByStateThenNearBeforeFar) {
    const std::vector<DrawPlace> places{place(100, 0.1f, 1), place(50, 0.1f, 2), place(90, 0.1f, 1), place(70, 0.1f, 2),
                                        place(500, 200, 3)};
    EXPECT_EQ(draws(places, view_from_origin(), OrderBy::large_first), (List{4, 2, 0, 1, 3}));
}

TEST(DrawOrder, SizeIsThatInThePicture) {
    // A cube whose half diagonal is a bit more or less than a tenth of half the height, which is 20 m at 20 m.
    const float edge = 2.0f / std::sqrt(3.0f);
    for (const auto& [half, is_large] : {std::pair{edge * 1.01f, true}, std::pair{edge * 0.99f, false}}) {
        const std::vector<DrawPlace> places{place(500, 0.1f, 0), place(20, half, 1)};
        EXPECT_EQ(draws(places, view_from_origin(), OrderBy::large_first), is_large ? (List{1, 0}) : (List{0, 1}));
        // Where the view is parallel, distance makes nothing smaller: 20 m of half height, anywhere.
        const std::vector<DrawPlace> anywhere{place(400, 0.1f, 0), place(800, half, 1)};
        EXPECT_EQ(draws(anywhere, parallel_view(20.0f), OrderBy::large_first), is_large ? (List{1, 0}) : (List{0, 1}));
    }
}

TEST(DrawOrder, AnyUnitGivesTheSameOrder) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<DrawPlace> places;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const glm::vec3 centre{30 * uniform(random), 30 * uniform(random), -40 + 30 * uniform(random)};
        places.push_back({centre, glm::vec3(1.0f + uniform(random)), i % 7});
    }
    const List in_metres = draws(places, view_from_origin(), OrderBy::large_first);
    for (const float unit : {1024.0f, 1.0f / 1024.0f}) {
        std::vector<DrawPlace> scaled = places;
        for (DrawPlace& one : scaled) {
            one.centre *= unit;
            one.half *= unit;
        }
        EXPECT_EQ(draws(scaled, view_from_origin(), OrderBy::large_first), in_metres) << unit;
    }
}

TEST(DrawOrder, ByStateAloneWhereDepthIsThere) {
    EXPECT_EQ(
        draws({place(1, 5, 2), place(2, 5, 1), place(3, 5, 2), place(4, 5, 1)}, view_from_origin(), OrderBy::state),
        (List{1, 3, 0, 2}));
}

TEST(DrawOrder, WhatBlendsGoesFarBeforeNearByCentres) {
    EXPECT_EQ(draws({place(19, 2, 0), place(20, 6, 1), place(1, 0, 2)}, view_from_origin(), OrderBy::far_first),
              (List{1, 0, 2}));
}

TEST(DrawOrder, EqualOnesKeepTheirOrder) {
    const std::vector<DrawPlace> places(300, place(10, 1, 4));
    for (const OrderBy by : {OrderBy::state, OrderBy::large_first, OrderBy::far_first})
        EXPECT_TRUE(std::ranges::is_sorted(draws(places, view_from_origin(), by)));
}

TEST(DrawOrder, FarIsToldByTheCentre) {
    std::vector<DrawPlace> places{place(9, 1, 0), place(11, 5, 0)};
    for (DrawPlace& one : places) one.far_squared = 100.0f;
    for (const DrawOrder& one : ordered(places, view_from_origin(), OrderBy::large_first))
        EXPECT_EQ(one.far, one.draw == 1);
}

TEST(DrawOrder, NothingIsNothing) { EXPECT_TRUE(ordered({}, view_from_origin(), OrderBy::large_first).empty()); }

}  // namespace
}  // namespace halfframe::tests
