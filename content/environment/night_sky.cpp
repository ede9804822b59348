// Neo-Paris at night: desaturated blue-grey with hints of brighter blue, purple and red (the talk's palette). No stars:
// the sharpest lobe is six degrees wide, so a star comes out as nothing; and no rain.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "content/environment/built_in_environments.h"

namespace halfframe::content {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::uint32_t kSeed = 2084;

/// 0..1, by place (constants of the PCG family).
double noise(int x, int y) {
    std::uint32_t state =
        (static_cast<std::uint32_t>(x) * 747796405u + static_cast<std::uint32_t>(y) * 2891336453u) + kSeed * 277803737u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return static_cast<double>(((state >> 22u) ^ state) >> 8u) / 16777215.0;
}

/// Smooth noise round the horizon: `count` values over the full turn, 0..1.
double round_noise(double azimuth_deg, int count, int row) {
    const double place = azimuth_deg / 360.0 * count;
    const int left = static_cast<int>(std::floor(place));
    const double t = glm::smoothstep(0.0, 1.0, place - left);
    return glm::mix(noise((left % count + count) % count, row), noise(((left + 1) % count + count) % count, row), t);
}

/// A lit sign, soft at its edges.
struct Sign {
    double azimuth_deg;    ///< from -Z towards +X
    double elevation_deg;  ///< of its middle
    double half_width_deg;
    double half_height_deg;
    glm::dvec3 radiance;
};

const glm::dvec3 kRed{7.5, 0.75, 0.55};
const glm::dvec3 kPurple{3.0, 1.0, 5.2};
const glm::dvec3 kBlue{0.6, 2.6, 6.6};
const std::array<Sign, 10> kSigns{{{-24.0, 9.0, 1.3, 5.0, kRed},
                                   {17.0, 6.0, 2.6, 1.3, kBlue},
                                   {58.0, 12.0, 1.2, 6.0, kPurple},
                                   {74.0, 5.0, 3.0, 1.0, kRed},
                                   {112.0, 8.0, 1.5, 3.6, kBlue},
                                   {158.0, 5.0, 2.4, 1.6, kPurple},
                                   {-150.0, 10.0, 1.1, 5.5, kBlue},
                                   {-118.0, 4.5, 3.2, 1.2, kPurple},
                                   {-88.0, 13.0, 1.3, 4.5, kRed},
                                   {-57.0, 6.0, 2.2, 1.5, kBlue}}};

/// -180..180, for angles of that range: the bits of std::remainder() at a tenth of its time.
double turn_between(double a_deg, double b_deg) {
    const double turn = a_deg - b_deg;
    return turn > 180.0 ? turn - 360.0 : turn < -180.0 ? turn + 360.0 : turn;
}

glm::dvec3 signs(double azimuth_deg, double elevation_deg) {
    glm::dvec3 sum(0.0);
    for (const Sign& sign : kSigns) {
        const double x = std::abs(turn_between(azimuth_deg, sign.azimuth_deg)) / sign.half_width_deg;
        const double y = std::abs(elevation_deg - sign.elevation_deg) / sign.half_height_deg;
        const double core = (1.0 - glm::smoothstep(0.7, 1.0, x)) * (1.0 - glm::smoothstep(0.7, 1.0, y));
        // What haze and wet walls round the sign send on.
        const double degrees =
            std::hypot(std::max(x - 1.0, 0.0) * sign.half_width_deg, std::max(y - 1.0, 0.0) * sign.half_height_deg);
        sum += sign.radiance * (core + 0.035 * std::exp(-degrees / 4.0));
    }
    return sum;
}

/// Height of the roofs [degrees]: blocks of different widths, `row` chooses the street.
double roofs_deg(double azimuth_deg, int blocks, int row, double low_deg, double high_deg) {
    const double turn = (azimuth_deg + 2.5 * std::sin(azimuth_deg * kDegree * 7.0)) / 360.0;
    const int block = (static_cast<int>(std::floor(turn * blocks)) % blocks + blocks) % blocks;
    const double height = noise(block, row);
    return low_deg + (high_deg - low_deg) * height * height;
}

/// Sky above the roofs: a gradient, haze lit by the city, torn clouds.
glm::dvec3 open_sky(double azimuth_deg, double elevation_deg) {
    const double up = std::clamp(elevation_deg / 90.0, 0.0, 1.0);
    const glm::dvec3 gradient =
        glm::mix(glm::dvec3(0.056, 0.076, 0.096), glm::dvec3(0.016, 0.022, 0.033), std::pow(up, 0.55));
    const double patch = 0.45 + 0.75 * round_noise(azimuth_deg, 7, 101);
    const double violet = round_noise(azimuth_deg, 5, 102);
    const glm::dvec3 city = glm::mix(glm::dvec3(0.25, 0.29, 0.31), glm::dvec3(0.23, 0.21, 0.29), violet);
    const double cloud =
        round_noise(azimuth_deg + 0.8 * elevation_deg, 24, 103 + static_cast<int>(elevation_deg / 9.0));
    const double cloud_next =
        round_noise(azimuth_deg + 0.8 * elevation_deg, 24, 104 + static_cast<int>(elevation_deg / 9.0));
    const double torn = glm::mix(cloud, cloud_next, std::fmod(elevation_deg, 9.0) / 9.0);
    return gradient + city * (patch * std::exp(-elevation_deg / 11.0)) +
           glm::dvec3(0.060, 0.066, 0.078) * (torn * torn * std::exp(-elevation_deg / 35.0));
}

glm::dvec3 moon(double azimuth_deg, double elevation_deg) {
    // Wider than the real one's 0.26 degrees, as seen through haze, so that it still is a highlight after filtering.
    const double x = turn_between(azimuth_deg, 38.0) * std::cos(elevation_deg * kDegree);
    const double degrees = std::hypot(x, elevation_deg - 41.0);
    return glm::dvec3(0.86, 0.93, 1.0) *
           (15.0 * (1.0 - glm::smoothstep(1.5, 2.1, degrees)) + 0.16 * std::exp(-degrees / 5.0));
}

glm::dvec3 above_ground(double azimuth_deg, double elevation_deg) {
    glm::dvec3 light = open_sky(azimuth_deg, elevation_deg);
    if (elevation_deg < roofs_deg(azimuth_deg, 41, 7, 3.0, 17.0))
        light = 0.32 * light + glm::dvec3(0.014, 0.017, 0.024);
    if (elevation_deg < roofs_deg(azimuth_deg, 23, 8, 1.0, 24.0)) {
        // A lit floor here and there.
        const double windows = noise(static_cast<int>(std::floor(azimuth_deg * 0.9)),
                                     static_cast<int>(std::floor(elevation_deg * 0.7)) + 500);
        light = glm::dvec3(0.011, 0.013, 0.018) + glm::dvec3(0.30, 0.25, 0.18) * (windows > 0.90  ? 0.7
                                                                                  : windows > 0.8 ? 0.12
                                                                                                  : 0.0);
    }
    return light + signs(azimuth_deg, elevation_deg) + moon(azimuth_deg, elevation_deg);
}

}  // namespace

glm::dvec3 night_sky_radiance(const glm::dvec3& direction) {
    const double elevation_deg = std::asin(std::clamp(direction.y, -1.0, 1.0)) / kDegree;
    const double azimuth_deg = std::atan2(direction.x, -direction.z) / kDegree;
    if (elevation_deg >= 0.0) return above_ground(azimuth_deg, elevation_deg);
    // The street is wet: it shows the city upside down, dimmer the steeper one looks, and longer than it is.
    const double mirrored = 0.012 + 0.44 * std::exp(elevation_deg / 13.0);
    return glm::dvec3(0.010, 0.011, 0.014) + mirrored * above_ground(azimuth_deg, -0.7 * elevation_deg);
}

}  // namespace halfframe::content
