// The tone curve as its source defines it, in double: what tone_map.glsl is measured against. Shares no code with it.
#pragma once

namespace halfframe::reference {

/// Display value 0..1 of linear light >= 0: y = B x / (x + 0.22), with B such that a light of 8 gives 1; white above.
/// S. Lagarde and L. Harduin, "The Art and Rendering of Remember Me", GDC Europe 2013, "LDR sky".
[[nodiscard]] double tone_curve(double light);

/// The light 0..8 that tone_curve() turns into `display` 0..1; below 0 it is 0, above 1 it is 8.
[[nodiscard]] double inverse_tone_curve(double display);

}  // namespace halfframe::reference
