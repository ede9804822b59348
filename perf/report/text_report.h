// The terminal's view of a plan, a budget, a ledger, a census.
#pragma once

#include <string>
#include <vector>

#include "engine/frame/frame_plan.h"
#include "perf/report/budget_table.h"
#include "perf/report/frame_report.h"

namespace halfframe::perf {

/// Passes with reads, writes and formats; targets with sizes; effects in and out with the sentence why.
[[nodiscard]] std::string plan_text(const FramePlan& plan);

/// Rows and passes with published, allowed, modelled and measured figures in columns of their own, then the limits,
/// then the sources. `measurement` absent: the measured columns hold "-".
[[nodiscard]] std::string budget_text(const BudgetTable& table, const FrameReport& report);

/// Every program that was linked and why: its effect, who inserts code, its materials and draws, and its defines.
[[nodiscard]] std::string programs_text(const FrameReport& report);

/// Calls, draws and bytes of one steady frame by pass, the set-up above it, and the calls by name.
[[nodiscard]] std::string ledger_text(const FrameReport& report);

[[nodiscard]] std::string census_text(const std::vector<CensusRow>& rows);

/// "1280x720, tier console, full arithmetic, RGBA16F storage".
[[nodiscard]] std::string configuration_text(const FramePlan& plan);
/// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL ES 3.2 Mesa 22.3.6, device native".
[[nodiscard]] std::string driver_text(const gl::Caps& caps);
/// A modelled figure of a line, or "-".
[[nodiscard]] std::string modelled_text(const BudgetLine& line, int column);
/// The modelled frame on every device with its band, and the words that stand under such figures.
[[nodiscard]] std::string modelled_frame_text(const Modelled& modelled);
/// The published figure of a line: "1.70", "0.500..1.50" or "-".
[[nodiscard]] std::string published_text(const BudgetLine& line);

}  // namespace halfframe::perf
