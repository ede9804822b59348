// The table of powers.
#include "content/environment/lobe_powers.h"

#include <cmath>

#include "engine/error.h"

namespace halfframe::content {

std::vector<double> blinn_powers(int size) {
    expect(size >= 8 && (size & (size - 1)) == 0,
           "a cube that is prefiltered has a power of two of texels, 8 at least");
    std::vector<double> powers;
    for (int side = size; side >= 8; side /= 2) powers.push_back(0.0);
    const double last = static_cast<double>(powers.size()) - 1.0;
    for (std::size_t level = 0; level < powers.size(); ++level) {
        const double smoothness = 1.0 - static_cast<double>(level) / last;
        powers[level] = std::exp2(10.0 * smoothness + 1.0);
    }
    powers.insert(powers.end(), {2.0, 2.0});
    powers.push_back(0.0);
    return powers;
}

int roughest_level(int size) {
    int level = 0;
    for (int side = size; side > 8; side /= 2) ++level;
    return level;
}

double phong_power(double blinn_power) {
    const double p = blinn_power;
    return p / (4.00012 - 0.624042 / (p * p * p) + 0.728329 / (p * p) + 1.22792 / p) + 1.0;
}

}  // namespace halfframe::content
