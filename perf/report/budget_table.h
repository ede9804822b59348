// The budget table: what was published, what is allowed, what was measured here, and what may be compared with what.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "perf/report/frame_report.h"

namespace halfframe::perf {

enum class Verdict {
    none,  ///< nothing to say: a line that only informs
    within,
    over,            ///< the only one that fails
    warned,          ///< over, and only warned of
    not_built,       ///< the budget has a row for an effect that does not exist
    not_called_for,  ///< the scene does not ask for the effect
    not_measured,
    not_judged,  ///< a figure of another device than this one
};

/// One line: a row of the budget, or (with `is_pass`) a pass that belongs to the row above it.
/// Published, allowed, modelled and measured figures stand in columns of their own and are never mixed: a modelled
/// column exists for each device the cost model knows, and is empty where it was not computed.
struct BudgetLine {
    std::string name;
    bool is_pass = false;
    std::optional<double> published_ms;
    std::optional<double> published_high_ms;
    std::optional<double> ours_ms;
    std::string platforms;  ///< of the published figure
    std::string source;
    std::string note;
    std::array<std::optional<double>, kModelledCount> modelled_ms;  ///< by kModelledColumns
    std::array<std::string, kModelledCount> modelled_bound;         ///< the unit that takes most
    /// Where a modelled figure is above the row's in the columns that it judges: by how much, and what binds it.
    std::string modelled_over;
    std::optional<PassTimer::Summary> measured;
    std::optional<double> share_of_frame;  ///< measured median over the budget's frame, 1 = all of it
    std::size_t bytes = 0;                 ///< of the targets written
    Verdict verdict = Verdict::none;
    std::string verdict_text;
};

/// A limit that fits the frame: of all of it, of a pass, of an effect or of a counter.
struct LimitLine {
    std::string name;  ///< "frame", "targets", "draws", "surface on ps3", "draws of shadow"
    std::string value;
    std::string limit;
    Verdict verdict = Verdict::none;
    std::string verdict_text;  ///< of one above its limit: by how much, and what binds it or takes most of it
    BudgetLevel level = BudgetLevel::error;
    std::optional<double> number = std::nullopt;  ///< `value`; empty where there is none
    double most = 0.0;                            ///< `limit`
    std::string unit = {};                        ///< "ms", "MiB", "B", "" for counters
    std::string source = {};
};

struct BudgetTable {
    std::string budget;
    double frame_ms = 33.3;
    std::vector<BudgetLine> lines;
    std::vector<LimitLine> limits;
    [[nodiscard]] bool exceeded() const;  ///< some line or limit is `over`
    /// Line `index` is a pass that says the same as the row above it: its only pass, of the same name. People need one
    /// of the two.
    [[nodiscard]] bool repeats_its_row(std::size_t index) const;
};

/// Limits are those of `budget` that fit the scene, camera and tier of the report. Memory and draws are always judged;
/// what the cost model gives (its columns, other counters) where it ran. Rows say where they are over in a modelled
/// column, and fail of it where the budget gives them the level error. Measured milliseconds of rows and of the frame
/// are judged on a real device only: on a software driver they are figures of another machine, and say so.
/// `judge_frame` judges the frame's milliseconds even there: the user named a budget for this machine. Error(input) for
/// a column that is no profile here.
[[nodiscard]] BudgetTable budget_table(const FrameReport& report, const Budget& budget, bool judge_frame);

[[nodiscard]] const char* name(Verdict verdict);

}  // namespace halfframe::perf
