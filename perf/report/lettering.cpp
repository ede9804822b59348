// Words in pictures through stb_truetype.
#include "perf/report/lettering.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <stb/stb_truetype.h>

#include "engine/error.h"

namespace halfframe::perf {
namespace {

/// Plain sans serif fonts where Debian's packages put them, in order of preference.
constexpr std::array kUsualFonts = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                                    "/usr/share/fonts/truetype/freefont/FreeSans.ttf"};
constexpr std::string_view kMore = "..";
/// A font that would not fit in memory twice is no font [bytes].
constexpr std::uintmax_t kMostFontBytes = 64u << 20;

/// The code points of UTF-8 text with the byte at which each begins.
struct Letter {
    int code_point;
    std::size_t at;
};
std::vector<Letter> letters_of(std::string_view text) {
    std::vector<Letter> letters;
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
        const unsigned first = byte(at);
        const std::size_t more = first < 0x80       ? 0
                                 : first >> 5 == 6  ? 1
                                 : first >> 4 == 14 ? 2
                                 : first >> 3 == 30 ? 3
                                                    : 9;
        int code_point = static_cast<int>(more == 0 ? first : first & (0x3Fu >> more));
        bool sound = more <= 3 && at + more < text.size();
        for (std::size_t i = 1; sound && i <= more; ++i) {
            sound = byte(at + i) >> 6 == 2;
            code_point = code_point << 6 | static_cast<int>(byte(at + i) & 0x3Fu);
        }
        letters.push_back({sound && code_point >= ' ' ? code_point : '?', at});
        at += sound ? more + 1 : 1;
    }
    return letters;
}

std::size_t index_of(int x, int y, const Picture& picture) {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
}

}  // namespace

std::filesystem::path find_font(const std::string& wished) {
    std::error_code ignored;
    if (!wished.empty()) {
        if (!std::filesystem::is_regular_file(wished, ignored)) {
            throw Error(Fault::input, fmt::format("{}: there is no such font file; name a .ttf file", wished));
        }
        return wished;
    }
    for (const char* font : kUsualFonts) {
        if (std::filesystem::is_regular_file(font, ignored)) return font;
    }
    throw Error(Fault::environment,
                fmt::format("no font to write names with: {} and others are missing; install fonts-dejavu-core or "
                            "name a .ttf file with --font",
                            kUsualFonts.front()));
}

struct Lettering::Font {
    std::vector<unsigned char> bytes;
    stbtt_fontinfo info{};
    float scale = 1.0f;
    int ascent_px = 0;

    /// Width of one letter and of the white beside it before the next one [pixels].
    [[nodiscard]] float advance(const std::vector<Letter>& letters, std::size_t i) const {
        int width = 0;
        int bearing = 0;
        stbtt_GetCodepointHMetrics(&info, letters[i].code_point, &width, &bearing);
        const int kern = i + 1 < letters.size()
                             ? stbtt_GetCodepointKernAdvance(&info, letters[i].code_point, letters[i + 1].code_point)
                             : 0;
        return scale * static_cast<float>(width + kern);
    }
};

Lettering::Lettering(const std::filesystem::path& font_file, int height_px)
    : font_(std::make_unique<Font>()), height_px_(height_px) {
    expect(height_px >= 6 && height_px <= 200, "letters are 6 to 200 pixels high");
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(font_file, error);
    std::ifstream stream(font_file, std::ios::binary);
    if (!error && size <= kMostFontBytes) font_->bytes.assign(std::istreambuf_iterator<char>(stream), {});
    // stb_truetype trusts the offsets in a file, so that only a user's own font may be given to it; a file shorter than
    // the table of offsets is none.
    const int offset = font_->bytes.size() > 64 ? stbtt_GetFontOffsetForIndex(font_->bytes.data(), 0) : -1;
    if (offset < 0 || stbtt_InitFont(&font_->info, font_->bytes.data(), offset) == 0) {
        throw Error(Fault::input, fmt::format("{}: is not a TrueType font that can be read; name another with --font",
                                              font_file.string()));
    }
    font_->scale = stbtt_ScaleForPixelHeight(&font_->info, static_cast<float>(height_px));
    int ascent = 0;
    int descent = 0;
    int gap = 0;
    stbtt_GetFontVMetrics(&font_->info, &ascent, &descent, &gap);
    font_->ascent_px = static_cast<int>(std::lround(font_->scale * static_cast<float>(ascent)));
}

Lettering::~Lettering() = default;

int Lettering::width(std::string_view text) const {
    const std::vector<Letter> letters = letters_of(text);
    float width = 0.0f;
    for (std::size_t i = 0; i < letters.size(); ++i) width += font_->advance(letters, i);
    return static_cast<int>(std::ceil(width));
}

void Lettering::draw(Picture& picture, int x, int y, std::string_view text, const Rgb& color) const {
    const std::vector<Letter> letters = letters_of(text);
    float pen = static_cast<float>(x);
    for (std::size_t i = 0; i < letters.size(); ++i) {
        const float whole = std::floor(pen);
        int width = 0;
        int height = 0;
        int left = 0;
        int top = 0;
        unsigned char* cover =
            stbtt_GetCodepointBitmapSubpixel(&font_->info, font_->scale, font_->scale, pen - whole, 0.0f,
                                             letters[i].code_point, &width, &height, &left, &top);
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                const int at_x = static_cast<int>(whole) + left + column;
                const int at_y = y + font_->ascent_px + top + row;
                if (at_x < 0 || at_y < 0 || at_x >= picture.width || at_y >= picture.height) continue;
                const int share = cover[row * width + column];
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    std::uint8_t& value = picture.rgba[index_of(at_x, at_y, picture) + channel];
                    value = static_cast<std::uint8_t>((value * (255 - share) + color[channel] * share + 127) / 255);
                }
            }
        }
        stbtt_FreeBitmap(cover, nullptr);
        pen += font_->advance(letters, i);
    }
}

std::string Lettering::shortened(std::string_view text, int width_px) const {
    if (width(text) <= width_px) return std::string(text);
    const std::vector<Letter> letters = letters_of(text);
    for (std::size_t kept = letters.size(); kept-- > 0;) {
        const std::size_t head = (kept + 1) / 2;
        const std::size_t tail = letters.size() - kept / 2;
        std::string shorter(text.substr(0, head < letters.size() ? letters[head].at : text.size()));
        shorter += kMore;
        if (tail < letters.size()) shorter += text.substr(letters[tail].at);
        if (width(shorter) <= width_px) return shorter;
    }
    return {};
}

std::vector<std::string> Lettering::lines(std::string_view text, int width_px, int most_lines) const {
    std::vector<std::string> result;
    std::string_view rest = text;
    while (!rest.empty() && static_cast<int>(result.size()) < most_lines) {
        const std::vector<Letter> letters = letters_of(rest);
        std::size_t fitting = rest.size();  // the longest start that fits, at least one letter
        for (std::size_t i = letters.size(); width(rest.substr(0, fitting)) > width_px && i-- > 1;) {
            fitting = letters[i].at;
        }
        if (fitting < rest.size()) {
            const std::size_t blank = rest.substr(0, fitting + 1).rfind(' ');
            if (blank != std::string_view::npos && blank > 0) fitting = blank;
        }
        result.emplace_back(rest.substr(0, fitting));
        rest.remove_prefix(fitting);
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    }
    if (!rest.empty() && !result.empty()) {
        std::string& last = result.back();
        while (!last.empty() && width(last + std::string(kMore)) > width_px) last.resize(letters_of(last).back().at);
        last += kMore;
    }
    return result;
}

void fill(Picture& picture, int x, int y, int width, int height, const Rgb& color) {
    for (int row = std::max(y, 0); row < std::min(y + height, picture.height); ++row) {
        for (int column = std::max(x, 0); column < std::min(x + width, picture.width); ++column) {
            const std::size_t at = index_of(column, row, picture);
            std::copy(color.begin(), color.end(), picture.rgba.begin() + static_cast<std::ptrdiff_t>(at));
            picture.rgba[at + 3] = 255;
        }
    }
}

}  // namespace halfframe::perf
