// Projection, window, and the proof that the window is wide enough.
#include "content/environment/irradiance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/error.h"

namespace halfframe::content {
namespace {

constexpr double kPi = std::numbers::pi;
/// Share of the mean that stays at least: room for the rounding of nine floats.
constexpr double kMargin = 1e-6;
/// Share of what the darkest side truly receives that stays at least. All of it would flatten the bright side too.
constexpr double kDarkestShare = 0.75;
/// Directions that are asked for the darkest side: 16 degrees apart, where the widest lobe there is has 120.
constexpr int kDarkestDirections = 192;

std::array<double, 9> polynomial(const glm::dvec3& n) {
    return {1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y};
}

int band(std::size_t term) { return term == 0 ? 0 : term < 4 ? 1 : 2; }

/// Square of the constant that makes polynomial term i an orthonormal spherical harmonic.
double squared_norm(std::size_t term) {
    if (band(term) == 0) return 1.0 / (4.0 * kPi);
    if (band(term) == 1) return 3.0 / (4.0 * kPi);
    return (term == 6 ? 5.0 : term == 8 ? 15.0 : 60.0) / (16.0 * kPi);
}

/// Band of the clamped cosine, over pi: 1, 2/3, 1/4.
double cosine_band(std::size_t term) {
    static constexpr std::array<double, 3> kBands{1.0, 2.0 / 3.0, 0.25};
    return kBands[static_cast<std::size_t>(band(term))];
}

std::array<glm::dvec3, 9> windowed(const std::array<glm::dvec3, 9>& terms, double window) {
    std::array<glm::dvec3, 9> result = terms;
    for (std::size_t i = 1; i < 9; ++i) result[i] /= 1.0 + window * std::pow(band(i) * (band(i) + 1), 2.0);
    return result;
}

/// What the darkest side receives, by channel, summed over the light itself.
glm::dvec3 darkest_side(const LightTaps& light) {
    glm::dvec3 darkest(std::numeric_limits<double>::max());
    for (int i = 0; i < kDarkestDirections; ++i) {
        const double height = 1.0 - (2.0 * i + 1.0) / kDarkestDirections;
        const double turn = i * kPi * (3.0 - std::sqrt(5.0));  // the golden angle: an even spiral
        const double radius = std::sqrt(1.0 - height * height);
        const glm::dvec3 normal(radius * std::cos(turn), height, radius * std::sin(turn));
        glm::dvec3 sum(0.0);
        for (const LightTap& tap : light.taps) {
            sum += tap.radiance * (tap.solid_angle * std::max(glm::dot(normal, tap.direction), 0.0));
        }
        darkest = glm::min(darkest, sum / kPi);
    }
    return darkest;
}

bool is_nowhere_below(const std::array<glm::dvec3, 9>& terms, const glm::dvec3& darkest) {
    for (int channel = 0; channel < 3; ++channel) {
        std::array<double, 9> one{};
        for (std::size_t i = 0; i < 9; ++i) one[i] = terms[i][channel];
        if (lowest_value(one) < std::max(kMargin * one[0], kDarkestShare * darkest[channel])) return false;
    }
    return true;
}

/// The least window that is enough. The lowest value need not rise steadily with the window, so steps of a tenth find
/// the first that is enough, and halving finds its edge.
double least_window(const std::array<glm::dvec3, 9>& terms, const glm::dvec3& darkest) {
    if (is_nowhere_below(terms, darkest)) return 0.0;
    double too_small = 0.0;
    double enough = 1e-5;
    while (!is_nowhere_below(windowed(terms, enough), darkest)) {
        too_small = enough;
        enough *= 1.1;
        // The first band of light >= 0 is at most 2 times its mean, the second 5/4 times: a sixteenth of both leaves
        // more than three quarters of the mean, and no side is darker than the mean.
        expect(enough < 10.0, "a strong window leaves nearly the mean");
    }
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (too_small + enough);
        (is_nowhere_below(windowed(terms, middle), darkest) ? enough : too_small) = middle;
    }
    return enough;
}

/// Lowest eigenvalue of a symmetric matrix, from the angle form of the cubic's roots.
double lowest_eigenvalue(const glm::dmat3& a) {
    const double mean = (a[0][0] + a[1][1] + a[2][2]) / 3.0;
    const glm::dmat3 b = a - glm::dmat3(mean);
    double square = 0.0;
    for (int i = 0; i < 3; ++i) square += glm::dot(b[i], b[i]);
    const double scale = std::sqrt(square / 6.0);
    if (scale == 0.0) return mean;
    const double cosine = std::clamp(glm::determinant(b / scale) / 2.0, -1.0, 1.0);
    return mean + 2.0 * scale * std::cos((std::acos(cosine) + 2.0 * kPi) / 3.0);
}

}  // namespace

double lowest_value(const std::array<double, 9>& t) {
    // The polynomial is c + b.n + n^T A n. For every m that makes A + m 1 positive definite, and every unit n,
    //   c + b.n + n^T A n = c - m + b.n + n^T (A + m 1) n >= c - m - b^T (A + m 1)^-1 b / 4,
    // and the best m reaches the minimum (the Lagrange dual, exact for a quadratic on a sphere).
    const glm::dvec3 b(t[3], t[1], t[2]);
    const glm::dmat3 a(glm::dvec3(t[8], t[4] / 2.0, t[7] / 2.0), glm::dvec3(t[4] / 2.0, -t[8], t[5] / 2.0),
                       glm::dvec3(t[7] / 2.0, t[5] / 2.0, 3.0 * t[6]));
    const double constant = t[0] - t[6];
    double largest = 0.0;
    for (const double term : t) largest = std::max(largest, std::abs(term));
    if (largest == 0.0) return 0.0;
    const double start = -lowest_eigenvalue(a) + 1e-10 * largest;
    const auto bound = [&](double m) { return constant - m - 0.25 * glm::dot(b, glm::inverse(a + glm::dmat3(m)) * b); };
    // |(A + m 1)^-1 b| / 2 = 1 at the best m, so it is no further than |b| / 2 from the start. The bound is concave in
    // m.
    double low = start;
    double high = start + 0.5 * glm::length(b);
    for (int i = 0; i < 100; ++i) {
        const double left = low + (high - low) / 3.0;
        const double right = high - (high - low) / 3.0;
        (bound(left) < bound(right) ? low : high) = bound(left) < bound(right) ? left : right;
    }
    return std::max(bound(low), bound(start));
}

Irradiance irradiance(const LightTaps& light) {
    // Only what differs from the mean is projected: taps are no perfect quadrature, and a constant must stay constant.
    const glm::dvec3 mean = mean_radiance(light);
    Irradiance result;
    double solid_angle = 0.0;
    for (const LightTap& tap : light.taps) {
        const std::array<double, 9> basis = polynomial(tap.direction);
        const glm::dvec3 flux = (tap.radiance - mean) * tap.solid_angle;
        for (std::size_t i = 1; i < 9; ++i) result.terms[i] += flux * basis[i];
        solid_angle += tap.solid_angle;
    }
    result.terms[0] = mean;
    for (std::size_t i = 1; i < 9; ++i) {
        result.terms[i] *= squared_norm(i) * cosine_band(i) * (4.0 * kPi / solid_angle);
    }
    result.window = least_window(result.terms, darkest_side(light));
    result.terms = windowed(result.terms, result.window);
    return result;
}

}  // namespace halfframe::content
