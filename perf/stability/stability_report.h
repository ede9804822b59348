// What the search found, as a table for a terminal, as JSON, and as a page that stands alone.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "perf/stability/exhibit.h"
#include "perf/stability/search.h"

namespace halfframe::stability {

struct StabilityReport {
    std::string driver;   ///< of the context that drew; empty: none did
    std::string missing;  ///< why nothing was drawn; empty: it was
    std::vector<FunctionStability> functions;
    std::size_t from_earlier_run = 0;  ///< of them, found before a run that was interrupted
    std::vector<Declaration> not_run;  ///< functions with a reason not to be run on their own
    std::vector<Declaration> gaps;     ///< functions that say nothing
    std::size_t in_shaders_es = 0;     ///< functions there are; 0: a user's file was searched
    std::vector<ExhibitResult> exhibit;
    [[nodiscard]] std::size_t covered() const;  ///< functions, whatever the number of their variants
    [[nodiscard]] std::size_t inputs() const;
    [[nodiscard]] std::size_t not_finite() const;
    [[nodiscard]] std::size_t found() const;  ///< planted faults that were
    /// A sentence for all that is wrong; empty: nothing is.
    [[nodiscard]] std::vector<std::string> violations() const;
};

[[nodiscard]] std::string stability_text(const StabilityReport& report);
[[nodiscard]] nlohmann::ordered_json stability_json(const StabilityReport& report);
/// HTML 5 with its style and pictures inline: readable in black and white, by keyboard and by a screen reader.
[[nodiscard]] std::string stability_page(const StabilityReport& report);

/// "0.43", "12", "inf"
[[nodiscard]] std::string ratio_text(double ratio);

}  // namespace halfframe::stability
