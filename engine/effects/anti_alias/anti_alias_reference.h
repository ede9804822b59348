// What anti_alias is measured against, in double: the area of a pixel behind a straight line, by clipping a polygon.
#pragma once

namespace halfframe::reference {

/// Share 0..1 of the pixel from (x, y) to (x + 1, y + 1) where a x + b y + c > 0.
[[nodiscard]] double pixel_coverage(double x, double y, double a, double b, double c);

/// The share of a pixel beyond the line whose staircase has a run from `near_end` before the pixel's centre to
/// `far_end` behind it: the line enters half a pixel inside the row and leaves half a pixel outside.
[[nodiscard]] double run_coverage(double near_end, double far_end);

/// Luma of Rec. 601, for one channel: what a channel of `value` adds.
[[nodiscard]] double luma(double red, double green, double blue);

}  // namespace halfframe::reference
