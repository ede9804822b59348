// Words in 8-bit pictures, drawn with a TrueType font that is found while running.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/image.h"

namespace halfframe::perf {

using Rgb = std::array<std::uint8_t, 3>;

/// The font file to use: `wished`, else the first of Debian's usual sans serif fonts that is there. None, or a `wished`
/// that is no file: Error(environment) or Error(input) that says what to install or to name.
[[nodiscard]] std::filesystem::path find_font(const std::string& wished = {});

/// One font file at one size. Text is UTF-8; what is no UTF-8 shows as '?', a letter the font lacks as its empty box.
class Lettering {
public:
    /// `height_px` from the top of the tallest letter to the bottom of the lowest, 6 to 200. A file that is no font:
    /// Error(input).
    Lettering(const std::filesystem::path& font_file, int height_px);
    ~Lettering();
    Lettering(const Lettering&) = delete;
    Lettering& operator=(const Lettering&) = delete;

    [[nodiscard]] int height() const { return height_px_; }
    [[nodiscard]] int width(std::string_view text) const;
    /// Draws one line with its upper left corner at x, y; what lies outside the picture is cut off.
    void draw(Picture& picture, int x, int y, std::string_view text, const Rgb& color) const;

    /// `text` if it fits, else its start and its end round "..": names differ at both.
    [[nodiscard]] std::string shortened(std::string_view text, int width_px) const;
    /// `text` broken at blanks (or inside a word that is too long) into at most `most_lines` lines; ".." ends the last
    /// one when more would follow.
    [[nodiscard]] std::vector<std::string> lines(std::string_view text, int width_px, int most_lines) const;

private:
    struct Font;
    std::unique_ptr<Font> font_;
    int height_px_ = 0;
};

/// Fills the part of a rectangle that lies in the picture.
void fill(Picture& picture, int x, int y, int width, int height, const Rgb& color);

}  // namespace halfframe::perf
