// A frame drawn once for its counts, and what these say of its passes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/frame/frame_plan.h"
#include "engine/frame/scene.h"
#include "engine/gl/program.h"
#include "perf/cost/draw_recorder.h"
#include "perf/cost/pass_work.h"
#include "perf/shader_ir/stage_cache.h"

namespace halfframe::cost {

/// What one frame did, without any shader's counts.
struct CountedFrame {
    FramePlan plan;
    std::vector<RecordedDraw> draws;
    std::map<std::uint32_t, gl::ProgramDescription> programs;  ///< by GL name
    std::vector<std::uint32_t> target_textures;                ///< GL names of what the frame draws and then samples
    std::size_t texture_bytes = 0;
    std::vector<std::string> notices;
};

/// A stage and its counts; the module knows files and lines.
struct CountedStage {
    shader_ir::Module module;
    ShaderCounts counts;
};

/// Counts each stage once; with a cache, compiles it once on a machine.
class ShaderLibrary {
public:
    ShaderLibrary() = default;
    explicit ShaderLibrary(shader_ir::StageCache cache) : cache_(std::move(cache)) {}
    const CountedStage& stage(gl::ProgramDescription description, gl::Stage stage, gl::Arithmetic arithmetic);

private:
    shader_ir::StageCache cache_;
    std::map<std::string, std::unique_ptr<CountedStage>> by_text_;
};

/// Plans and draws one frame. `gl` loads its functions through `recorder` and is restricted to `caps`, those of a
/// desktop context under the mask of a device. Shaders run in highp, whatever is wished: mediump there costs time and
/// moves no triangle. Errors as plan_frame() and Renderer::prepare().
[[nodiscard]] CountedFrame count_frame(DrawRecorder& recorder, gl::EntryPoints& gl, const gl::Caps& caps,
                                       const Scene& scene, const View& view, Wishes wishes, ShaderLibrary& library);

/// A description without the code that `effect` adds to it.
[[nodiscard]] gl::ProgramDescription without_insertions(const gl::ProgramDescription& description,
                                                        const FramePlan& plan, const std::string& effect);

/// What every pass of the plan asks of a device, in the order of the plan. `without`: an effect whose insertions are
/// left out of all shaders; empty: none.
[[nodiscard]] std::vector<PassWork> pass_works(const CountedFrame& frame, ShaderLibrary& library,
                                               gl::Arithmetic arithmetic, const std::string& without = {});

}  // namespace halfframe::cost
