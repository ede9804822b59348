// Rays against triangles, and the two small curves, in double.
#include "engine/effects/shadow/shadow_reference.h"

#include <cmath>
#include <limits>

namespace halfframe::reference {

namespace {

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double product(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// Six times the signed volume of the tetrahedron 0, a, b, c.
double volume(const Point& a, const Point& b, const Point& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

}  // namespace

double distance_to(const Triangle& triangle, const Point& from, const Point& toward) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    // The line passes inside when it is on the same side of the three edges; the volumes are also the weights of the
    // corners at the place where it meets the plane.
    Point weights{};
    std::array<Point, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = minus(triangle.corners[i], from);
    for (std::size_t i = 0; i < 3; ++i) weights[i] = volume(toward, corners[(i + 1) % 3], corners[(i + 2) % 3]);
    const bool all_left = weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0;
    const bool all_right = weights[0] <= 0.0 && weights[1] <= 0.0 && weights[2] <= 0.0;
    const double sum = weights[0] + weights[1] + weights[2];
    if ((!all_left && !all_right) || sum == 0.0) return kNever;
    double distance = 0.0;
    for (std::size_t i = 0; i < 3; ++i) distance += weights[i] / sum * product(corners[i], toward);
    return distance > 0.0 ? distance : kNever;
}

double lit_share(const std::vector<Triangle>& triangles, const Point& at, const Point& normal, const Point& toward_sun,
                 const Point& across, const Point& third, double width_m, double least_m, int rays) {
    int lit = 0;
    for (int i = 0; i < rays * rays; ++i) {
        const double a = width_m * ((i % rays + 0.5) / rays - 0.5);
        const double b = width_m * ((i / rays + 0.5) / rays - 0.5);
        Point from{};
        for (std::size_t axis = 0; axis < 3; ++axis) from[axis] = at[axis] + a * across[axis] + b * third[axis];
        // Back along the light onto the plane of the surface.
        const double along = -product(minus(from, at), normal) / product(toward_sun, normal);
        for (std::size_t axis = 0; axis < 3; ++axis) from[axis] += along * toward_sun[axis];
        bool stopped = false;
        for (const Triangle& triangle : triangles) {
            const double distance = distance_to(triangle, from, toward_sun);
            stopped = stopped || (distance > least_m && std::isfinite(distance));
        }
        lit += stopped ? 0 : 1;
    }
    return static_cast<double>(lit) / (rays * rays);
}

double plane_lift(double angle_rad, double reach_m) {
    const double depth_lost = reach_m * std::tan(angle_rad);
    return depth_lost * std::cos(angle_rad);
}

double blob_left(double distance, double strength) {
    if (distance >= 1.0) return 1.0;
    return 1.0 - strength * (1.0 - 2.0 * std::pow(distance, 2.0) + std::pow(distance, 4.0));
}

}  // namespace halfframe::reference
