// Every texel of every level is one sum over the light taps inside its lobe, in double.
#include "content/environment/prefilter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "content/environment/cube_face.h"
#include "content/environment/lobe_powers.h"
#include "content/environment/work_sharing.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

/// Weights below this share of the peak are left out, as in the public CubeMapGen: together a millionth of the lobe.
constexpr double kSmallestWeight = 1e-6;
/// Steps of the table of weights. Between two of them a lobe of power q bends by (13.8 / 8192)^2 / 8 = 4e-7 of itself.
constexpr int kSteps = 8192;
/// Lobes of less power are summed from the coarse taps.
constexpr double kCoarseBelow = 50.0;
/// Texels a side that are computed as one piece of work and share their list of groups.
constexpr int kTileSide = 8;

struct Tile {
    int level = 0;
    int face = 0;
    int left = 0;
    int top = 0;
    int side = 0;
};

glm::dvec3 texel_axis(int face, int x, int y, int size) {
    return glm::normalize(face_direction(face, warped_centre(x, size), warped_centre(y, size)));
}

/// Share of the sphere that a lobe reaches.
double reach(double power) { return 0.5 * (1.0 - std::pow(kSmallestWeight, 1.0 / power)); }

void fill_tile(const LightTaps& light, const Lobe& lobe, const Tile& tile, int size, std::vector<glm::vec3>& texels) {
    glm::dvec3 middle(0.0);
    std::vector<glm::dvec3> axes;
    for (int y = tile.top; y < tile.top + tile.side; ++y) {
        for (int x = tile.left; x < tile.left + tile.side; ++x) {
            axes.push_back(texel_axis(tile.face, x, y, size));
            middle += axes.back();
        }
    }
    middle = glm::normalize(middle);
    double spread_rad = 0.0;
    for (const glm::dvec3& axis : axes) {
        spread_rad = std::max(spread_rad, std::acos(std::min(glm::dot(axis, middle), 1.0)));
    }
    const std::vector<TapGroup> groups = lobe.groups_near(light.groups, middle, spread_rad);
    auto axis = axes.begin();
    for (int y = tile.top; y < tile.top + tile.side; ++y) {
        for (int x = tile.left; x < tile.left + tile.side; ++x, ++axis) {
            const std::vector<TapGroup> nearer = lobe.groups_near(groups, *axis, 0.0);
            texels[static_cast<std::size_t>((tile.face * size + y) * size + x)] =
                glm::vec3(lobe.radiance(light, nearer, *axis));
        }
    }
}

}  // namespace

Lobe::Lobe(double power)
    : power_(power),
      lowest_cosine_(std::pow(kSmallestWeight, 1.0 / power)),
      cone_rad_(std::acos(lowest_cosine_)),
      steps_per_cosine_(kSteps / (1.0 - lowest_cosine_)) {
    for (int i = 0; i <= kSteps + 1; ++i) {
        weights_.push_back(std::pow(lowest_cosine_ + i / steps_per_cosine_, power));
    }
}

std::vector<TapGroup> Lobe::groups_near(const std::vector<TapGroup>& groups, const glm::dvec3& axis,
                                        double spread_rad) const {
    std::vector<TapGroup> near;
    for (const TapGroup& group : groups) {
        const double angle = cone_rad_ + spread_rad + group.radius_rad + 1e-9;
        if (angle >= std::numbers::pi || glm::dot(group.axis, axis) > std::cos(angle)) near.push_back(group);
    }
    return near;
}

glm::dvec3 Lobe::radiance(const LightTaps& light, const std::vector<TapGroup>& groups, const glm::dvec3& axis) const {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (const TapGroup& group : groups) {
        for (std::size_t i = group.first; i < group.first + group.count; ++i) {
            const LightTap& tap = light.taps[i];
            const double place = (glm::dot(tap.direction, axis) - lowest_cosine_) * steps_per_cosine_;
            if (place <= 0.0) continue;
            // A cosine a rounding error over 1 reads the one entry past the end.
            const int step = std::min(static_cast<int>(place), kSteps);
            const double low = weights_[static_cast<std::size_t>(step)];
            const double high = weights_[static_cast<std::size_t>(step) + 1];
            const double weight = (low + (place - step) * (high - low)) * tap.solid_angle;
            sum += tap.radiance * weight;
            weights += weight;
        }
    }
    // Fine taps are 0.9 degrees apart and the narrowest cone is 13 wide, coarse ones 1.8 and 31: none falls between.
    expect(weights > 0.0, "a lobe reaches at least one tap");
    return sum / weights;
}

void prefilter(const Light& light, int threads, const std::function<void(double)>& progress, EnvironmentMap& map) {
    const std::vector<double> blinn = blinn_powers(map.size);
    std::vector<Lobe> lobes;
    std::vector<Tile> tiles;
    std::vector<double> costs;
    map.levels.clear();
    map.powers.clear();
    map.roughest_level = roughest_level(map.size);
    for (std::size_t level = 0; level + 1 < blinn.size(); ++level) {
        const int size = map.size >> level;
        lobes.emplace_back(phong_power(blinn[level]));
        map.powers.push_back(static_cast<float>(lobes.back().power()));
        map.levels.emplace_back(static_cast<std::size_t>(6 * size * size));
        const int side = std::min(size, kTileSide);
        for (int i = 0; i < 6 * size / side * (size / side); ++i) {
            const int tiles_in_row = size / side;
            tiles.push_back({static_cast<int>(level), i / (tiles_in_row * tiles_in_row), i % tiles_in_row * side,
                             i / tiles_in_row % tiles_in_row * side, side});
            const double taps = lobes.back().power() < kCoarseBelow ? 0.25 : 1.0;
            costs.push_back(side * side * taps * reach(lobes.back().power()));
        }
    }
    // The widest lobes are the dearest pieces: they come first, so that no thread ends long after the others.
    std::reverse(tiles.begin(), tiles.end());
    std::reverse(costs.begin(), costs.end());
    share_work(
        costs, threads,
        [&](std::size_t piece) {
            const Tile& tile = tiles[piece];
            const auto level = static_cast<std::size_t>(tile.level);
            fill_tile(lobes[level].power() < kCoarseBelow ? light.coarse : light.fine, lobes[level], tile,
                      map.size >> level, map.levels[level]);
        },
        progress);
    map.powers.push_back(0.0f);
    map.levels.emplace_back(6, glm::vec3(mean_radiance(light.fine)));
}

}  // namespace halfframe::content
