// A frame's cost for people and for machines.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "perf/cost/frame_cost.h"

namespace halfframe::cost {

/// Counts, then a table for each device, then the effects over all devices, then half against full.
[[nodiscard]] std::string cost_text(const FrameCost& cost);
/// As content/schemas/cost.schema.json describes.
[[nodiscard]] nlohmann::ordered_json cost_json(const FrameCost& cost);
/// One line a device and pass, under a line of names.
[[nodiscard]] std::string cost_csv(const FrameCost& cost);

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
