// From an equirectangular picture to light taps, solid angle by solid angle.
#include "content/environment/light_taps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "content/environment/cube_face.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

constexpr double kPi = std::numbers::pi;
/// Taps a side of a group.
constexpr int kGroupSide = 8;
/// Pixels are cut at least this fine, in texels of 90 degrees / side: the smallest texel, in a corner, is 0.55 of that
/// wide, and none may stay empty.
constexpr double kFinest = 0.28;

struct TexelSum {
    glm::dvec3 flux{0.0};        ///< radiance times solid angle
    glm::dvec3 flux_place{0.0};  ///< directions weighted by flux, all channels together
    glm::dvec3 place{0.0};       ///< directions weighted by solid angle
    double solid_angle = 0.0;
};

int pieces(double angle_rad, int side) {
    const double finest_rad = kFinest * 0.5 * kPi / side;
    return std::max(1, static_cast<int>(std::ceil(angle_rad / finest_rad)));
}

/// Adds row `y` of the picture.
void add_row(const Equirectangular& picture, int y, int side, std::vector<TexelSum>& texels) {
    const double row_rad = kPi / picture.height;
    const double column_rad = 2.0 * kPi / picture.width;
    const int cuts = pieces(row_rad, side);
    for (int cut = 0; cut < cuts; ++cut) {
        // Angles from the zenith; cos top - cos bottom is the exact share of the sphere.
        const double top = row_rad * (y + static_cast<double>(cut) / cuts);
        const double bottom = row_rad * (y + static_cast<double>(cut + 1) / cuts);
        const double middle = 0.5 * (top + bottom);
        const double sine = std::sin(middle);
        const double height = std::cos(middle);
        const int columns = pieces(column_rad * sine, side);
        const double solid_angle = (std::cos(top) - std::cos(bottom)) * column_rad / columns;
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec3 radiance(picture.pixels[static_cast<std::size_t>(y) * picture.width + x]);
            const double light = radiance.r + radiance.g + radiance.b;
            for (int column = 0; column < columns; ++column) {
                const double azimuth = column_rad * (x + (column + 0.5) / columns);  // 0 at +Z, a quarter at -X
                const glm::dvec3 direction(-sine * std::sin(azimuth), height, sine * std::cos(azimuth));
                TexelSum& texel = texels[static_cast<std::size_t>(texel_of(direction, side))];
                texel.flux += radiance * solid_angle;
                texel.flux_place += direction * (light * solid_angle);
                texel.place += direction * solid_angle;
                texel.solid_angle += solid_angle;
            }
        }
    }
}

LightTap tap_of(const TexelSum& texel) {
    const bool has_light = glm::length(texel.flux_place) > 0.0;
    return {glm::normalize(has_light ? texel.flux_place : texel.place), texel.solid_angle,
            texel.flux / texel.solid_angle};
}

/// Appends the group at (left, top) of a face.
void add_group(const std::vector<TexelSum>& texels, int side, int face, int left, int top, LightTaps& light) {
    TapGroup group;
    group.first = light.taps.size();
    glm::dvec3 sum(0.0);
    for (int y = top; y < top + kGroupSide; ++y) {
        for (int x = left; x < left + kGroupSide; ++x) {
            const TexelSum& texel = texels[static_cast<std::size_t>((face * side + y) * side + x)];
            expect(texel.solid_angle > 0.0, "pixels are cut finer than the texels they are added to");
            light.taps.push_back(tap_of(texel));
            sum += light.taps.back().direction;
        }
    }
    group.count = light.taps.size() - group.first;
    group.axis = glm::normalize(sum);
    for (std::size_t i = group.first; i < light.taps.size(); ++i) {
        const double cosine = std::min(glm::dot(group.axis, light.taps[i].direction), 1.0);
        group.radius_rad = std::max(group.radius_rad, std::acos(cosine));
    }
    light.groups.push_back(group);
}

}  // namespace

LightTaps light_taps(const Equirectangular& picture, int side) {
    std::vector<TexelSum> texels(static_cast<std::size_t>(6) * side * side);
    for (int y = 0; y < picture.height; ++y) add_row(picture, y, side, texels);
    LightTaps light;
    light.taps.reserve(texels.size());
    for (int face = 0; face < 6; ++face) {
        for (int top = 0; top < side; top += kGroupSide) {
            for (int left = 0; left < side; left += kGroupSide) add_group(texels, side, face, left, top, light);
        }
    }
    return light;
}

glm::dvec3 mean_radiance(const LightTaps& light) {
    glm::dvec3 flux(0.0);
    double solid_angle = 0.0;
    for (const LightTap& tap : light.taps) {
        flux += tap.radiance * tap.solid_angle;
        solid_angle += tap.solid_angle;
    }
    return flux / solid_angle;
}

}  // namespace halfframe::content
