// The depth that a place gets, in double, from its distance alone: what the prepass writes is measured against it. No
// matrix and no code of the engine's is in it.
#pragma once

namespace halfframe::reference {

/// What decides depth of a lens.
struct DepthRange {
    double near_m = 0.1;  ///< > 0 where not orthographic
    double far_m = 1000.0;
    bool orthographic = false;
};

/// Window depth, 0 at near and 1 at far, of what lies `along_m` before the eye, measured along its axis: even in
/// 1 / distance for a perspective, in the distance for parallel rays. OpenGL ES 3.0, sections 2.12 and 2.13.
[[nodiscard]] double window_depth(double along_m, const DepthRange& range);

/// The distance that has a depth of 0..1: the inverse.
[[nodiscard]] double distance_at(double depth, const DepthRange& range);

}  // namespace halfframe::reference
