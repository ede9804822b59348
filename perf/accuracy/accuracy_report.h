// Accuracy figures as a table for a terminal and as JSON.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "perf/accuracy/measure.h"

namespace halfframe::accuracy {

/// One row a function, then the inputs of the largest errors, the bounds with their reasons, and what is exceeded.
[[nodiscard]] std::string accuracy_text(std::span<const FunctionAccuracy> functions);

/// The same facts. Errors are in the unit named beside them; a worst input holds every argument by its name.
[[nodiscard]] nlohmann::ordered_json accuracy_json(std::span<const FunctionAccuracy> functions);

}  // namespace halfframe::accuracy
