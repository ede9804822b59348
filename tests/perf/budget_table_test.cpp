// The budget table compares only what may be compared.
#include "perf/report/budget_table.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/frame/effect_card.h"
#include "perf/report/text_report.h"

namespace halfframe::perf {
namespace {

/// One pass of the first built effect, measured at 5 ms, on 100x100 RGBA8.
FrameReport sample_report(bool software) {
    FrameReport report;
    report.scene = "sample";
    report.caps.software = software;
    report.plan.width = 100;
    report.plan.height = 100;
    report.plan.targets.push_back({.name = "display", .format = gl::PixelFormat::rgba8, .width = 100, .height = 100});
    report.plan.display = 0;
    const EffectCard& card = *all_effects().front();
    Pass pass;
    pass.name = "sample_pass";
    pass.effect = card.name;
    pass.color = 0;
    report.plan.passes.push_back(pass);
    EffectDecision decision;
    decision.effect = card.name;
    decision.in = true;
    decision.why = "the sample calls for it";
    report.plan.effects.push_back(decision);
    report.frame_calls.passes.push_back({.pass = "sample_pass",
                                         .calls = 9,
                                         .draws = 3,
                                         .vertices = 9,
                                         .bytes_uploaded = 0,
                                         .bytes_read_back = 0,
                                         .by_name = {}});
    Measurement measurement;
    measurement.passes.push_back({.median_ms = 5.0, .low_ms = 4.0, .high_ms = 6.0, .frames = 3});
    measurement.samples.push_back({4.0, 5.0, 6.0});
    measurement.frame = {.median_ms = 50.0, .low_ms = 49.0, .high_ms = 51.0, .frames = 3};
    report.measurement = measurement;
    return report;
}

Budget sample_budget() {
    Budget budget;
    budget.name = "sample";
    budget.frame_ms = 20.0;
    budget.target_mib = 1.0;
    budget.draws = 3;
    BudgetRow row;
    row.name = std::string(all_effects().front()->budget_row);
    row.ours_ms = 2.0;
    row.source = "a sample";
    budget.rows.push_back(row);
    BudgetRow unbuilt;
    unbuilt.name = "an_effect_that_does_not_exist";
    unbuilt.published_ms = 0.5;
    unbuilt.published_high_ms = 1.5;
    unbuilt.platforms = "PS3";
    unbuilt.source = "a talk";
    budget.rows.push_back(unbuilt);
    return budget;
}

const BudgetLine& line_named(const BudgetTable& table, const std::string& name) {
    const auto found =
        std::find_if(table.lines.begin(), table.lines.end(), [&](const BudgetLine& line) { return line.name == name; });
    EXPECT_NE(found, table.lines.end()) << name;
    return *found;
}

const LimitLine& limit_named(const BudgetTable& table, const std::string& name) {
    const auto found = std::find_if(table.limits.begin(), table.limits.end(),
                                    [&](const LimitLine& line) { return line.name == name; });
    EXPECT_NE(found, table.limits.end()) << name;
    return *found;
}

std::string first_row() { return std::string(all_effects().front()->budget_row); }

TEST(BudgetTable, a_software_driver_is_never_compared_with_a_console) {
    const BudgetTable table = budget_table(sample_report(true), sample_budget(), false);
    EXPECT_EQ(line_named(table, first_row()).verdict, Verdict::not_judged);
    EXPECT_EQ(limit_named(table, "frame").verdict, Verdict::not_judged);
    EXPECT_FALSE(table.exceeded());
}

TEST(BudgetTable, a_named_budget_judges_the_frame_even_there) {
    const BudgetTable table = budget_table(sample_report(true), sample_budget(), true);
    EXPECT_EQ(limit_named(table, "frame").verdict, Verdict::over);
    EXPECT_EQ(limit_named(table, "frame").verdict_text, "over by 30.00 ms: most in sample_pass, 5.00 ms");
    EXPECT_TRUE(table.exceeded());
}

TEST(BudgetTable, a_real_device_is_judged) {
    FrameReport report = sample_report(false);
    const BudgetTable over = budget_table(report, sample_budget(), false);
    EXPECT_EQ(line_named(over, first_row()).verdict, Verdict::over);
    EXPECT_EQ(line_named(over, first_row()).verdict_text, "over by 3.00 ms");
    EXPECT_DOUBLE_EQ(line_named(over, first_row()).share_of_frame.value_or(0.0), 0.25);
    report.measurement->passes[0].median_ms = 1.5;
    report.measurement->samples[0] = {1.5, 1.5, 1.5};
    report.measurement->frame.median_ms = 10.0;
    const BudgetTable within = budget_table(report, sample_budget(), false);
    EXPECT_EQ(line_named(within, first_row()).verdict, Verdict::within);
    EXPECT_FALSE(within.exceeded());
}

TEST(BudgetTable, memory_and_draws_are_judged_on_every_driver) {
    FrameReport report = sample_report(true);
    EXPECT_EQ(limit_named(budget_table(report, sample_budget(), false), "draws").verdict, Verdict::within);
    report.frame_calls.passes[0].draws = 4;
    EXPECT_EQ(limit_named(budget_table(report, sample_budget(), false), "draws").verdict, Verdict::over);
    report.plan.targets[0].width = 10000;  // 10000 x 100 x 4 B = 3.81 MiB
    const BudgetTable table = budget_table(report, sample_budget(), false);
    EXPECT_EQ(limit_named(table, "targets").verdict, Verdict::over);
    EXPECT_EQ(limit_named(table, "targets").value, "3.81 MiB");
    EXPECT_TRUE(table.exceeded());
}

TEST(BudgetTable, every_row_of_the_budget_is_there_built_or_not) {
    const BudgetTable table = budget_table(sample_report(true), sample_budget(), false);
    const BudgetLine& unbuilt = line_named(table, "an_effect_that_does_not_exist");
    EXPECT_EQ(unbuilt.verdict_text, "not built");
    EXPECT_FALSE(unbuilt.measured.has_value());
    EXPECT_EQ(published_text(unbuilt), "0.500..1.50");
}

TEST(BudgetTable, an_effect_that_is_out_says_so) {
    FrameReport report = sample_report(true);
    report.plan.effects[0].in = false;
    report.plan.effects[0].why = "nothing calls for it";
    report.plan.passes.clear();
    report.measurement->passes.clear();
    report.measurement->samples.clear();
    const BudgetTable table = budget_table(report, sample_budget(), false);
    EXPECT_EQ(line_named(table, first_row()).verdict, Verdict::not_called_for);
    EXPECT_EQ(line_named(table, first_row()).note, "nothing calls for it");
}

TEST(BudgetTable, passes_stand_under_their_row_with_the_bytes_they_write) {
    const BudgetTable table = budget_table(sample_report(true), sample_budget(), false);
    ASSERT_GE(table.lines.size(), 2u);
    EXPECT_FALSE(table.lines[0].is_pass);
    EXPECT_TRUE(table.lines[1].is_pass);
    EXPECT_EQ(table.lines[1].name, "sample_pass");
    EXPECT_EQ(table.lines[1].bytes, 40000u);
    EXPECT_EQ(table.lines[0].bytes, 40000u);
}

TEST(BudgetTable, two_passes_of_a_row_are_added_frame_by_frame) {
    FrameReport report = sample_report(false);
    report.plan.passes.push_back(report.plan.passes[0]);
    report.measurement->passes.push_back({.median_ms = 1.0, .low_ms = 1.0, .high_ms = 9.0, .frames = 3});
    report.measurement->samples.push_back({9.0, 1.0, 1.0});
    const BudgetTable table = budget_table(report, sample_budget(), false);
    // Frames are 13, 6 and 7 ms: the median is 7, where the medians of the passes would add to 6.
    ASSERT_TRUE(line_named(table, first_row()).measured.has_value());
    EXPECT_DOUBLE_EQ(line_named(table, first_row()).measured->median_ms, 7.0);
}

TEST(BudgetText, keeps_the_columns_of_the_model_and_names_the_sources) {
    const FrameReport report = sample_report(true);
    const std::string text = budget_text(budget_table(report, sample_budget(), false), report);
    for (const char* expected : {"published", "ours", "ps3", "x360", "es2", "here", "verdict", "[2] PS3: a talk",
                                 "(by --cost,", "not built"}) {
        EXPECT_NE(text.find(expected), std::string::npos) << expected << " is missing in\n" << text;
    }
}

TEST(BudgetTable, modelled_figures_stand_in_their_columns_and_say_what_binds) {
    FrameReport report = sample_report(true);
    Budget budget = sample_budget();
    budget.rows[0].platforms = "PS3";  // Xbox 360 is dearer, and not what the row speaks of
    report.modelled = Modelled{.arithmetic = "half", .words = "Modelled, not measured.", .devices = {}};
    const std::string effect(all_effects().front()->name);
    for (const auto& [device, ms] : {std::pair{"ps3", 2.25}, std::pair{"x360", 9.0}}) {
        report.modelled->devices.push_back({.name = device,
                                            .frame_ms = ms,
                                            .low_ms = ms,
                                            .high_ms = ms,
                                            .passes = {{"sample_pass", ms + 1.0, ms, ms, "memory"}},
                                            .effects = {{effect, ms, "shader"}}});
    }
    const BudgetTable table = budget_table(report, budget, false);
    const BudgetLine& row = line_named(table, first_row());
    EXPECT_EQ(row.modelled_ms[0], 2.25);
    EXPECT_EQ(row.modelled_ms[1], 9.0);
    EXPECT_FALSE(row.modelled_ms[2].has_value());
    EXPECT_EQ(row.modelled_over, "modelled ps3 over by 0.250 ms: shader");
    EXPECT_EQ(row.verdict, Verdict::not_judged);  // a model fails nothing
    EXPECT_EQ(row.measured->median_ms, 5.0);
    EXPECT_EQ(line_named(table, "sample_pass").modelled_ms[0], 3.25);
    EXPECT_EQ(line_named(table, "sample_pass").modelled_bound[0], "memory");
    const std::string text = budget_text(table, report);
    EXPECT_NE(text.find("Modelled frame, half arithmetic: ps3 2.25 ms"), std::string::npos) << text;
    EXPECT_EQ(text.find("--cost"), std::string::npos) << text;
}

TEST(BudgetText, a_pass_that_repeats_its_row_is_left_out_for_people) {
    FrameReport report = sample_report(true);
    BudgetTable table = budget_table(report, sample_budget(), false);
    EXPECT_FALSE(table.repeats_its_row(1));
    report.plan.passes[0].name = first_row();
    table = budget_table(report, sample_budget(), false);
    EXPECT_TRUE(table.repeats_its_row(1));
    EXPECT_FALSE(table.repeats_its_row(0));
    report.plan.passes.push_back(report.plan.passes[0]);
    report.measurement.reset();
    table = budget_table(report, sample_budget(), false);
    EXPECT_FALSE(table.repeats_its_row(1));
    EXPECT_FALSE(table.repeats_its_row(2));
}

}  // namespace
}  // namespace halfframe::perf
