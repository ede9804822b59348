// Reads Radiance .hdr. A reader of our own because stb_image (of September 2022, as Debian 12 has it) never comes back
// from a file that ends inside a run, takes flat pixels past the end from nowhere, and drops EXPOSURE; tests compare
// whole files with stb_image.
#include "content/environment/equirectangular.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::content {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

/// Goes through the bytes; every read is checked.
class HdrBytes {
public:
    HdrBytes(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

    [[noreturn]] void fail(const std::string& what, const char* advice) const {
        throw Error(Fault::input, fmt::format("{}: byte {}: {}; {}", file_, at_, what, advice));
    }
    [[nodiscard]] std::uint8_t next() {
        if (at_ >= bytes_.size()) fail("the file ends inside its pixels", "it was cut off: copy or export it again");
        return static_cast<std::uint8_t>(bytes_[at_++]);
    }
    [[nodiscard]] Rgbe next_pixel() {
        Rgbe pixel{};
        for (std::uint8_t& channel : pixel) channel = next();
        return pixel;
    }
    /// Up to the next line feed, which is taken too.
    [[nodiscard]] std::string_view next_line() {
        const std::size_t end = bytes_.find('\n', at_);
        // The longest line any writer makes is a command line of a few hundred letters.
        if (end == std::string_view::npos || end - at_ > 65536) {
            fail("the header does not end", "this is no Radiance .hdr file, or it was cut off");
        }
        std::string_view line = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }
    /// Do the next four bytes start a row in new run lengths?
    [[nodiscard]] bool starts_runs() const {
        const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes_[at_ + i]); };
        return at_ + 4 <= bytes_.size() && byte(0) == 2 && byte(1) == 2 && byte(2) < 128;
    }

private:
    std::string_view bytes_;
    const std::string& file_;
    std::size_t at_ = 0;
};

/// The number that follows `sign` ("-Y", "+X") at the front of `text`, taken away; -1: not there.
long long taken_size(std::string_view& text, std::string_view sign) {
    if (!text.starts_with(sign)) return -1;
    text.remove_prefix(sign.size());
    while (text.starts_with(' ')) text.remove_prefix(1);
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return -1;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    while (text.starts_with(' ')) text.remove_prefix(1);
    return value;
}

struct HdrHeader {
    int width = 0;
    int height = 0;
    double exposure = 1.0;  ///< pixels were multiplied by this: the product of all EXPOSURE lines
};

HdrHeader read_header(HdrBytes& bytes, const std::string& file) {
    HdrHeader header;
    if (const std::string_view magic = bytes.next_line(); magic != "#?RADIANCE" && magic != "#?RGBE") {
        bytes.fail("the first line is not '#?RADIANCE'", "this is no Radiance .hdr file");
    }
    bool has_format = false;
    for (std::string_view line = bytes.next_line(); !line.empty(); line = bytes.next_line()) {
        if (line.starts_with("FORMAT=")) {
            has_format = line == "FORMAT=32-bit_rle_rgbe";
            if (!has_format) bytes.fail("the pixels are not RGBE", "convert the file to FORMAT=32-bit_rle_rgbe");
        }
        if (line.starts_with("EXPOSURE=")) {
            std::string_view text = line.substr(9);
            while (text.starts_with(' ')) text.remove_prefix(1);
            double factor = 0.0;
            (void)std::from_chars(text.data(), text.data() + text.size(), factor);
            header.exposure *= factor;
            // 1e-6 to 1e6 holds every camera; outside, a division would make all black or all white.
            if (!(header.exposure >= 1e-6 && header.exposure <= 1e6)) {
                bytes.fail("EXPOSURE is no sensible number", "remove the line or write the file again");
            }
        }
    }
    if (!has_format) bytes.fail("there is no FORMAT line", "write the file again as 32-bit_rle_rgbe");
    std::string_view size = bytes.next_line();
    const long long height = taken_size(size, "-Y");
    const long long width = taken_size(size, "+X");
    if (height < 0 || width < 0 || !size.empty()) {
        bytes.fail("the rows do not run '-Y height +X width'", "write the picture top row first, left to right");
    }
    expect_equirectangular(width, height, file);
    header.width = static_cast<int>(width);
    header.height = static_cast<int>(height);
    return header;
}

/// A row channel by channel: a count over 128 repeats the next byte count - 128 times, up to 128 copies that many.
void read_run_row(HdrBytes& bytes, std::vector<Rgbe>& row) {
    const Rgbe start = bytes.next_pixel();
    if (static_cast<std::size_t>(start[2] << 8 | start[3]) != row.size()) {
        bytes.fail("a row has another length than the picture", "the file is damaged: copy or export it again");
    }
    for (std::size_t channel = 0; channel < 4; ++channel) {
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t code = bytes.next();
            const bool repeats = code > 128;
            const std::size_t count = repeats ? code - 128u : code;
            if (count == 0 || count > row.size() - x) {
                bytes.fail("a run of pixels leaves its row", "the file is damaged: copy or export it again");
            }
            std::uint8_t value = repeats ? bytes.next() : std::uint8_t{0};
            for (std::size_t i = 0; i < count; ++i, ++x) {
                if (!repeats) value = bytes.next();
                row[x][channel] = value;
            }
        }
    }
}

/// A row pixel by pixel. 1 1 1 n repeats the pixel before n times; directly after such a one, n counts 256 times more.
void read_flat_row(HdrBytes& bytes, std::vector<Rgbe>& row) {
    int shift = 0;
    for (std::size_t x = 0; x < row.size();) {
        const Rgbe pixel = bytes.next_pixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            row[x++] = pixel;
            shift = 0;
            continue;
        }
        const std::size_t count = static_cast<std::size_t>(pixel[3]) << shift;
        if (x == 0 || shift > 16 || count > row.size() - x) {
            bytes.fail("a run of pixels leaves its row", "the file is damaged: copy or export it again");
        }
        for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
        shift += 8;
    }
}

glm::vec3 radiance_of(const Rgbe& pixel, double exposure) {
    if (pixel[3] == 0) return glm::vec3(0.0f);
    const double scale = std::ldexp(1.0, pixel[3] - 136) / exposure;
    return {static_cast<float>(pixel[0] * scale), static_cast<float>(pixel[1] * scale),
            static_cast<float>(pixel[2] * scale)};
}

}  // namespace

RawPicture decode_hdr(std::string_view bytes, const std::string& file) {
    HdrBytes reader(bytes, file);
    const HdrHeader header = read_header(reader, file);
    RawPicture picture{header.width, header.height, {}};
    std::vector<Rgbe> row(static_cast<std::size_t>(header.width));
    for (int y = 0; y < header.height; ++y) {
        // Narrower rows than 8 pixels have no runs; the format's own rule.
        if (header.width >= 8 && reader.starts_runs()) {
            read_run_row(reader, row);
        } else {
            read_flat_row(reader, row);
        }
        for (const Rgbe& pixel : row) picture.pixels.push_back(radiance_of(pixel, header.exposure));
    }
    return picture;
}

}  // namespace halfframe::content
