// One picture of many scenes: a cell each, with name, exit code and milliseconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/frame/image.h"
#include "perf/report/lettering.h"

namespace halfframe::perf {

struct SheetCell {
    std::string name;
    std::string verdict = "0";       ///< the exit code of drawing it, or how it ended: "signal 11", "timeout"
    std::optional<double> ms;        ///< of a frame; nothing: not timed
    std::string words;               ///< why there is no picture; shown in its place
    std::optional<Picture> picture;  ///< not larger than a cell; nothing: a grey cell
};

struct SheetLayout {
    int cell_width = 320;  ///< of a picture [pixels]
    int cell_height = 180;
    int columns = 0;  ///< 0: as many as make the sheet about 16:9
};

/// As many columns as the layout says, never more than cells.
[[nodiscard]] int sheet_columns(std::size_t cells, const SheetLayout& layout, int caption_height);

/// Cells in rows from the upper left. Names and verdicts of what was not drawn are red.
[[nodiscard]] Picture contact_sheet(const std::vector<SheetCell>& cells, const SheetLayout& layout,
                                    const Lettering& lettering);

}  // namespace halfframe::perf
