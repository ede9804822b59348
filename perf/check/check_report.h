// A check's result as text, as JSON, and as SARIF 2.1.0 for code review tools.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "perf/check/check.h"

namespace halfframe::check {

/// A table of materials, then each finding with what to do, then a count.
[[nodiscard]] std::string check_text(const Report& report);
[[nodiscard]] nlohmann::ordered_json check_json(const Report& report);

/// OASIS SARIF 2.1.0, one run: all rules, one result a finding. A place is the file as a URI, and the JSON pointer as
/// the name of a logical location.
[[nodiscard]] nlohmann::ordered_json check_sarif(const Report& report, const std::string& version);

}  // namespace halfframe::check
