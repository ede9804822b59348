// Draws errors over the first two axes of models.
#include "perf/accuracy/error_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::accuracy {
namespace {

constexpr int kAcross = 3;  ///< maps in one row
constexpr int kWidth_px = 280, kHeight_px = 200, kGap_px = 20;
constexpr int kLinesAbove = 2, kLinesBelow = 2;  ///< of letters
constexpr perf::Rgb kPaper = {236, 236, 236}, kInk = {24, 24, 24}, kFrame = {120, 120, 120};

struct Map {
    int columns = 0, rows = 0;
    std::string across, up;    ///< name and ends of the axes
    std::vector<double> mean;  ///< row 0 is the smallest value of the second axis
};

/// Index of every value of one axis, in rising order.
std::map<double, int> places(const ModelAccuracy& model, std::size_t axis) {
    std::map<double, int> found;
    for (const ModelError& error : model.errors) found[error.at[axis]] = 0;
    int index = 0;
    for (auto& [value, place] : found) place = index++;
    return found;
}

Map map_of(const ModelAccuracy& model) {
    expect(model.entry.axes.size() >= 2, "an error map has two axes");
    const std::map<double, int> across = places(model, 0), up = places(model, 1);
    const auto axis = [&](std::size_t number, const std::map<double, int>& at) {
        return fmt::format("{} {:g} to {:g}", model.entry.axes[number], at.begin()->first, at.rbegin()->first);
    };
    Map map{.columns = static_cast<int>(across.size()),
            .rows = static_cast<int>(up.size()),
            .across = axis(0, across),
            .up = axis(1, up),
            .mean = {}};
    map.mean.resize(across.size() * up.size());
    std::vector<int> counts(map.mean.size());
    for (const ModelError& error : model.errors) {
        const auto at = static_cast<std::size_t>(up.at(error.at[1]) * map.columns + across.at(error.at[0]));
        map.mean[at] += error.error;
        ++counts[at];
    }
    for (std::size_t i = 0; i < counts.size(); ++i) map.mean[i] /= std::max(counts[i], 1);
    return map;
}

/// What full colour means: the least round figure that no place exceeds, or the last.
double full_of(const Map& map, std::string_view unit) {
    double largest = 0.0;
    for (const double mean : map.mean) largest = std::max(largest, std::fabs(mean));
    const bool codes = unit == "codes";
    for (const double full : {codes ? 16.0 : 0.1, codes ? 32.0 : 0.2}) {
        if (largest <= full) return full;
    }
    return codes ? 64.0 : 0.5;
}

void paint(Picture& picture, const Map& map, const MapPlace& place, double full) {
    perf::fill(picture, place.x - 1, place.y - 1, place.width + 2, place.height + 2, kFrame);
    for (int y = 0; y < place.height; ++y) {
        for (int x = 0; x < place.width; ++x) {
            const int row = (place.height - 1 - y) * map.rows / place.height, column = x * map.columns / place.width;
            const double share =
                std::clamp(map.mean[static_cast<std::size_t>(row * map.columns + column)] / full, -1.0, 1.0);
            const auto faded = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - std::fabs(share))));
            perf::fill(picture, place.x + x, place.y + y, 1, 1,
                       {share > 0.0 ? std::uint8_t{255} : faded, faded, share < 0.0 ? std::uint8_t{255} : faded});
        }
    }
}

}  // namespace

MapPlace map_place(std::size_t index, int letter_px) {
    const int column = static_cast<int>(index) % kAcross, row = static_cast<int>(index) / kAcross;
    const int cell_px = kHeight_px + (kLinesAbove + kLinesBelow) * letter_px + kGap_px;
    return {kGap_px + column * (kWidth_px + kGap_px), kGap_px / 2 + row * cell_px + kLinesAbove * letter_px, kWidth_px,
            kHeight_px};
}

Picture error_maps(std::span<const ModelAccuracy> models, const perf::Lettering& lettering) {
    expect(!models.empty(), "a picture of maps has at least one");
    const int letter_px = lettering.height();
    const std::size_t widest = std::min<std::size_t>(models.size(), kAcross) - 1;
    const MapPlace right = map_place(widest, letter_px), low = map_place(models.size() - 1, letter_px);
    Picture picture{.width = right.x + right.width + kGap_px,
                    .height = low.y + low.height + kLinesBelow * letter_px + kGap_px / 2,
                    .rgba = {}};
    picture.rgba.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4, 255);
    perf::fill(picture, 0, 0, picture.width, picture.height, kPaper);
    for (std::size_t i = 0; i < models.size(); ++i) {
        const ModelEntry& entry = models[i].entry;
        const Map map = map_of(models[i]);
        const MapPlace place = map_place(i, letter_px);
        const double full = full_of(map, entry.unit);
        paint(picture, map, place, full);
        const auto write = [&](int y, const std::string& words) {
            lettering.draw(picture, place.x, y, lettering.shortened(words, place.width), kInk);
        };
        write(place.y - 2 * letter_px, entry.model);
        write(place.y - letter_px, "up: " + map.up);
        write(place.y + place.height, "right: " + map.across);
        write(place.y + place.height + letter_px,
              fmt::format("blue -{0:g}, red +{0:g} {1}", full, full < 1.0 ? "" : entry.unit));
    }
    return picture;
}

}  // namespace halfframe::accuracy
