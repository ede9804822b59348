// When a pass is flushed before its end. Workaround llvmpipe_rasters_at_flush: Mesa 22.3's llvmpipe transforms vertices on
// the thread that calls, and its workers begin with the pixels of a pass when that is flushed or over. Flushed on the way,
// both go on at once: a frame of 121 thousand triangles in 115 draws takes 0.88 of its time on two cores at console, 0.94
// at low; its processor time stays. A tiler would store and load its tiles at every flush, and is not told. One draw is
// never split: a globe in two halves took 1.03 of its time.
#pragma once

#include <cstdint>

namespace halfframe {

/// A pass is flushed once so many triangles were drawn since its last flush, and only where as many are to come in it: at
/// its end a flush buys nothing.
inline constexpr std::int64_t kFlushTriangles = 35'000;

}  // namespace halfframe
