// Compares the traces of trace_frame and of trace_frame_without_<effect>: equal wherever the plan leaves the effect
// out, and different where it has it in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/frame/effect_card.h"
#include "perf/process/child_process.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::tests {
namespace {

namespace fs = std::filesystem;

constexpr char kRecordMark = '\x1e';  // trace_frame writes it before each trace

/// A frame of a built-in scene as one of the programs has drawn it.
struct DrawnFrame {
    std::string scene;
    std::string tier;
    std::vector<std::string> in;  ///< effects that its plan has in
    std::string trace;
    [[nodiscard]] bool has(const std::string& effect) const { return std::ranges::find(in, effect) != in.end(); }
};

std::vector<DrawnFrame> read_frames(const fs::path& path) {
    std::vector<DrawnFrame> frames;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    std::getline(file, text, kRecordMark);  // nothing stands before the first mark
    while (std::getline(file, text, kRecordMark)) {
        const std::size_t end = text.find('\n');
        std::istringstream head(text.substr(0, end));
        DrawnFrame frame;
        head >> frame.scene >> frame.tier;
        for (std::string effect; head >> effect;) frame.in.push_back(effect);
        frame.trace = text.substr(end + 1);
        frames.push_back(std::move(frame));
    }
    return frames;
}

/// What `program` draws of `frames`, or of every scene at every tier. One process draws them all: a scene is made once
/// for its tiers.
std::vector<DrawnFrame> drawn(const std::string& program, const std::vector<DrawnFrame>& frames) {
    const harness::TemporaryFolder folder;
    const fs::path file = folder / "traces";
    process::ChildCommand command{.limit_s = 600.0};
    command.arguments = {(fs::path(TRACE_FRAME_FOLDER) / program).string(), file.string()};
    for (const DrawnFrame& frame : frames) {
        command.arguments.push_back(frame.scene);
        command.arguments.push_back(frame.tier);
    }
    const process::ChildResult ended = process::run_child(command);
    EXPECT_EQ(ended.exit_code, 0) << ended.story();
    return read_frames(file);
}

class OffIsFree : public harness::GlFixture, public testing::WithParamInterface<std::string> {
protected:
    /// Every scene at every tier, by the program that has all effects. ctest has it drawn once for all these tests;
    /// alone, each draws it anew.
    static std::vector<DrawnFrame> with_all() {
        if (std::getenv("HALFFRAME_TRACES") != nullptr) return read_frames(std::getenv("HALFFRAME_TRACES"));
        return drawn("trace_frame", {});
    }
};

TEST_P(OffIsFree, ABuildWithoutItDrawsTheSameWhereverThePlanLeavesItOut) {
    std::vector<DrawnFrame> frames;
    std::size_t out = 0, in = 0;
    for (DrawnFrame& frame : with_all()) {
        EXPECT_GT(frame.trace.size(), 500u) << frame.scene << " at tier " << frame.tier;
        const bool has = frame.has(GetParam());
        // That the other build really lacks the effect must show in each scene that calls for it; one tier is enough.
        if (has && (frame.tier == "reference" ||
                    (!frames.empty() && frames.back().scene == frame.scene && frames.back().has(GetParam()))))
            continue;
        ++(has ? in : out);
        frames.push_back(std::move(frame));
    }
    EXPECT_GT(out, 0u) << "every built-in scene calls for " << GetParam() << ": add one that does not";
    EXPECT_GT(in, 0u) << "no built-in scene calls for " << GetParam() << " at tier low or console";
    const std::vector<DrawnFrame> without = drawn("trace_frame_without_" + GetParam(), frames);
    ASSERT_EQ(without.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].trace == without[i].trace, !frames[i].has(GetParam()))
            << frames[i].scene << " at tier " << frames[i].tier
            << (frames[i].has(GetParam()) ? " calls for " : " pays for ") << GetParam();
    }
}

std::vector<std::string> effect_names() {
    std::vector<std::string> names;
    for (const EffectCard* card : all_effects()) names.emplace_back(card->name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Effects, OffIsFree, testing::ValuesIn(effect_names()),
                         [](const auto& effect) { return effect.param; });

}  // namespace
}  // namespace halfframe::tests
