// The model: pure functions from counts and a profile to milliseconds. perf/cost/README.md has the formulas.
#pragma once

#include <string>
#include <vector>

#include "perf/cost/pass_work.h"
#include "perf/cost/profile.h"

namespace halfframe::cost {

struct UnitTime {
    std::string unit;  ///< "shader", "targets", "memory", "vertices", "triangles", "arithmetic", "texture", ...
    double ms = 0.0;
    bool shading = false;  ///< scales with how well a compiler packs: the band is of this
};

/// Milliseconds of a pass, or of several together.
struct PassCost {
    std::string name;
    std::vector<UnitTime> units;  ///< side by side: the time of the pass is the norm of these
    double fixed_ms = 0.0;        ///< target switch and draws
    double resolve_ms = 0.0;      ///< never overlapped
    double ms = 0.0;              ///< central value
    double low_ms = 0.0;          ///< every slot filled
    double high_ms = 0.0;         ///< a third of the slots empty
    double shortest_ms = 0.0;     ///< every fragment takes the short side of every branch
    double longest_ms = 0.0;
    std::string bound;  ///< the unit that takes most, "draws and switches" or "resolve"
    double memory_bytes = 0.0;
    int edram_tiles = 0;    ///< 0: no such memory
    int edram_replays = 1;  ///< times the commands run because the targets do not fit
    double passes =
        0.0;  ///< RSX: shader passes a fragment, mean over the draws; Xenos: instructions; ES 2: multiply-adds
    double temporaries = 0.0;  ///< fp32 vec4, the most of any draw
};

[[nodiscard]] PassCost cost_of(const PassWork& pass, const Profile& profile);

/// Shader passes of a fragment on the RSX, not rounded: max(fetch clocks, (A + 0.5 normalizes + fetches) / (2 eta) +
/// clocks above one a fetch).
[[nodiscard]] double rsx_passes(const FragmentWork& fragment, const Profile& profile, double packing);
/// 32-bit samples of a target that fill one tile of EDRAM hold 80 x 16; wider formats take their multiple.
[[nodiscard]] int edram_tiles(int width, int height, int samples, int bytes_per_sample, const Profile& profile);
/// Milliseconds of a copy from EDRAM to memory.
[[nodiscard]] double resolve_ms(double pixels, double bytes_per_pixel, const Profile& profile);
/// Bytes of a pixel of that target on the device: Xenos holds floats of scenes as 7e3, 32 bits.
[[nodiscard]] int bytes_on(gl::PixelFormat format, const Profile& profile);

}  // namespace halfframe::cost
