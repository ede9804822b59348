// Aligned tables for a terminal. ASCII only: they are read in logs as well.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace halfframe::perf {

enum class Align { left, right };

/// Rows of cells under a header; columns are as wide as their widest cell, two spaces apart, no trailing blanks.
class TextTable {
public:
    struct Column {
        std::string title;
        Align align = Align::left;
    };
    explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

    /// As many cells as columns: anything else is a Mistake.
    void add_row(std::vector<std::string> cells);
    /// A line of dashes before the next row.
    void add_rule();
    [[nodiscard]] std::string text() const;  ///< ends with a newline

private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;  ///< an empty row is a rule
};

/// "11.06 MiB", "3.52 KiB", "12 B": three digits or so, 1024-based.
[[nodiscard]] std::string bytes_text(std::size_t bytes);
/// Milliseconds with as many digits as mean something: "0.042", "1.70", "33.3", "412".
[[nodiscard]] std::string ms_text(double ms);
/// Breaks `text` at blanks so that no line is longer than `width` where a blank allows it; later lines start with
/// `indent` blanks.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t width, std::size_t indent);

}  // namespace halfframe::perf
