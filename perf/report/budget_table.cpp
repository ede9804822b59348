// The budget table: joins the rows of a budget with the passes of a plan and what was measured of them.
#include "perf/report/budget_table.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "engine/frame/effect_card.h"
#include "perf/report/budget_limits.h"
#include "perf/report/text_table.h"

namespace halfframe::perf {
namespace {

struct Row {
    std::string name;
    const BudgetRow* budget = nullptr;  ///< nullptr: the budget has no row of that name
    std::vector<std::string> effects;
    std::vector<std::size_t> passes;
    bool any_in = false;
    std::string why_out;  ///< why the first of its effects is out
};

/// Rows of the plan's effects in plan order, then the rest of the budget in its own order.
std::vector<Row> rows_of(const FramePlan& plan, const Budget& budget) {
    std::vector<Row> rows;
    const auto row_named = [&](const std::string& row_name) -> Row& {
        const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == row_name; });
        if (found != rows.end()) {
            return *found;
        }
        rows.push_back({.name = row_name,
                        .budget = budget.find(row_name),
                        .effects = {},
                        .passes = {},
                        .any_in = false,
                        .why_out = {}});
        return rows.back();
    };
    for (const EffectDecision& decision : plan.effects) {
        const EffectCard* card = find_effect(decision.effect);
        Row& row = row_named(card != nullptr ? std::string(card->budget_row) : decision.effect);
        row.effects.push_back(decision.effect);
        row.any_in = row.any_in || decision.in;
        if (!decision.in && row.why_out.empty()) {
            row.why_out = decision.why;
        }
        for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
            if (plan.passes[pass].effect == decision.effect) {
                row.passes.push_back(pass);
            }
        }
    }
    for (const BudgetRow& row : budget.rows) {
        row_named(row.name);
    }
    return rows;
}

/// The effects of a row together, on each device that was modelled.
void add_modelled(BudgetLine& line, const std::vector<std::string>& effects, const FrameReport& report) {
    if (!report.modelled) return;
    for (std::size_t column = 0; column < kModelledCount; ++column) {
        const ModelledDevice* device = report.modelled->find(kModelledDevices[column]);
        if (device == nullptr) continue;
        double most_ms = -1.0;
        for (const ModelledEffect& effect : device->effects) {
            if (std::find(effects.begin(), effects.end(), effect.effect) == effects.end()) continue;
            line.modelled_ms[column] = line.modelled_ms[column].value_or(0.0) + effect.ms;
            if (effect.ms > most_ms) line.modelled_bound[column] = effect.bound;
            most_ms = std::max(most_ms, effect.ms);
        }
    }
}

/// Columns that a row judges: those the budget lists, else the consoles that it names in words ("PS3 and X360").
std::vector<std::string> judged_columns(const BudgetRow& row) {
    if (!row.columns.empty()) return row.columns;
    constexpr std::array<const char*, kModelledCount> kWords{"PS3", "X360", "ES2"};
    std::vector<std::string> columns{kMeasuredColumn};
    for (std::size_t column = 0; column < kModelledCount; ++column)
        if (row.platforms.find(kWords[column]) != std::string::npos) columns.emplace_back(kModelledDevices[column]);
    return columns;
}

bool lists(const std::vector<std::string>& columns, std::string_view column) {
    return std::ranges::find(columns, column) != columns.end();
}

double allowed_ms(const BudgetRow& row) {
    return row.published_high_ms.value_or(row.published_ms.value_or(row.ours_ms.value_or(0.0)));
}

/// Where a modelled figure is above the row's: said always, and an error where the row says so.
void compare_modelled(BudgetLine& line, const Row& row, const FrameReport& report) {
    if (row.budget == nullptr || !report.modelled || row.budget->level == BudgetLevel::off) return;
    for (const std::string& column : judged_columns(*row.budget)) {
        const ModelledDevice* device = report.modelled->find(column);
        if (device == nullptr) continue;
        double ms = 0.0, most_ms = -1.0;
        std::string bound;
        for (const ModelledEffect& effect : device->effects) {
            if (!lists(row.effects, effect.effect)) continue;
            ms += effect.ms;
            if (effect.ms > most_ms) bound = effect.bound;
            most_ms = std::max(most_ms, effect.ms);
        }
        if (ms <= allowed_ms(*row.budget)) continue;
        line.modelled_over += fmt::format("{}{} over by {} ms: {}", line.modelled_over.empty() ? "modelled " : ", ",
                                          column, ms_text(ms - allowed_ms(*row.budget)), bound);
    }
    if (line.modelled_over.empty() || !row.budget->level) return;
    if (line.verdict != Verdict::over && line.verdict != Verdict::warned) line.verdict_text.clear();
    line.verdict = *row.budget->level == BudgetLevel::error ? Verdict::over : Verdict::warned;
}

void judge(BudgetLine& line, const Row& row, const FrameReport& report) {
    const auto say = [&](Verdict verdict, std::string text) {
        line.verdict = verdict;
        line.verdict_text = std::move(text);
    };
    if (row.effects.empty()) {
        say(Verdict::not_built, "not built");
    } else if (!row.any_in) {
        say(Verdict::not_called_for, "not called for");
    } else if (row.budget == nullptr) {
        say(Verdict::none, "no row in the budget");
    } else if (row.budget->level == BudgetLevel::off) {
        say(Verdict::none, "off");
    } else if (report.caps.software || !lists(judged_columns(*row.budget), kMeasuredColumn)) {
        say(Verdict::not_judged, line.published_ms && report.caps.software ? "not comparable here" : "not judged here");
    } else if (!line.measured) {
        say(Verdict::not_measured, "not measured");
    } else if (const double over_ms = line.measured->median_ms - allowed_ms(*row.budget); over_ms > 0.0) {
        const bool fails = row.budget->level.value_or(BudgetLevel::error) == BudgetLevel::error;
        say(fails ? Verdict::over : Verdict::warned, fmt::format("over by {} ms", ms_text(over_ms)));
    } else {
        say(Verdict::within, "within");
    }
}

void add_lines(BudgetTable& table, const Row& row, const FrameReport& report) {
    BudgetLine line;
    line.name = row.name;
    if (row.budget != nullptr) {
        line.published_ms = row.budget->published_ms;
        line.published_high_ms = row.budget->published_high_ms;
        line.ours_ms = row.budget->ours_ms;
        line.platforms = row.budget->platforms;
        line.source = row.budget->source;
        line.note = row.budget->note;
    }
    line.measured = measured_together(report, row.passes);
    for (const std::size_t pass : row.passes) {
        line.bytes += bytes_written(report.plan, report.plan.passes[pass]);
    }
    if (line.measured) {
        line.share_of_frame = line.measured->median_ms / table.frame_ms;
    }
    add_modelled(line, row.effects, report);
    judge(line, row, report);
    compare_modelled(line, row, report);
    if (!line.modelled_over.empty()) line.verdict_text += (line.verdict_text.empty() ? "" : "; ") + line.modelled_over;
    if (line.verdict == Verdict::not_called_for) {
        line.note = row.why_out;
    }
    table.lines.push_back(std::move(line));

    for (const std::size_t index : row.passes) {
        const Pass& pass = report.plan.passes[index];
        BudgetLine pass_line;
        pass_line.name = pass.name;
        pass_line.is_pass = true;
        pass_line.bytes = bytes_written(report.plan, pass);
        for (std::size_t column = 0; report.modelled && column < kModelledCount; ++column) {
            const ModelledDevice* device = report.modelled->find(kModelledDevices[column]);
            if (device == nullptr || index >= device->passes.size()) continue;
            pass_line.modelled_ms[column] = device->passes[index].ms;
            pass_line.modelled_bound[column] = device->passes[index].bound;
        }
        if (report.measurement) {
            pass_line.measured = report.measurement->passes[index];
            pass_line.share_of_frame = pass_line.measured->median_ms / table.frame_ms;
        }
        table.lines.push_back(std::move(pass_line));
    }
}

}  // namespace

const char* name(Verdict verdict) {
    switch (verdict) {
        case Verdict::none: return "none";
        case Verdict::within: return "within";
        case Verdict::over: return "over";
        case Verdict::warned: return "warned";
        case Verdict::not_built: return "not_built";
        case Verdict::not_called_for: return "not_called_for";
        case Verdict::not_measured: return "not_measured";
        case Verdict::not_judged: return "not_judged";
    }
    return "none";
}

bool BudgetTable::exceeded() const {
    const auto is_over = [](const auto& line) { return line.verdict == Verdict::over; };
    return std::any_of(lines.begin(), lines.end(), is_over) || std::any_of(limits.begin(), limits.end(), is_over);
}

bool BudgetTable::repeats_its_row(std::size_t index) const {
    const bool is_only_pass =
        lines[index].is_pass && !lines[index - 1].is_pass && (index + 1 == lines.size() || !lines[index + 1].is_pass);
    return is_only_pass && lines[index].name == lines[index - 1].name;
}

BudgetTable budget_table(const FrameReport& report, const Budget& budget, bool judge_frame) {
    BudgetTable table{.budget = budget.name, .frame_ms = budget.frame_ms, .lines = {}, .limits = {}};
    for (const Row& row : rows_of(report.plan, budget)) {
        add_lines(table, row, report);
    }
    for (const BudgetRow& row : budget.rows)
        for (const std::string& column : row.columns) expect_column(column, report, budget);
    table.limits = limit_lines(report, budget, judge_frame);
    return table;
}

}  // namespace halfframe::perf
