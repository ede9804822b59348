// Prices of effects as plans read them, and tiers that fit a frame.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "content/content.h"
#include "content/data_files.h"
#include "engine/error.h"
#include "engine/frame/cost_table.h"
#include "perf/cost/effect_table.h"
#include "perf/cost/model.h"
#include "tests/cost/command.h"
#include "tests/cost/json_schema.h"

namespace halfframe::cost {
namespace {

using nlohmann::json;

std::string kept(const char* path) {
    for (const content::DataFile& file : content::data_files())
        if (std::string_view(file.path) == path) return std::string(file.text);
    ADD_FAILURE() << path;
    return "{}";
}

constexpr const char* kRefresh =
    "content/costs/prices.json is stale. Refresh it with\n"
    "  build/release/halfframe cost --refresh-tables content/costs/effects.json";

TEST(Prices, AreThoseOfTheShadersAndProfilesHere) {
    const json prices = json::parse(kept("costs/prices.json"));
    EXPECT_EQ(prices.at("counts"), counts_fingerprint(kept("costs/effects.json"))) << kRefresh;
    EXPECT_EQ(prices.at("model_version"), kModelVersion) << kRefresh;
    EXPECT_EQ(schema_violation(schema_named("prices.schema.json"), prices), "");
}

/// One view of every scene that prices come from, each tier among them: what moves a scene, a plan or how draws are
/// counted shows in one of these. All of them are counted by the command that refreshes.
TEST(Prices, AreThoseOfTheScenesHere) {
    const json prices = json::parse(kept("costs/prices.json"));
    const std::map<std::string, std::string> tiers{{"street", "low"},
                                                   {"test_room", "console"},
                                                   {"memory_room", "console"},
                                                   {"spheres", "reference"},
                                                   {"lamps", "low"}};
    std::set<std::string> scenes;
    for (const json& view : prices.at("views")) scenes.insert(view.at("scene").get<std::string>());
    for (const std::string& scene : scenes) {
        ASSERT_TRUE(tiers.contains(scene)) << scene << ": name a tier to count it at";
        const std::string& tier = tiers.at(scene);
        const Answer counted =
            halfframe({"cost", scene, "--size", "640x360", "--tier", tier, "--budget", "none", "--json"});
        ASSERT_EQ(counted.code, 0) << counted.err;
        const json cost = json::parse(counted.out);
        int compared = 0;
        for (const json& view : prices.at("views")) {
            if (view.at("scene") != scene || view.at("size") != "640x360" || view.at("tier") != tier) continue;
            if (view.at("camera") != cost.at("camera")) continue;
            for (const json& device : cost.at("devices")) {
                ++compared;
                // 1e-4: the table keeps four digits behind the point.
                EXPECT_NEAR(view.at(device.at("profile").get<std::string>() + "_ms").get<double>(),
                            device.at("frame_ms").get<double>(), 1e-4)
                    << scene << ", " << tier << ": " << kRefresh;
            }
        }
        EXPECT_EQ(compared, 3) << scene << ": " << kRefresh;
    }
    EXPECT_EQ(scenes.size(), tiers.size());
}

gl::Caps rich_caps() {
    gl::Caps caps;
    caps.es_version = 32;
    caps.max_texture_size = caps.max_cube_map_size = caps.max_renderbuffer_size = 4096;
    caps.max_vertex_attributes = 16;
    caps.max_vertex_uniform_vectors = caps.max_fragment_uniform_vectors = 1024;
    caps.max_varying_vectors = 31;
    caps.max_fragment_samplers = caps.max_vertex_samplers = 32;
    caps.max_combined_samplers = 64;
    caps.renders.fill(true);
    caps.device = "rich";
    return caps;
}

class Fitting : public testing::Test {
protected:
    BudgetedTiers fitted(double ms, Wishes wishes = {}, std::string device = "ps3") {
        return budgeted_tiers({.device = std::move(device), .ms = ms}, table_, scene_, view_, wishes, caps_,
                              all_effects());
    }
    static int worth(const FramePlan& plan) {
        int sum = 0;
        for (const EffectDecision& decision : plan.effects)
            sum += decision.in ? std::array{0, 10, 11}.at(static_cast<std::size_t>(decision.tier)) : 0;
        return sum;
    }

    CostTable table_ = content::cost_table();
    Scene scene_ = content::open_scene("test_room");
    View view_ =
        view_of(scene_.cameras.empty() ? camera_framing(world_box(scene_), 1.7f) : scene_.cameras.front(), 1280, 720);
    gl::Caps caps_ = rich_caps();
};

TEST_F(Fitting, EveryEffectOfTheBuiltInScenesHasAPriceOnEveryDevice) {
    EXPECT_EQ(table_.devices(), (std::vector<std::string>{"ps3", "x360", "es2_class"}));
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        const FramePlan plan = plan_frame(scene_, view_, {.tier = tier}, caps_, all_effects());
        for (const std::string& device : table_.devices()) {
            for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
                const FrameEstimate estimate = estimate_frame(plan, table_, device, arithmetic);
                EXPECT_GT(estimate.ms(), 0.0);
                for (const EffectEstimate& effect : estimate.effects)
                    EXPECT_TRUE(effect.priced) << effect.effect << " " << name(tier) << " " << device;
                EXPECT_LE(estimate.least_ms(), estimate.ms());
                EXPECT_LE(estimate.ms(), estimate.most_ms());
            }
        }
    }
    EXPECT_THROW((void)estimate_frame({}, table_, "ps4"), Error);
}

TEST_F(Fitting, LessTimeNeverGivesMore) {
    int before = 1000;
    bool seen_unfit = false;
    for (const double ms : {1000.0, 60.0, 40.0, 33.3, 25.0, 16.6, 10.0, 5.0, 2.0, 0.01}) {
        const BudgetedTiers chosen = fitted(ms);
        EXPECT_EQ(chosen.fits, chosen.estimate.ms() <= ms) << ms;
        EXPECT_FALSE(chosen.fits && broken_rule(chosen.plan, caps_).has_value()) << ms;
        EXPECT_LE(worth(chosen.plan), before) << ms;
        before = worth(chosen.plan);
        seen_unfit = seen_unfit || !chosen.fits;
        // The wishes alone lead to the same plan.
        const FramePlan again = plan_frame(scene_, view_, chosen.wishes, caps_, all_effects());
        EXPECT_EQ(estimate_frame(again, table_, "ps3").ms(), chosen.estimate.ms());
    }
    EXPECT_TRUE(seen_unfit);
    const BudgetedTiers all = fitted(1000.0);
    EXPECT_EQ(all.plan.tier, Tier::reference);
    EXPECT_TRUE(all.steps.empty());
}

TEST_F(Fitting, WhatIsWishedStays) {
    const BudgetedTiers pinned = fitted(8.0, {.tier = Tier::console, .effect_tiers = {{"surface", Tier::console}}});
    EXPECT_EQ(pinned.plan.find("surface")->tier, Tier::console);
    EXPECT_LE(static_cast<int>(pinned.plan.tier), static_cast<int>(Tier::console));
    EXPECT_THROW((void)fitted(0.0), Error);
    EXPECT_THROW((void)fitted(10.0, {}, "ps4"), Error);
}

TEST_F(Fitting, TheCommandShowsTheEstimateAndWhatWasGivenUp) {
    const Answer plan = halfframe({"plan", "test_room", "--fit", "ps3=8"});
    EXPECT_EQ(plan.code, 0) << plan.err;
    expect_in(plan.out, "estimate");
    expect_in(plan.err, "--fit ps3=8: ");
    EXPECT_EQ(halfframe({"plan", "test_room", "--fit", "ps3=0"}).code, 2);
    EXPECT_EQ(halfframe({"plan", "test_room", "--fit", "ps3=8x"}).code, 2);
    const Answer unknown = halfframe({"plan", "test_room", "--fit", "ps33=8"});
    EXPECT_EQ(unknown.code, 2);
    expect_in(unknown.err, "did you mean 'ps3'?");
}

}  // namespace
}  // namespace halfframe::cost
