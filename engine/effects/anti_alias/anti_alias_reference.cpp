// The area of a pixel behind a straight line, in double.
#include "engine/effects/anti_alias/anti_alias_reference.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace halfframe::reference {

double pixel_coverage(double x, double y, double a, double b, double c) {
    using Point = std::pair<double, double>;
    const std::vector<Point> square = {{x, y}, {x + 1.0, y}, {x + 1.0, y + 1.0}, {x, y + 1.0}};
    const auto side = [&](const Point& point) { return a * point.first + b * point.second + c; };
    std::vector<Point> inside;  // the part of the square before the line, corner by corner
    for (std::size_t i = 0; i < square.size(); ++i) {
        const Point& from = square[i];
        const Point& to = square[(i + 1) % square.size()];
        const double s = side(from), t = side(to);
        if (s > 0.0) inside.push_back(from);
        if ((s > 0.0) != (t > 0.0)) {
            const double u = s / (s - t);
            inside.emplace_back(from.first + u * (to.first - from.first), from.second + u * (to.second - from.second));
        }
    }
    double twice = 0.0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const Point& from = inside[i];
        const Point& to = inside[(i + 1) % inside.size()];
        twice += from.first * to.second - to.first * from.second;
    }
    return std::clamp(0.5 * twice, 0.0, 1.0);
}

double run_coverage(double near_end, double far_end) {
    // The pixel's row is y 0..1, its centre at x = 0. The line falls from y = 1/2 at -near_end to y = 3/2 at far_end,
    // and what is beyond lies above it: where the line is above 1 there is nothing of it in this row.
    const double slope = 1.0 / (near_end + far_end);
    return pixel_coverage(-0.5, 0.0, -slope, 1.0, -0.5 - slope * near_end);
}

double luma(double red, double green, double blue) { return (299.0 * red + 587.0 * green + 114.0 * blue) / 1000.0; }

}  // namespace halfframe::reference
