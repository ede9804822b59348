// The prices of effects, counted in the built-in scenes: content/costs/prices.json.
#pragma once

#include <functional>
#include <string>

namespace halfframe::cli {

/// The text of the table: every effect at every tier and arithmetic on the built-in devices, over every camera of the
/// scenes that stand for what is drawn, at two sizes. `effects`: the text of effects.json, whose fingerprint is kept,
/// so that a test sees when shaders have changed. Takes minutes; `jobs` processes share it. The same text on every
/// machine with the same compiler.
[[nodiscard]] std::string price_table(const std::string& effects, int jobs, const std::string& cache,
                                      const std::function<void(const std::string&)>& between);

}  // namespace halfframe::cli
