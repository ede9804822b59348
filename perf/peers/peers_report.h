// Comparisons as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "perf/peers/compare.h"

namespace halfframe::peers {

/// The machine and the way of measuring, for the head of the table and for the file.
struct Setting {
    std::string machine;  ///< processor model and count, kernel
    CompareRequest request;
    std::vector<std::string> notices;
};

[[nodiscard]] std::string machine_text();
[[nodiscard]] std::string text_report(const Setting& setting, const std::vector<Comparison>& comparisons);
[[nodiscard]] nlohmann::json json_report(const Setting& setting, const std::vector<Comparison>& comparisons);

}  // namespace halfframe::peers
