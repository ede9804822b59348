// Limits that fit scenes, cameras and tiers: which one decides, what is said of one that is exceeded, and bad files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "content/content.h"
#include "content/data_files.h"
#include "engine/error.h"
#include "perf/report/budget_limits.h"
#include "tests/cost/command.h"
#include "tests/cost/json_schema.h"

namespace halfframe::cost {
namespace {

using nlohmann::json;
using Of = BudgetLimit::Of;

TEST(BudgetLimits, PatternsCoverTheWholeText) {
    EXPECT_TRUE(matches_pattern("*", ""));
    EXPECT_TRUE(matches_pattern("street", "street"));
    EXPECT_FALSE(matches_pattern("street", "streets"));
    EXPECT_TRUE(matches_pattern("*.glb", "fox.glb"));
    EXPECT_FALSE(matches_pattern("*.glb", "fox.gltf"));
    EXPECT_TRUE(matches_pattern("a*b*c", "aXbXbXc"));
    EXPECT_FALSE(matches_pattern("a*b*c", "aXbXb"));
    EXPECT_FALSE(matches_pattern("", "a"));
}

json budget_json(const json& limits) {
    return {{"name", "mine"}, {"frame_ms", 16.6}, {"draws", 100}, {"limits", limits}};
}

Budget budget_of(const json& limits) {
    return content::budget(temporary("halfframe_budget.json", budget_json(limits).dump()));
}

TEST(BudgetLimits, TheLastThatFitsDecides) {
    const json draws = {{"counter", "draws"}, {"most", 10}};
    const json more = {{"counter", "draws"}, {"most", 20}, {"level", "warn"}};
    const Budget budget = budget_of({{{"scene", "str*"}, {"counters", {draws}}},
                                     {{"tier", "low"}, {"counters", {more}}},
                                     {{"camera", "roof"}, {"targets", {{"mib", 3}}}}});
    const auto draws_of = [&](const char* scene, const char* camera, const char* tier) {
        for (const BudgetLimit& limit : budget.limits_for(scene, camera, tier))
            if (limit.of == Of::counter) return limit.most;
        return -1.0;
    };
    EXPECT_EQ(draws_of("room", "", "console"), 100.0);  // the figure at the top
    EXPECT_EQ(draws_of("street", "", "console"), 10.0);
    EXPECT_EQ(draws_of("street", "", "low"), 20.0);
    EXPECT_EQ(budget.limits_for("street", "roof", "low").size(), 3u);  // measured frame, draws, targets
    EXPECT_EQ(budget.limits_for("street", "", "low").size(), 2u);
}

TEST(BudgetLimits, BadFilesNamePlaceAndNearest) {
    const auto message = [](const json& limits) -> std::string {
        try {
            (void)budget_of(limits);
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::input);
            return error.what();
        }
        return "";
    };
    const json frame = {{{"column", "ps3"}, {"ms", 33.3}}};
    EXPECT_EQ(message({{{"frame", frame}}}), "");
    expect_in(message({{{"frames", frame}}}), "/limits/0: unknown key 'frames', did you mean 'frame'?");
    expect_in(message({{{"tier", "lo"}, {"frame", frame}}}), "/limits/0/tier: unknown word 'lo', did you mean 'low'?");
    expect_in(message({{{"frame", {{{"column", "ps3"}, {"ms", "33"}}}}}}), "/limits/0/frame/0/ms");
    expect_in(message({{{"frame", {{{"column", "ps3"}, {"ms", -1}}}}}}), "/limits/0/frame/0/ms: is -1");
    expect_in(message({{{"frame", {{{"column", "ps3"}}}}}}), "'ms' is missing");
    EXPECT_EQ(message({{{"frame", {{{"column", "ps3"}, {"level", "off"}}}}}}), "");
    expect_in(message({{{"frame", {{{"column", "ps3"}, {"ms", 1}, {"level", "eror"}}}}}}), "did you mean 'error'?");
    expect_in(message({{{"counters", {{{"counter", "drawz"}, {"most", 1}}}}}}), "did you mean 'draws'?");
    expect_in(message({{{"frame", {frame[0], frame[0]}}}}), "/limits/0/frame/1: limits what an earlier one");
    expect_in(message({{{"scene", "street"}}}), "/limits/0: limits nothing");
    expect_in(message({{{"passes", 3}}}), "/limits/0/passes: must be an array");
    expect_in(message(json::array({3})), "/limits/0");
    expect_in(message("x"), "/limits: must be an array");
}

TEST(BudgetLimits, FilesFollowThePublishedSchema) {
    int files = 0;
    for (const content::DataFile& file : content::data_files()) {
        if (!std::string(file.path).starts_with("budgets/")) continue;
        ++files;
        EXPECT_EQ(schema_violation(schema_named("budget.schema.json"), json::parse(file.text)), "") << file.path;
    }
    EXPECT_GT(files, 0);
    EXPECT_NE(schema_violation(schema_named("budget.schema.json"), budget_json({{{"frames", 1}}})), "");
}

Answer judged_with(const json& budget, std::vector<std::string> more = {}) {
    const std::string file = temporary("halfframe_judged.json", budget.dump());
    std::vector<std::string> words{"cost", "test_room", "--size", "160x90", "--budget", file};
    words.insert(words.end(), more.begin(), more.end());
    return halfframe(words);
}

TEST(BudgetLimits, WhatIsOverSaysByHowMuchAndWhatBinds) {
    json budget = budget_json({{{"scene", "test_*"},
                                {"frame", {{{"column", "ps3"}, {"ms", 0.01}}}},
                                {"passes", {{{"pass", "surface"}, {"column", "x360"}, {"ms", 0.01}}}},
                                {"effects", {{{"effect", "shadow"}, {"column", "es2_class"}, {"ms", 0.01}}}},
                                {"counters", {{{"counter", "draws"}, {"most", 2}}}},
                                {"targets", {{"mib", 0.01}}},
                                {"bytes_per_pixel", {{"most", 1}, {"level", "warn"}}}}});
    const Answer over = judged_with(budget);
    EXPECT_EQ(over.code, 1) << over.err;
    expect_in(over.err, "failed: test_room");
    expect_in(over.err, ": frame on ps3 ");
    expect_in(over.err, "surface on x360 ");
    expect_in(over.err, "effect shadow on es2_class ");
    expect_in(over.err, "is over by ");
    expect_in(over.err, ": most in shadow, ");
    expect_in(over.err, "most in shadow_map, ");
    expect_in(over.err, "warning: test_room");
    budget["limits"][0]["scene"] = "street";
    budget["draws"] = 1000;
    EXPECT_EQ(judged_with(budget).code, 0);
}

TEST(BudgetLimits, OnlyAnErrorFails) {
    json budget = budget_json({{{"frame", {{{"column", "ps3"}, {"ms", 0.01}, {"level", "warn"}}}}}});
    budget["draws"] = 1000;
    const Answer warned = judged_with(budget);
    EXPECT_EQ(warned.code, 0);
    expect_in(warned.err, "warning: test_room");
    budget["limits"][0]["frame"][0]["level"] = "off";
    const Answer off = judged_with(budget);
    EXPECT_EQ(off.code, 0);
    EXPECT_EQ(off.err.find("warning"), std::string::npos) << off.err;
    budget["rows"] = {{{"name", "surface"}, {"ours_ms", 0.001}, {"source", "a test"}, {"columns", {"x360"}}}};
    EXPECT_EQ(judged_with(budget).code, 0);  // said in the table, and no more
    budget["rows"][0]["level"] = "error";
    const Answer row = judged_with(budget);
    EXPECT_EQ(row.code, 1);
    expect_in(row.err, "surface is modelled x360 over by ");
}

TEST(BudgetLimits, AColumnThatIsNoProfileIsRefused) {
    const Answer wrong = judged_with(budget_json({{{"frame", {{{"column", "ps4"}, {"ms", 1}}}}}}));
    EXPECT_EQ(wrong.code, 3);
    expect_in(wrong.err, "no column is called 'ps4', did you mean 'ps3'?");
    const Answer pass =
        judged_with(budget_json({{{"passes", {{{"pass", "surfase"}, {"column", "ps3"}, {"ms", 1}}}}}}), {"--json"});
    expect_in(pass.out, "no pass 'surfase' in this frame, did you mean 'surface'?");
}

}  // namespace
}  // namespace halfframe::cost
