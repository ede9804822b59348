// Compares the traces of trace_frame and of trace_frame_without_<effect> wherever the plan leaves the effect out.
#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/frame/frame_plan.h"
#include "perf/process/child_process.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {
namespace {

process::ChildResult trace(const std::string& program, std::string_view scene, Tier tier) {
    return process::run_child(
        {.arguments = {std::string(TRACE_FRAME_FOLDER) + "/" + program, std::string(scene), name(tier)}});
}

class OffIsFree : public harness::GlFixture, public testing::WithParamInterface<std::string> {};

TEST_P(OffIsFree, TheTraceIsThatOfABuildWithoutTheEffect) {
    const std::string effect = GetParam();
    int compared = 0;
    for (const content::BuiltInScene& built_in : content::built_in_scenes()) {
        const Scene scene = built_in.make();
        const View view = view_of(scene.cameras.empty() ? camera_framing(Box{}, 1.0f) : scene.cameras.front(), 64, 64);
        for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
            const FramePlan plan =
                plan_frame(scene, view, {.tier = tier, .arithmetic = Arithmetic::full}, caps(), all_effects());
            if (plan.find(effect)->in) continue;
            const auto with = trace("trace_frame", built_in.name, tier);
            const auto without = trace("trace_frame_without_" + effect, built_in.name, tier);
            ASSERT_EQ(with.exit_code, 0) << with.story();
            ASSERT_EQ(without.exit_code, 0) << without.story();
            EXPECT_GT(with.output.size(), 500u);
            EXPECT_EQ(with.output, without.output)
                << built_in.name << " at tier " << name(tier) << " pays for " << effect;
            ++compared;
        }
    }
    EXPECT_GT(compared, 0) << "every built-in scene calls for " << effect << ": add one that does not";
}

TEST_P(OffIsFree, TheOtherBuildReallyLacksTheEffect) {
    // A scene that calls for the effect must look different to the program without it.
    const std::string effect = GetParam();
    int compared = 0;
    for (const content::BuiltInScene& built_in : content::built_in_scenes()) {
        const Scene scene = built_in.make();
        if (scene.cameras.empty()) continue;
        for (const Tier tier : {Tier::low, Tier::console}) {  // not every effect has a low tier
            const FramePlan plan = plan_frame(scene, view_of(scene.cameras.front(), 64, 64),
                                              {.tier = tier, .arithmetic = Arithmetic::full}, caps(), all_effects());
            if (!plan.find(effect)->in) continue;
            const auto with = trace("trace_frame", built_in.name, tier);
            const auto without = trace("trace_frame_without_" + effect, built_in.name, tier);
            EXPECT_EQ(with.exit_code, 0) << with.story();
            EXPECT_NE(with.output, without.output) << built_in.name;
            ++compared;
            break;
        }
    }
    EXPECT_GT(compared, 0) << "no built-in scene calls for " << effect << " at tier low or console";
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
