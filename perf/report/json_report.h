// The same facts for machines. Keys carry their units; an absent figure is null, never 0.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/frame/frame_plan.h"
#include "engine/gl/caps.h"
#include "perf/report/budget_table.h"
#include "perf/report/frame_report.h"

namespace halfframe::perf {

[[nodiscard]] nlohmann::ordered_json plan_json(const FramePlan& plan);
[[nodiscard]] nlohmann::ordered_json caps_json(const gl::Caps& caps);
[[nodiscard]] nlohmann::ordered_json calls_json(const CallReport& calls);
[[nodiscard]] nlohmann::ordered_json budget_json(const BudgetTable& table);
/// Plan, driver, budget, measurement, calls, census and notices of one rendering.
[[nodiscard]] nlohmann::ordered_json report_json(const FrameReport& report, const BudgetTable& table);

}  // namespace halfframe::perf
