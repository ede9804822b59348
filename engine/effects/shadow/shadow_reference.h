// Shadows in double: rays against triangles. What the shadow is measured against. Shares no code with it.
#pragma once

#include <array>
#include <vector>

namespace halfframe::reference {

using Point = std::array<double, 3>;

struct Triangle {
    std::array<Point, 3> corners;
};

/// How far the ray from `from` along `toward` (unit) goes until it meets the triangle [m]; infinite when it does not.
/// On an edge counts.
[[nodiscard]] double distance_to(const Triangle& triangle, const Point& from, const Point& toward);

/// Share of a beam of parallel light, `width_m` wide and square, that reaches `at`: rays x rays of them, towards the
/// sun. `across` and `third`: the beam's axes, unit, at right angles to `toward_sun`. A triangle in the plane of `at`
/// stops nothing: rays start on the plane through `at` with the unit normal `normal`, `least` above it.
[[nodiscard]] double lit_share(const std::vector<Triangle>& triangles, const Point& at, const Point& normal,
                               const Point& toward_sun, const Point& across, const Point& third, double width_m,
                               double least_m, int rays);

/// The step off the surface [m] that keeps a plane, tilted by `angle_rad` 0..pi/2 against the light, out of its own
/// shadow within `reach_m`: the depth that the plane loses over the reach, measured back along the normal.
[[nodiscard]] double plane_lift(double angle_rad, double reach_m);

/// What is left 0..1 under a blob at `distance` from its middle [radii]; `strength` 0..1. This project's own curve:
/// 1 - strength (1 - 2 d^2 + d^4) inside, 1 outside.
[[nodiscard]] double blob_left(double distance, double strength);

}  // namespace halfframe::reference
