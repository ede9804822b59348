// Errors about words: the nearest of those that exist.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halfframe::cli {

/// The nearest word by optimal string alignment distance, when it is near enough to be meant (a third of its letters).
[[nodiscard]] std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& words);

/// "unknown tier 'hgih'; did you mean 'high'? There are: ...".
[[nodiscard]] std::string unknown(std::string_view kind, std::string_view word, const std::vector<std::string>& words);

}  // namespace halfframe::cli
