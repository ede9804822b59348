// The sky's gradient in double: what sky.glsl is measured against. Shares no code with it.
#pragma once

namespace halfframe::reference {

/// One channel of the gradient [display value 0..1]. `height`: sine of the elevation, -1..1; the three colours 0..1.
/// Above the horizon the share of the zenith is 1 - (1 - height)^3. Below it the ground comes in as a smooth step that
/// ends at height -1/8, 7 degrees down. This project's own definition: no source gives one.
[[nodiscard]] double sky_gradient(double height, double zenith, double horizon, double ground);

}  // namespace halfframe::reference
