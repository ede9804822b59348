// The nearest spelling: what a message offers when somebody mistyped a name.
#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halfframe::content {

/// Insertions, deletions and replacements that lead from one word to the other (Levenshtein 1966).
[[nodiscard]] inline std::size_t edit_distance(std::string_view one, std::string_view other) {
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < one.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < other.size(); ++j) {
            const std::size_t replaced = diagonal + (one[i] == other[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

/// The candidate spelt most like `word`; none when even that one differs in more than a third of its letters (2 at
/// least).
template <typename Candidates>
[[nodiscard]] std::optional<std::string> nearest(std::string_view word, const Candidates& candidates) {
    std::optional<std::string> best;
    std::size_t best_distance = 0;
    for (const auto& candidate : candidates) {
        const std::string_view text(candidate);
        const std::size_t distance = edit_distance(word, text);
        const std::size_t allowed = std::max<std::size_t>(2, text.size() / 3);
        if (distance <= allowed && (!best || distance < best_distance)) {
            best = std::string(text);
            best_distance = distance;
        }
    }
    return best;
}

/// ", did you mean 'x'?" or nothing.
template <typename Candidates>
[[nodiscard]] std::string did_you_mean(std::string_view word, const Candidates& candidates) {
    const std::optional<std::string> found = nearest(word, candidates);
    return found ? ", did you mean '" + *found + "'?" : std::string();
}

}  // namespace halfframe::content
