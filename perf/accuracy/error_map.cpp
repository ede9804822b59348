// Draws errors over the first two axes of models.
#include "perf/accuracy/error_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include "engine/error.h"

namespace halfframe::accuracy {
namespace {

constexpr int kPlacePixels = 6;
constexpr int kGapPixels = 12;

struct Map {
    int columns = 0, rows = 0;
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
    Map map{.columns = static_cast<int>(across.size()), .rows = static_cast<int>(up.size()), .mean = {}};
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

void paint(Picture& picture, const Map& map, int left, double full) {
    for (int y = 0; y < map.rows * kPlacePixels; ++y) {
        for (int x = 0; x < map.columns * kPlacePixels; ++x) {
            const int row = y / kPlacePixels, column = x / kPlacePixels;
            const double share =
                std::clamp(map.mean[static_cast<std::size_t>(row * map.columns + column)] / full, -1.0, 1.0);
            const auto faded = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - std::fabs(share))));
            const int from_top = picture.height - 1 - y;
            const std::size_t at = (static_cast<std::size_t>(from_top) * static_cast<std::size_t>(picture.width) +
                                    static_cast<std::size_t>(left + x)) *
                                   4;
            picture.rgba[at] = share > 0.0 ? 255 : faded;
            picture.rgba[at + 1] = faded;
            picture.rgba[at + 2] = share < 0.0 ? 255 : faded;
        }
    }
}

}  // namespace

Picture error_maps(std::span<const ModelAccuracy> models) {
    std::vector<Map> maps;
    Picture picture;
    for (const ModelAccuracy& model : models) {
        maps.push_back(map_of(model));
        picture.width += maps.back().columns * kPlacePixels + (maps.size() > 1 ? kGapPixels : 0);
        picture.height = std::max(picture.height, maps.back().rows * kPlacePixels);
    }
    // The paper that the maps lie on: grey, so that a map's own white ends at its edge.
    picture.rgba.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4, 200);
    int left = 0;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        paint(picture, maps[i], left, std::string_view(models[i].entry.unit) == "codes" ? 64.0 : 0.5);
        left += maps[i].columns * kPlacePixels + kGapPixels;
    }
    return picture;
}

}  // namespace halfframe::accuracy
