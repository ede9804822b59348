// Draws a frame under the recorder.
#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/renderer.h"
#include "perf/cost/counted_frame.h"

namespace halfframe::cost {

CountedFrame count_frame(DrawRecorder& recorder, gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene,
                         const View& view, Wishes wishes, ShaderLibrary& library) {
    if (!caps.samples_passed || !caps.desktop)
        throw Error(Fault::context, fmt::format("fragments are counted on a desktop context, which {} is not; Mesa's "
                                                "software driver has one: see halfframe info",
                                                caps.version));
    wishes.arithmetic = caps.fragment_highp ? gl::Arithmetic::full : gl::Arithmetic::half;
    CountedFrame frame;
    frame.plan = plan_frame(scene, view, wishes, caps, all_effects());
    if (const auto sentence = broken_rule(frame.plan, caps))
        throw Error(Fault::check, fmt::format("the plan of {} breaks a rule: {}", scene.name, *sentence));
    Renderer renderer(gl, caps);
    renderer.prepare(scene, frame.plan);
    for (const gl::Program* program : renderer.programs().programs())
        frame.programs.emplace(program->name(), program->description());
    recorder.start(
        [&gl] { return std::string(gl.current_pass()); },
        [&](std::uint32_t program) {
            return library.stage(frame.programs.at(program), gl::Stage::fragment, gl::Arithmetic::half).counts.discards;
        });
    renderer.draw(view);
    frame.draws = recorder.finish();
    if (const std::string error = renderer.first_gl_error(); !error.empty())
        throw Error(Fault::check, fmt::format("GL reports {} after counting {}", error, scene.name));
    for (std::size_t i = 0; i < frame.plan.targets.size(); ++i)
        frame.target_textures.push_back(renderer.target_texture(static_cast<int>(i)));
    frame.texture_bytes = renderer.texture_bytes();
    frame.notices = frame.plan.notices;
    return frame;
}

}  // namespace halfframe::cost
