// The tone curve in double, as its source defines it.
#include "engine/effects/tone_map/tone_map_reference.h"

namespace halfframe::reference {
namespace {

constexpr double kWhite = 8.0;
constexpr double kBend = 0.22;
constexpr double kScale = (kWhite + kBend) / kWhite;

}  // namespace

double tone_curve(double light) {
    if (light >= kWhite) return 1.0;
    return kScale * light / (light + kBend);
}

double inverse_tone_curve(double display) {
    if (display <= 0.0) return 0.0;
    if (display >= 1.0) return kWhite;
    // y (x + A) = B x, solved for x.
    return display * kBend / (kScale - display);
}

}  // namespace halfframe::reference
