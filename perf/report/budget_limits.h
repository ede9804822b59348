// Limits of a budget held against one frame.
#pragma once

#include <string>
#include <vector>

#include "perf/report/budget_table.h"

namespace halfframe::perf {

/// One line for each limit that fits the report's scene, camera and tier, in the order of Budget::limits_for(). A
/// column that is no profile here: Error(input) naming the budget and the nearest. `judge_frame` as in budget_table().
[[nodiscard]] std::vector<LimitLine> limit_lines(const FrameReport& report, const Budget& budget, bool judge_frame);

/// The passes of a row together: added frame by frame, since a sum of medians is the median of nothing.
[[nodiscard]] std::optional<PassTimer::Summary> measured_together(const FrameReport& report,
                                                                  const std::vector<std::size_t>& passes);

/// Error(input) for a column that neither this frame was modelled on nor halfframe knows.
void expect_column(const std::string& column, const FrameReport& report, const Budget& budget);

}  // namespace halfframe::perf
