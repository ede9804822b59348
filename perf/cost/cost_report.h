// A frame's cost for people and for machines.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "perf/cost/frame_cost.h"
#include "perf/report/budget_table.h"

namespace halfframe::cost {

/// Counts, then a table for each device (half beside full), then the effects over all devices, then `budget`, if any.
[[nodiscard]] std::string cost_text(const FrameCost& cost, const perf::BudgetTable* budget);
/// As content/schemas/cost.schema.json describes, without its budget.
[[nodiscard]] nlohmann::ordered_json cost_json(const FrameCost& cost);
/// The names of the fields, then one line a view, device and pass. `views`: [cost_json(), ...].
[[nodiscard]] std::string csv_of(const nlohmann::ordered_json& views);
/// In quotes where a comma, a quote or an end of line asks for them (RFC 4180).
[[nodiscard]] std::string csv_field(const std::string& text);

/// A frame's cost as a report that was not drawn: what budget_table() and html_page() take.
[[nodiscard]] perf::FrameReport report_of(const FrameCost& cost);

/// A table of several views of a scene, one line each, from their JSON: [cost_json() with "budget", ...].
[[nodiscard]] std::string overview_text(const nlohmann::ordered_json& views);

/// What was measured here, to stand beside the modelled devices in a trace.
struct MeasuredPasses {
    std::string device;
    std::vector<std::pair<std::string, double>> pass_ms;
};
/// Trace events that Perfetto and chrome://tracing open: one process for each device, one for what was measured. Units
/// of a pass are threads below it, so that what hides behind what binds can be seen.
[[nodiscard]] nlohmann::ordered_json cost_trace(const FrameCost& cost, const std::optional<MeasuredPasses>& measured);

/// Every instruction of the shaders of a pass with what it costs on each device, under the line of text it comes from.
/// Error(usage) for a pass that the frame does not have, with those it has.
[[nodiscard]] std::string why_text(const CountedFrame& frame, ShaderLibrary& library, gl::Arithmetic arithmetic,
                                   const std::string& pass);
/// The same of one stage. `lines_of` gives the text of a file for the listing; nothing: places alone.
[[nodiscard]] std::string listing_text(const CountedStage& stage,
                                       const std::function<std::string(const std::string& file)>& text_of);

}  // namespace halfframe::cost
