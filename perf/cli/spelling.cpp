// Errors about words.
#include "perf/cli/spelling.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace halfframe::cli {
namespace {

/// Insertions, deletions, substitutions and swaps of neighbours.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> table(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                table[i][j] = i + j;
                continue;
            }
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            table[i][j] = std::min({table[i - 1][j] + 1, table[i][j - 1] + 1, table[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                table[i][j] = std::min(table[i][j], table[i - 2][j - 2] + 1);
            }
        }
    }
    return table[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& words) {
    std::optional<std::string> best;
    std::size_t best_distance = 0;
    for (const std::string& candidate : words) {
        const std::size_t away = distance(word, candidate);
        if (away <= std::max<std::size_t>(1, candidate.size() / 3) && (!best || away < best_distance)) {
            best = candidate;
            best_distance = away;
        }
    }
    return best;
}

std::string unknown(std::string_view kind, std::string_view word, const std::vector<std::string>& words) {
    std::string text = fmt::format("unknown {} '{}'", kind, word);
    if (const auto near = nearest(word, words)) {
        text += fmt::format("; did you mean '{}'?", *near);
    } else {
        text += ";";
    }
    return text + fmt::format(" There are: {}", fmt::join(words, ", "));
}

}  // namespace halfframe::cli
