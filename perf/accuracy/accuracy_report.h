// Accuracy figures as a table for a terminal and as JSON.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "perf/accuracy/measure.h"
#include "perf/accuracy/model_list.h"

namespace halfframe::accuracy {

/// One row a function, then the inputs of the largest errors, the bounds with their reasons, and what is exceeded.
[[nodiscard]] std::string accuracy_text(std::span<const FunctionAccuracy> functions);
/// One row a model: what it loses, what it gains, where it is worst. Empty for no models.
[[nodiscard]] std::string models_text(std::span<const ModelAccuracy> models);

/// The same facts. Errors are in the unit named beside them; a worst input holds every argument by its name.
/// An element a function, then an element a model: it has "model" where the others have "function".
[[nodiscard]] nlohmann::ordered_json accuracy_json(std::span<const FunctionAccuracy> functions,
                                                   std::span<const ModelAccuracy> models);

}  // namespace halfframe::accuracy
