// What mediump really is on a device, found by drawing: the answer of glGetShaderPrecisionFormat is a promise only.
#pragma once

#include <string>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"

namespace halfframe::perf {

enum class Overflow { none, to_infinity, clamps };

/// What fragments of one arithmetic showed.
struct ArithmeticProbe {
    bool drawn = false;  ///< false: the control of the probe did not come back, nothing below means anything
    Overflow overflow = Overflow::none;  ///< (300*300)*0.001: inf or 65.5 in half, 90 in single precision
    bool loses_small_steps = false;      ///< ((1 + 2^-12) + 2^-12) - 1 is 0 in half, 2^-11 in single precision
    bool keeps_subnormals = false;       ///< (2^-14 * 2^-5) * 2^10 is not 0; in single precision no subnormal is met
    [[nodiscard]] bool is_half() const { return drawn && (overflow != Overflow::none || loses_small_steps); }
};

struct PrecisionProbe {
    ArithmeticProbe mediump;
    ArithmeticProbe highp;  ///< the control; equals `mediump` where the device has no fragment highp
    std::string sentence;
};

/// Draws one pixel with each arithmetic and reads it back. Leaves no GL object behind.
/// Error(check) for a shader that does not compile.
[[nodiscard]] PrecisionProbe probe_precision(gl::EntryPoints& gl, const gl::Caps& caps);

}  // namespace halfframe::perf
