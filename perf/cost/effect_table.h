// What the shaders of every effect cost, as data that is kept beside them.
#pragma once

#include <string>

namespace halfframe::cost {

/// content/costs/effects.json: for each effect, tier, program and arithmetic the counts of the fragment stage without
/// defines and with all of them that add something (ShaderVariant::simpler), with the model's version and the
/// compiler's. The same text on every machine with that compiler. Code that an effect adds to others' shaders stands in
/// rows that are `marginal`: the counts of the other's program with it less those without, and the instructions it adds
/// to the vertex stage.
[[nodiscard]] std::string effect_table_text();

/// 16 hexadecimal digits over effects.json (its text) and the built-in profiles: what prices.json was counted from.
[[nodiscard]] std::string counts_fingerprint(const std::string& effects);

}  // namespace halfframe::cost
