// Which arguments shader functions really get: recorded while the built-in scenes are drawn, not chosen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "perf/stability/declaration.h"

namespace halfframe::stability {

struct SeenArgument {
    std::string function;
    std::string parameter;
    std::size_t pixels = 0;  ///< that gave it; 0: no built-in scene does
    double low = 0.0, high = 0.0;
    std::string lowest_in, highest_in;  ///< scenes
    Domain declared;
    [[nodiscard]] bool covered() const { return pixels == 0 || (low >= declared.low && high <= declared.high); }
};

/// What is not recorded, and why; for a report.
[[nodiscard]] const char* unrecorded_arguments();

/// Draws every built-in scene with the arguments that a fragment of a surface knows in place of its colour, each in as
/// many pixels, as a census in full arithmetic at the console tier. `step` is called before each scene. The device takes
/// a census (RGBA32F targets).
[[nodiscard]] std::vector<SeenArgument> see_arguments(gl::EntryPoints& gl, const gl::Caps& caps,
                                                      const std::function<void(const std::string& scene)>& step = {});

/// "surface.glsl: direct_light.radiance" and so on, for a terminal; and a sentence for each that is outside its domain.
[[nodiscard]] std::string arguments_text(const std::vector<SeenArgument>& seen);
[[nodiscard]] std::vector<std::string> violations_of(const std::vector<SeenArgument>& seen);

}  // namespace halfframe::stability
