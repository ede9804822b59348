// Records the GL calls of a frame with their data, and makes them again in a bare loop: what the driver alone takes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/gl/entry_points.h"

namespace halfframe::bench {

/// One at a time: functions that a driver calls carry no pointer to who records.
class CallRecorder {
public:
    /// Hands `loader`'s functions on, each behind one that can record.
    [[nodiscard]] static gl::Loader around(gl::Loader loader);
    /// Forgets what was recorded and records from here on.
    static void start();
    static void stop();
    /// Makes the recorded calls again.
    static void replay();
    [[nodiscard]] static std::size_t calls();
};

}  // namespace halfframe::bench
