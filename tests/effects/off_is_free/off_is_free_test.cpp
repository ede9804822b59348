// Compares the traces of trace_frame and of trace_frame_without_<effect> wherever the plan leaves the effect out.
#include <gtest/gtest.h>

#include <fstream>

#include "content/content.h"
#include "engine/frame/frame_plan.h"
#include "perf/process/child_process.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::tests {
namespace {

constexpr char kRecordMark = '\x1e';  // trace_frame writes it before each trace

/// A frame that is drawn by both programs.
struct Frame {
    std::string scene;
    Tier tier;
};

/// What `program` calls for each frame, in order. One process draws them all: a scene is made once for its tiers.
std::vector<std::string> traces(const std::string& program, const std::vector<Frame>& frames) {
    process::ChildCommand command{.arguments = {std::string(TRACE_FRAME_FOLDER) + "/" + program}, .limit_s = 600.0};
    for (const Frame& frame : frames) {
        command.arguments.push_back(frame.scene);
        command.arguments.emplace_back(name(frame.tier));
    }
    const harness::TemporaryFolder folder;
    command.standard_output = folder / "traces";  // of tens of MiB
    const process::ChildResult ended = process::run_child(command);
    EXPECT_EQ(ended.exit_code, 0) << ended.story();
    std::vector<std::string> texts;
    std::ifstream file(*command.standard_output, std::ios::binary);
    std::string text;
    std::getline(file, text, kRecordMark);  // nothing stands before the first mark
    while (std::getline(file, text, kRecordMark)) texts.push_back(text);
    EXPECT_EQ(texts.size(), frames.size());
    texts.resize(frames.size());
    return texts;
}

class OffIsFree : public harness::GlFixture, public testing::WithParamInterface<std::string> {
protected:
    /// The frames of built-in scenes for which the plan has, or has not, this effect in.
    [[nodiscard]] std::vector<Frame> frames(bool in) {
        std::vector<Frame> found;
        for (const content::BuiltInScene& built_in : content::built_in_scenes()) {
            const Scene scene = built_in.make();
            const View view =
                view_of(scene.cameras.empty() ? camera_framing(Box{}, 1.0f) : scene.cameras.front(), 64, 64);
            for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
                const FramePlan plan =
                    plan_frame(scene, view, {.tier = tier, .arithmetic = Arithmetic::full}, caps(), all_effects());
                if (plan.find(GetParam())->in == in) found.push_back({std::string(built_in.name), tier});
            }
        }
        return found;
    }
};

TEST_P(OffIsFree, TheTraceIsThatOfABuildWithoutTheEffect) {
    const std::vector<Frame> out = frames(false);
    ASSERT_FALSE(out.empty()) << "every built-in scene calls for " << GetParam() << ": add one that does not";
    const auto with = traces("trace_frame", out);
    const auto without = traces("trace_frame_without_" + GetParam(), out);
    for (std::size_t i = 0; i < out.size(); ++i) {
        EXPECT_GT(with[i].size(), 500u);
        EXPECT_TRUE(with[i] == without[i])
            << out[i].scene << " at tier " << name(out[i].tier) << " pays for " << GetParam();
    }
}

TEST_P(OffIsFree, TheOtherBuildReallyLacksTheEffect) {
    // A scene that calls for the effect must look different to the program without it. One tier of a scene is enough.
    std::vector<Frame> in;
    for (const Frame& frame : frames(true)) {
        if (frame.tier != Tier::reference && (in.empty() || in.back().scene != frame.scene)) in.push_back(frame);
    }
    ASSERT_FALSE(in.empty()) << "no built-in scene calls for " << GetParam() << " at tier low or console";
    const auto with = traces("trace_frame", in);
    const auto without = traces("trace_frame_without_" + GetParam(), in);
    for (std::size_t i = 0; i < in.size(); ++i) EXPECT_FALSE(with[i] == without[i]) << in[i].scene;
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
