// Every pair of frames is as near as its bound says, finite everywhere, and not blank: one test a kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "content/content.h"

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

/// The scenes that are drawn fast; the label sweep has all of them at all tiers.
TEST_F(FramePairs, OfOtherScenes) {
    for (const char* name : {"furnace", "lamps", "spheres", "memory_room"}) {
        for (const accuracy::FrameCase& pair : accuracy::scene_cases(content::open_scene(name)))
            expect_stable(pair, {Tier::low, Tier::console});
    }
}

TEST(FrameCases, AreThoseThatASceneHasSomethingFor) {
    const auto has = [](const char* scene, const char* change) {
        const std::vector<accuracy::FrameCase> pairs = accuracy::scene_cases(content::open_scene(scene));
        return std::ranges::any_of(
            pairs, [&](const accuracy::FrameCase& pair) { return pair.change == std::string(scene) + ": " + change; });
    };
    EXPECT_TRUE(has("lamps", "lights in the opposite order"));
    EXPECT_FALSE(has("spheres", "lights in the opposite order"));
    EXPECT_TRUE(has("street", "after a day"));
    EXPECT_FALSE(has("lamps", "after a day"));
}

TEST(FrameCases, EveryKindIsTested) {
    const std::set<std::string> tested{"moved",  "far_places", "units", "lights", "eye",
                                       "turned", "triangles",  "size",  "whole"};
    std::set<std::string> kinds;
    for (const accuracy::FrameCase& pair : accuracy::frame_cases()) kinds.insert(pair.kind);
    EXPECT_EQ(kinds, tested);
}

}  // namespace
}  // namespace halfframe::tests
