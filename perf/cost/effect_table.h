// What the shaders of every effect cost, as data that is kept beside them.
#pragma once

#include <string>

namespace halfframe::cost {

/// content/costs/effects.json: for each effect, tier, program and arithmetic the counts of the fragment stage without
/// defines and with all of them, with the model's version and the compiler's. The same text on every machine with that
/// compiler. Effects that only add code to others' shaders have no programs of their own: their cost is marginal, and
/// depends on the scene.
[[nodiscard]] std::string effect_table_text();

}  // namespace halfframe::cost
