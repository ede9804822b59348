// Lays out a contact sheet.
#include "perf/report/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/report/text_table.h"

namespace halfframe::perf {
namespace {

constexpr int kGap_px = 8;
constexpr Rgb kPaper = {24, 25, 28};
constexpr Rgb kNoPicture = {96, 96, 96};
constexpr Rgb kName = {232, 232, 232};
constexpr Rgb kFigures = {168, 172, 180};
constexpr Rgb kFailed = {255, 122, 110};
/// A sheet is looked at on a screen: its width over its height.
constexpr double kAspect = 16.0 / 9.0;

void paste(Picture& sheet, const Picture& picture, int x, int y) {
    for (int row = 0; row < picture.height; ++row) {
        const auto from = picture.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(row) * picture.width;
        const auto to = sheet.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y + row) * sheet.width + x);
        std::copy(from, from + 4 * static_cast<std::ptrdiff_t>(picture.width), to);
    }
}

void draw_cell(Picture& sheet, const SheetCell& cell, const SheetLayout& layout, const Lettering& lettering, int x,
               int y) {
    const int line = lettering.height();
    if (cell.picture) {
        expect(cell.picture->width <= layout.cell_width && cell.picture->height <= layout.cell_height,
               "a picture on a contact sheet fits into its cell");
        paste(sheet, *cell.picture, x, y);
    } else {
        fill(sheet, x, y, layout.cell_width, layout.cell_height, kNoPicture);
        const int most_lines = std::max(1, (layout.cell_height - kGap_px) / line);
        int at = y + kGap_px / 2;
        for (const std::string& words : lettering.lines(cell.words, layout.cell_width - kGap_px, most_lines)) {
            lettering.draw(sheet, x + kGap_px / 2, at, words, kName);
            at += line;
        }
    }
    const int caption = y + layout.cell_height + 2;
    lettering.draw(sheet, x, caption, lettering.shortened(cell.name, layout.cell_width),
                   cell.picture ? kName : kFailed);
    const std::string figures =
        fmt::format("exit {}{}", cell.verdict, cell.ms ? fmt::format(", {} ms", ms_text(*cell.ms)) : "");
    lettering.draw(sheet, x, caption + line, lettering.shortened(figures, layout.cell_width),
                   cell.verdict == "0" ? kFigures : kFailed);
}

}  // namespace

int sheet_columns(std::size_t cells, const SheetLayout& layout, int caption_height) {
    const auto count = static_cast<double>(std::max<std::size_t>(cells, 1));
    const double cell_aspect = static_cast<double>(layout.cell_width + kGap_px) /
                               static_cast<double>(layout.cell_height + caption_height + kGap_px);
    const double square = std::sqrt(count * kAspect / cell_aspect);
    const int columns = layout.columns > 0 ? layout.columns : static_cast<int>(std::lround(square));
    return std::clamp(columns, 1, static_cast<int>(count));
}

Picture contact_sheet(const std::vector<SheetCell>& cells, const SheetLayout& layout, const Lettering& lettering) {
    expect(!cells.empty() && layout.cell_width > 0 && layout.cell_height > 0, "a contact sheet has cells of some size");
    const int caption = 2 * lettering.height() + 2;
    const int columns = sheet_columns(cells.size(), layout, caption);
    const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
    const int step_x = layout.cell_width + kGap_px;
    const int step_y = layout.cell_height + caption + kGap_px;
    Picture sheet{.width = columns * step_x + kGap_px, .height = rows * step_y + kGap_px, .rgba = {}};
    sheet.rgba.resize(4 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height));
    fill(sheet, 0, 0, sheet.width, sheet.height, kPaper);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int at = static_cast<int>(i);
        draw_cell(sheet, cells[i], layout, lettering, kGap_px + at % columns * step_x, kGap_px + at / columns * step_y);
    }
    return sheet;
}

}  // namespace halfframe::perf
