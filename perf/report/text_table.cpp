// Aligned tables for a terminal.
#include "perf/report/text_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::perf {

void TextTable::add_row(std::vector<std::string> cells) {
    expect(cells.size() == columns_.size(),
           [&] { return fmt::format("a table row has {} cells under {} columns", cells.size(), columns_.size()); });
    rows_.push_back(std::move(cells));
}

void TextTable::add_rule() { rows_.emplace_back(); }

std::string TextTable::text() const {
    std::vector<std::size_t> widths;
    for (std::size_t column = 0; column < columns_.size(); ++column) {
        std::size_t width = columns_[column].title.size();
        for (const auto& row : rows_) {
            if (!row.empty()) {
                width = std::max(width, row[column].size());
            }
        }
        widths.push_back(width);
    }
    std::size_t total = 2 * (columns_.size() - 1);
    for (const std::size_t width : widths) {
        total += width;
    }

    std::string result;
    const auto add_line = [&](const auto& cell_of) {
        std::string line;
        for (std::size_t column = 0; column < columns_.size(); ++column) {
            const std::string& cell = cell_of(column);
            const std::string blanks(widths[column] - cell.size(), ' ');
            line += (column > 0 ? "  " : "");
            line += columns_[column].align == Align::left ? cell + blanks : blanks + cell;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        result += line + "\n";
    };
    add_line([&](std::size_t column) -> const std::string& { return columns_[column].title; });
    result.append(total, '-').append("\n");
    for (const auto& row : rows_) {
        if (row.empty()) {
            result.append(total, '-').append("\n");
        } else {
            add_line([&](std::size_t column) -> const std::string& { return row[column]; });
        }
    }
    return result;
}

std::string bytes_text(std::size_t bytes) {
    const double value = static_cast<double>(bytes);
    if (value >= 1024.0 * 1024.0) {
        return fmt::format("{:.2f} MiB", value / (1024.0 * 1024.0));
    }
    if (value >= 1024.0) {
        return fmt::format("{:.1f} KiB", value / 1024.0);
    }
    return fmt::format("{} B", bytes);
}

std::string ms_text(double ms) {
    const double size = std::abs(ms);
    if (size >= 100.0) {
        return fmt::format("{:.0f}", ms);
    }
    if (size >= 10.0) {
        return fmt::format("{:.1f}", ms);
    }
    return fmt::format("{:.{}f}", ms, size >= 1.0 ? 2 : 3);
}

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
    std::istringstream words(text);
    std::string word;
    std::string result;
    std::size_t column = 0;
    while (words >> word) {
        if (column > indent && column + 1 + word.size() > width) {
            result += '\n';
            result.append(indent, ' ');
            column = indent;
        } else if (!result.empty()) {
            result += ' ';
            ++column;
        }
        result += word;
        column += word.size();
    }
    return result;
}

}  // namespace halfframe::perf
