// --fit: the best tiers that fit a frame budget, by the table of prices.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/frame/cost_table.h"
#include "perf/cli/scene_options.h"

namespace halfframe::cli {

/// "ps3", "ps3=16.6": a device of the cost table, and milliseconds (33.3). Error(usage) for anything else.
[[nodiscard]] FrameBudget parse_fit(const std::string& words, Arithmetic arithmetic);

/// Chooses tiers for the opened scene as --fit asks: its wishes change, and a notice says what was given up. Does
/// nothing without --fit.
void fit_to_budget(OpenedScene& opened, const SceneOptions& options, const gl::Caps& caps);

/// "--tier console --tier shadow=low": what asks for the same tiers by hand.
[[nodiscard]] std::string tiers_text(const Wishes& wishes);

/// What a plan costs by the table, one line an effect and column a device. Columns come in the table's order.
[[nodiscard]] std::string estimate_text(const FramePlan& plan, const CostTable& table, Arithmetic arithmetic);

/// The same for machines: a list of devices with their effects; null where the table has no price.
[[nodiscard]] nlohmann::ordered_json estimate_json(const FramePlan& plan, const CostTable& table,
                                                   Arithmetic arithmetic);

}  // namespace halfframe::cli
