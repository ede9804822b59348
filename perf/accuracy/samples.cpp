// Deterministic inputs for shader functions.
#include "perf/accuracy/samples.h"

#include <array>
#include <cmath>

#include "engine/error.h"

namespace halfframe::accuracy {

std::vector<std::vector<double>> unit_cube(std::size_t dimensions) {
    constexpr std::size_t kInside = 4096;
    constexpr std::array kPrimes{2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0};
    expect(dimensions >= 1 && dimensions <= kPrimes.size(), "samples have 1 to 10 dimensions");
    std::vector<std::vector<double>> points(dimensions);
    for (std::size_t dimension = 0; dimension < dimensions; ++dimension) {
        std::vector<double>& values = points[dimension];
        const std::size_t corners = std::size_t{1} << dimensions;
        for (std::size_t corner = 0; corner < corners; ++corner) {
            values.push_back(static_cast<double>((corner >> dimension) & 1u));
        }
        const double step = std::sqrt(kPrimes[dimension]);
        for (std::size_t i = 1; i <= kInside; ++i) {
            const double at = static_cast<double>(i) * step;
            values.push_back(at - std::floor(at));
        }
    }
    return points;
}

}  // namespace halfframe::accuracy
