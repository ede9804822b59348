// One page that stands alone: pictures, plans and budgets of one or several scenes, no file beside it, no network.
#pragma once

#include <string>
#include <vector>

#include "perf/report/budget_table.h"
#include "perf/report/frame_report.h"

namespace halfframe::perf {

struct PageScene {
    const FrameReport* report = nullptr;
    const BudgetTable* budget = nullptr;
};

/// HTML 5 with its style and pictures inline; readable in light and dark, by keyboard and by a screen reader.
[[nodiscard]] std::string html_page(const std::vector<PageScene>& scenes);

/// Text safe between tags and in double-quoted attributes.
[[nodiscard]] std::string html_escaped(const std::string& text);
/// RFC 4648, with padding.
[[nodiscard]] std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace halfframe::perf
