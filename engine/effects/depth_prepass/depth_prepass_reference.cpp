// Depth and distance in double.
#include "engine/effects/depth_prepass/depth_prepass_reference.h"

namespace halfframe::reference {

double window_depth(double along_m, const DepthRange& range) {
    if (range.orthographic) return (along_m - range.near_m) / (range.far_m - range.near_m);
    return range.far_m * (along_m - range.near_m) / (along_m * (range.far_m - range.near_m));
}

double distance_at(double depth, const DepthRange& range) {
    if (range.orthographic) return range.near_m + depth * (range.far_m - range.near_m);
    return range.near_m * range.far_m / (range.far_m - depth * (range.far_m - range.near_m));
}

}  // namespace halfframe::reference
