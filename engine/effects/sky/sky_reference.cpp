// The sky's gradient in double.
#include "engine/effects/sky/sky_reference.h"

#include <cmath>

namespace halfframe::reference {

double sky_gradient(double height, double zenith, double horizon, double ground) {
    if (height >= 0.0) {
        const double horizon_share = std::pow(1.0 - height, 3.0);
        return horizon_share * horizon + (1.0 - horizon_share) * zenith;
    }
    constexpr double kGroundFrom = -0.125;
    if (height <= kGroundFrom) return ground;
    const double depth = height / kGroundFrom;
    const double ground_share = 3.0 * std::pow(depth, 2.0) - 2.0 * std::pow(depth, 3.0);
    return ground_share * ground + (1.0 - ground_share) * horizon;
}

}  // namespace halfframe::reference
