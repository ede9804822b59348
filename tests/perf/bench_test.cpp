// The benchmarks run: a slope for every kind of light, a row for every way of skinning. What they measure is not judged.
#include <gtest/gtest.h>

#include "tests/perf/child_process.h"

namespace halfframe::test {
namespace {

TEST(LightBench, PrintsASlopeForEveryKindOfLight) {
    if (run_child(HALFFRAME_BINARY_DIR "/halfframe", {"info", "--json"}, {}).code == 4) {
        GTEST_SKIP() << "no graphics context here";
    }
    for (const char* tier : {"low", "console"}) {
        const ChildResult result = run_child(HALFFRAME_BINARY_DIR "/halfframe_bench",
                                             {"--rounds", "1", "--width", "32", "--height", "16", "--tier", tier}, {});
        ASSERT_EQ(result.code, 0) << result.err;
        for (const char* group : {"points: ", "spots: ", "spheres: ", "64 points: ", " ms a light"}) {
            EXPECT_NE(result.out.find(group), std::string::npos) << group << "\n" << result.out;
        }
        EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
    }
}

TEST(MotionBench, TimesEveryWayForEveryNumberOfJoints) {
    const std::string bench = HALFFRAME_BINARY_DIR "/halfframe_motion_bench";
    if (run_child(HALFFRAME_BINARY_DIR "/halfframe", {"info", "--json"}, {}).code == 4) {
        GTEST_SKIP() << "no graphics context here";
    }
    const ChildResult result = run_child(bench, {"--rounds", "1", "--side", "32"}, {});
    ASSERT_EQ(result.code, 0) << result.err;
    for (const char* words : {"at rest", "uniforms", "texture", "cpu", "256"}) {
        EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
    }
}

TEST(LightBench, AnUnknownTierIsRefused) {
    const ChildResult result = run_child(HALFFRAME_BINARY_DIR "/halfframe_bench", {"--tier", "middle"}, {});
    EXPECT_NE(result.code, 0);
    EXPECT_NE(result.err.find("--tier"), std::string::npos) << result.err;
}

TEST(DrawBench, PrintsARatioForEveryCase) {
    if (run_child(HALFFRAME_BINARY_DIR "/halfframe", {"info", "--json"}, {}).code == 4) {
        GTEST_SKIP() << "no graphics context here";
    }
    const ChildResult result =
        run_child(HALFFRAME_BINARY_DIR "/halfframe_draw_bench", {"--rounds", "1", "--objects", "50"}, {});
    ASSERT_EQ(result.code, 0) << result.err;
    for (const char* word : {"8 materials, 16 meshes", "64 materials, 256 meshes", "2 lamps", "bare loop", "ratio"}) {
        EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
    }
    EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
}

TEST(LoadBench, PrintsARatioAndAPeakForEverySize) {
    const ChildResult result = run_child(HALFFRAME_BINARY_DIR "/halfframe_load_bench", {"--rounds", "1", "--small"}, {});
    ASSERT_EQ(result.code, 0) << result.err;
    for (const char* word : {"8 images of 256 x 256", "16384 vertices", "6250 nodes", "6250 meshes", "bare ms", "ratio", "peak MiB", "prepare ms"}) {
        EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
    }
    EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace halfframe::test
