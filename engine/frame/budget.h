// The budget of a frame: rows in milliseconds with their source, and limits that fit scenes, cameras and tiers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace halfframe {

/// What a figure above its limit does: nothing, a sentence, or a sentence and exit code 1.
enum class BudgetLevel : std::uint8_t { off, warn, error };
[[nodiscard]] const char* name(BudgetLevel level);

/// One row. A row belongs to an effect by name; several effects may share one.
struct BudgetRow {
    std::string name;                         ///< the effect's name, or a group's
    std::optional<double> published_ms;       ///< from a public source; the lower end of a range
    std::optional<double> published_high_ms;  ///< upper end, when the source gives a range
    std::optional<double> ours_ms;            ///< our own allowance, never shown as published
    std::string platforms;                    ///< "PS3", "PS3 and X360"
    std::string source;                       ///< where the figure is from, or our reasoning
    std::string note;
    /// Columns that are held against the row: profiles of the cost model, "measured". Empty: those `platforms` names
    /// are modelled and warned of, and what a real device measures is an error.
    std::vector<std::string> columns;
    std::optional<BudgetLevel> level;  ///< of all of its columns; empty: as above
};

/// A limit with what it fits. Of those that speak of the same thing, the last that fits decides.
struct BudgetLimit {
    enum class Of : std::uint8_t { frame_ms, pass_ms, effect_ms, counter, target_mib, texture_mib, bytes_per_pixel };
    std::string scene = "*";   ///< of the built-in scene or the file; * stands for any letters
    std::string camera = "*";  ///< likewise
    std::string tier = "*";    ///< low, console, reference or *
    Of of = Of::frame_ms;
    std::string name;    ///< of a pass, an effect or a counter (budget_counters())
    std::string pass;    ///< a counter of this pass alone; empty: of the frame
    std::string column;  ///< of milliseconds: a profile of the cost model, or "measured"
    double most = 0.0;   ///< in the unit of `of`
    BudgetLevel level = BudgetLevel::error;
    std::string source;  ///< where the figure is from; may be empty
    [[nodiscard]] bool speaks_of_the_same(const BudgetLimit& other) const;
};

/// Counters that a limit may name: "draws", "programs", "target_switches", ...
[[nodiscard]] std::span<const std::string_view> budget_counters();

/// The word for what was measured where halfframe runs, among the columns.
inline constexpr const char* kMeasuredColumn = "measured";

struct Budget {
    std::string name;
    double frame_ms = 33.3;
    std::optional<double> target_mib;   ///< all targets together [MiB]
    std::optional<double> texture_mib;  ///< all textures together [MiB]
    std::optional<int> draws;
    std::vector<BudgetRow> rows;
    std::vector<BudgetLimit> limits;  ///< in the order of the file
    [[nodiscard]] const BudgetRow* find(const std::string& row) const;
    /// What is held against a frame: first the four figures above (measured frame, targets, textures, draws, each an
    /// error), then `limits`; one for each thing spoken of, the last that fits, where the first one stood.
    [[nodiscard]] std::vector<BudgetLimit> limits_for(std::string_view scene, std::string_view camera,
                                                      std::string_view tier) const;
};

/// `pattern` covers all of `text`; * stands for any letters, also none.
[[nodiscard]] bool matches_pattern(std::string_view pattern, std::string_view text);

}  // namespace halfframe
