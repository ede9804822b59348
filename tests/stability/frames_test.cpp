// Every pair of frames is as near as its bound says, finite everywhere, and not blank: one test a kind.
#include <gtest/gtest.h>

#include <set>

#include "tests/stability/frame_pairs.h"

namespace halfframe::tests {
namespace {

TEST_F(FramePairs, FarAwayAgainstTheOrigin) { expect_stable("moved"); }
TEST_F(FramePairs, FarAwayAgainstTheSamePlaces) { expect_stable("far_places"); }
TEST_F(FramePairs, InOtherUnits) { expect_stable("units"); }
TEST_F(FramePairs, UnderOtherLights) { expect_stable("lights"); }
TEST_F(FramePairs, FromOddEyes) { expect_stable("eye"); }
TEST_F(FramePairs, Turned) { expect_stable("turned"); }
TEST_F(FramePairs, WithTrianglesOfNoArea) { expect_stable("triangles"); }
TEST_F(FramePairs, InOddSizes) { expect_stable("size"); }
TEST_F(FramePairs, WithEveryEffect) { expect_stable("whole"); }

TEST(FrameCases, EveryKindIsTested) {
    const std::set<std::string> tested{"moved",  "far_places", "units", "lights", "eye",
                                       "turned", "triangles",  "size",  "whole"};
    std::set<std::string> kinds;
    for (const accuracy::FrameCase& pair : accuracy::frame_cases()) kinds.insert(pair.kind);
    EXPECT_EQ(kinds, tested);
}

}  // namespace
}  // namespace halfframe::tests
