// The budget of a frame: rows in milliseconds with their source, and limits.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace halfframe {

/// One row. A row belongs to an effect by name; several effects may share one.
struct BudgetRow {
    std::string name;                         ///< the effect's name, or a group's
    std::optional<double> published_ms;       ///< from a public source; the lower end of a range
    std::optional<double> published_high_ms;  ///< upper end, when the source gives a range
    std::optional<double> ours_ms;            ///< our own allowance, never shown as published
    std::string platforms;                    ///< "PS3", "PS3 and X360"
    std::string source;                       ///< where the figure is from, or our reasoning
    std::string note;
};

struct Budget {
    std::string name;
    double frame_ms = 33.3;
    std::optional<double> target_mib;   ///< all targets together [MiB]
    std::optional<double> texture_mib;  ///< all textures together [MiB]
    std::optional<int> draws;
    std::vector<BudgetRow> rows;
    [[nodiscard]] const BudgetRow* find(const std::string& row) const;
};

}  // namespace halfframe
