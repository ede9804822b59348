// Draws one scene as it was wished and gathers all that can be seen of it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/frame_plan.h"
#include "engine/frame/image.h"
#include "engine/frame/scene.h"
#include "perf/report/frame_report.h"

namespace halfframe::perf {

struct DrawRequest {
    int measured_frames = 5;  ///< 0: no timing
    bool census = false;      ///< draw the plan once more with every target RGBA32F and count NaN and inf
    bool trace = false;       ///< record every call of prepare() and of exactly one frame; nothing is timed then
    bool linear = false;      ///< also read scene_color as floats
    std::filesystem::path program_cache_folder;  ///< empty: none on disk
    /// Called between steps and frames with words for the user; throws to stop.
    std::function<void(const std::string& step)> between = [](const std::string&) {};
};

struct DrawResult {
    FrameReport report;
    std::optional<FloatPicture> linear;  ///< linear light of scene_color; display values where the plan has none
    std::string trace_json;              ///< empty without DrawRequest::trace
};

/// Plans, checks, prepares, draws, measures. The context behind `gl` is current; `gl` is restricted to `caps`.
/// Error(check) when the plan breaks a rule or GL reports an error; other errors as plan_frame() and
/// Renderer::prepare().
[[nodiscard]] DrawResult draw_scene(gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene, const View& view,
                                    const Wishes& wishes, const DrawRequest& request);

}  // namespace halfframe::perf
