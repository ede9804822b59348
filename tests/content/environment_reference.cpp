// Brute force: midpoint sums over the sphere, fine enough that their own error is under 1e-5.
#include "tests/content/environment_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfframe::tests {
namespace {

const double kTurn = 2.0 * std::acos(-1.0);

/// Two directions that make a right-handed frame with `axis`.
std::array<glm::dvec3, 2> across(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
    return {first, glm::cross(axis, first)};
}

glm::dvec3 about(const glm::dvec3& axis, double cosine, double angle) {
    const auto [a, b] = across(axis);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return axis * cosine + (a * std::cos(angle) + b * std::sin(angle)) * sine;
}

double sun_solid_angle(const FormulaSky& sky) { return kTurn * (1.0 - std::cos(sky.sun_radius_rad)); }

/// Mean of the lobe's density over the sun's disc [1/sr].
double density_on_sun(const FormulaSky& sky, const glm::dvec3& axis, double power) {
    constexpr int kRings = 24;
    constexpr int kSpokes = 24;
    double sum = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        // Rings of equal solid angle.
        const double cosine = 1.0 - (1.0 - std::cos(sky.sun_radius_rad)) * (ring + 0.5) / kRings;
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const glm::dvec3 l = about(sky.sun_direction, cosine, kTurn * (spoke + 0.5) / kSpokes);
            sum += std::pow(std::max(glm::dot(l, axis), 0.0), power);
        }
    }
    return sum / (kRings * kSpokes) * (power + 1.0) / kTurn;
}

/// The columns: where a face looks, and where its s and t grow.
struct FaceAxes {
    glm::dvec3 major;
    glm::dvec3 s;
    glm::dvec3 t;
};
const std::array<FaceAxes, 6> kFaces{{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                      {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                      {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                      {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                      {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                      {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

glm::dvec3 texel(const EnvironmentMap& map, std::size_t level, int face, int x, int y) {
    const int size = std::max(map.size >> level, 1);
    return glm::dvec3(map.levels.at(level).at(static_cast<std::size_t>((face * size + y) * size + x)));
}

}  // namespace

glm::dvec3 gradient_radiance(const FormulaSky& sky, const glm::dvec3& direction) {
    const double rise = glm::dot(direction, sky.slope);
    return glm::dvec3(0.5, 0.4, 0.6) + glm::dvec3(0.3, 0.2, 0.1) * rise + glm::dvec3(0.1, 0.2, 0.3) * rise * rise;
}

glm::dvec3 lobe_integral(const FormulaSky& sky, const glm::dvec3& axis, double power) {
    constexpr int kRings = 160;
    constexpr int kSpokes = 8;  // the gradient is of second degree: 3 would be enough
    glm::dvec3 sum(0.0);
    for (int ring = 0; ring < kRings; ++ring) {
        // Rings of equal weight under the lobe: its integral from cosine c to 1 is 1 - c^(power + 1).
        const double cosine = std::pow((ring + 0.5) / kRings, 1.0 / (power + 1.0));
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            sum += gradient_radiance(sky, about(axis, cosine, kTurn * (spoke + 0.5) / kSpokes));
        }
    }
    return sum / static_cast<double>(kRings * kSpokes) +
           sky.sun_radiance * (sun_solid_angle(sky) * density_on_sun(sky, axis, power));
}

content::Equirectangular picture_of(const FormulaSky& sky, int height) {
    constexpr int kSamples = 32;  // a side of a pixel, where the sun may be
    content::Equirectangular picture{2 * height, height, {}};
    const double pixel_rad = 0.5 * kTurn / height;
    const auto direction = [&](double row, double column) {
        const double polar = row * pixel_rad;
        const double azimuth = column * pixel_rad;  // the middle column (half a turn) looks along -Z
        return glm::dvec3(-std::sin(azimuth) * std::sin(polar), std::cos(polar), std::cos(azimuth) * std::sin(polar));
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 2 * height; ++x) {
            const glm::dvec3 middle = direction(y + 0.5, x + 0.5);
            glm::dvec3 radiance = gradient_radiance(sky, middle);
            if (glm::distance(middle, sky.sun_direction) < sky.sun_radius_rad + 2.0 * pixel_rad) {
                double inside = 0.0;
                double all = 0.0;
                for (int i = 0; i < kSamples * kSamples; ++i) {
                    const double row = y + (i / kSamples + 0.5) / kSamples;
                    const glm::dvec3 d = direction(row, x + (i % kSamples + 0.5) / kSamples);
                    const double weight = std::sin(row * pixel_rad);
                    all += weight;
                    if (glm::dot(d, sky.sun_direction) > std::cos(sky.sun_radius_rad)) inside += weight;
                }
                radiance += sky.sun_radiance * (inside / all);
            }
            picture.pixels.emplace_back(radiance);
        }
    }
    return picture;
}

FacePlace place_on_face(const glm::dvec3& direction, int face) {
    const FaceAxes& axes = kFaces.at(static_cast<std::size_t>(face));
    const double major = glm::dot(direction, axes.major);
    return {face, 0.5 + 0.5 * glm::dot(direction, axes.s) / major, 0.5 + 0.5 * glm::dot(direction, axes.t) / major};
}

FacePlace place_of(const glm::dvec3& direction) {
    int best = 0;
    for (int face = 1; face < 6; ++face) {
        const auto along = [&](int i) { return glm::dot(direction, kFaces.at(static_cast<std::size_t>(i)).major); };
        if (along(face) > along(best)) best = face;
    }
    return place_on_face(direction, best);
}

glm::dvec3 texel_direction(int face, int x, int y, int size, bool warped) {
    const auto moved = [&](int index) {
        const double u = (2.0 * index + 1.0) / size - 1.0;
        return warped ? u + std::pow(u, 3) * std::pow(size, 2) / std::pow(size - 1.0, 3) : u;
    };
    const FaceAxes& axes = kFaces.at(static_cast<std::size_t>(face));
    return glm::normalize(axes.major + moved(x) * axes.s + moved(y) * axes.t);
}

glm::dvec3 sampled(const EnvironmentMap& map, std::size_t level, const FacePlace& place) {
    const int size = std::max(map.size >> level, 1);
    const double x = std::clamp(place.s * size - 0.5, 0.0, size - 1.0);
    const double y = std::clamp(place.t * size - 0.5, 0.0, size - 1.0);
    const int left = static_cast<int>(x);
    const int top = static_cast<int>(y);
    const int right = std::min(left + 1, size - 1);
    const int bottom = std::min(top + 1, size - 1);
    return glm::mix(
        glm::mix(texel(map, level, place.face, left, top), texel(map, level, place.face, right, top), x - left),
        glm::mix(texel(map, level, place.face, left, bottom), texel(map, level, place.face, right, bottom), x - left),
        y - top);
}

double lobe_error(const EnvironmentMap& map, std::size_t level, double power, const FormulaSky& sky,
                  std::size_t stride) {
    const int size = map.size >> level;
    double worst = 0.0;
    for (std::size_t i = 0; i < map.levels.at(level).size(); i += stride) {
        const int texel_in_face = static_cast<int>(i) % (size * size);
        const glm::dvec3 axis =
            texel_direction(static_cast<int>(i) / (size * size), texel_in_face % size, texel_in_face / size, size);
        worst = std::max(worst, relative_error(map.levels.at(level)[i], lobe_integral(sky, axis, power)));
    }
    return worst;
}

double seam_error(const EnvironmentMap& map, std::size_t level) {
    double worst = 0.0;
    for (int a = 0; a < 6; ++a) {
        for (int b = a + 1; b < 6; ++b) {
            const glm::dvec3 corner =
                kFaces.at(static_cast<std::size_t>(a)).major + kFaces.at(static_cast<std::size_t>(b)).major;
            if (glm::length(corner) < 0.5) continue;  // opposite faces
            const glm::dvec3 along(corner.x == 0.0, corner.y == 0.0, corner.z == 0.0);
            for (int i = 0; i <= 200; ++i) {
                const glm::dvec3 direction = corner + along * (i / 100.0 - 1.0);
                const glm::dvec3 here = sampled(map, level, place_on_face(direction, a));
                worst = std::max(worst, relative_error(here, sampled(map, level, place_on_face(direction, b))));
            }
        }
    }
    return worst;
}

glm::dvec3 shown_by_lambert(const EnvironmentMap& map, const glm::dvec3& n) {
    const std::array<double, 9> terms{
        1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y};
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < 9; ++i) sum += glm::dvec3(map.irradiance[i]) * terms[i];
    return sum;
}

std::vector<glm::dvec3> even_directions(int count) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < count; ++i) {
        const double y = 1.0 - (2.0 * i + 1.0) / count;
        const double angle = kTurn * i * 0.6180339887498949;
        const double radius = std::sqrt(1.0 - y * y);
        directions.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
    return directions;
}

double relative_error(const glm::dvec3& actual, const glm::dvec3& expected) {
    const glm::dvec3 difference = glm::abs(actual - expected);
    return std::max({difference.r, difference.g, difference.b}) / std::max({expected.r, expected.g, expected.b});
}

}  // namespace halfframe::tests
