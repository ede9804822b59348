// Draws one scene and gathers all that can be seen of it. The order of the steps is fixed, so that the trace and the
// ledger of two runs are equal: plan, prepare, one frame (traced, counted), read back, calibrate, measure, census.
#include "perf/measure/draw_scene.h"

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "engine/gl/entry_points.h"
#include "shaders_es/common/packing_limits.h"

namespace halfframe::perf {
namespace {

void expect_no_gl_error(Renderer& renderer, const std::string& scene, const char* step) {
    if (const std::string error = renderer.first_gl_error(); !error.empty()) {
        throw Error(Fault::check,
                    fmt::format("GL reports {} after {} {}; run with --trace to see the calls", error, step, scene));
    }
}

FramePlan checked_plan(const Scene& scene, const View& view, const Wishes& wishes, const gl::Caps& caps) {
    FramePlan plan = plan_frame(scene, view, wishes, caps, all_effects());
    if (const auto sentence = broken_rule(plan, caps)) {
        throw Error(Fault::check, fmt::format("the plan of {} breaks a rule: {}", scene.name, *sentence));
    }
    return plan;
}

FloatPicture read_linear(Renderer& renderer, std::vector<std::string>& notices) {
    const FramePlan& plan = renderer.plan();
    const int scene_color = plan.target_index("scene_color");
    if (scene_color < 0 || holds_display_values(plan.storage)) {
        notices.emplace_back("this plan has no linear target, so the .exr holds display values");
        return renderer.read_target(scene_color < 0 ? plan.display : scene_color);
    }
    FloatPicture picture = renderer.read_target(scene_color);
    if (plan.storage == gl::PixelFormat::rgb10_a2) {
        for (std::size_t value = 0; value < picture.rgba.size(); ++value) {
            if (value % 4 != 3) {  // alpha is not light
                picture.rgba[value] *= picture.rgba[value] * static_cast<float>(SCENE_COLOR_RANGE);
            }
        }
    }
    return picture;
}

Measurement measure(Renderer& renderer, const View& view, const DrawRequest& request) {
    request.between("calibrating the clock");
    Measurement measurement;
    measurement.calibration = calibrate_timing(renderer.gl(), renderer.caps());
    const int pass_count = static_cast<int>(renderer.plan().passes.size());
    PassTimer timer(renderer.gl(), measurement.calibration.method, pass_count, request.measured_frames);
    renderer.draw(view);  // the calibration's own programs and targets are out of every cache again
    renderer.gl().Finish();
    for (int frame = 0; frame < request.measured_frames; ++frame) {
        request.between(fmt::format("measuring frame {} of {}", frame + 1, request.measured_frames));
        renderer.draw_timed(view, timer);
    }
    for (int pass = 0; pass < pass_count; ++pass) {
        measurement.passes.push_back(timer.pass(pass));
        measurement.samples.push_back(timer.samples(pass));
    }
    measurement.frame = timer.frame();
    return measurement;
}

std::vector<CensusRow> take_census(gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene, const View& view,
                                   Wishes wishes, const DrawRequest& request) {
    request.between("counting NaN and inf");
    wishes.census = true;
    const FramePlan plan = checked_plan(scene, view, wishes, caps);
    Renderer renderer(gl, caps, {.program_cache_folder = request.program_cache_folder});
    renderer.prepare(scene, plan);
    renderer.draw(view);
    std::vector<CensusRow> rows = renderer.census();
    expect_no_gl_error(renderer, scene.name, "the census of");
    return rows;
}

void append(std::vector<std::string>& notices, const std::vector<std::string>& more) {
    notices.insert(notices.end(), more.begin(), more.end());
}

}  // namespace

DrawResult draw_scene(gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene, const View& view,
                      const Wishes& wished, const DrawRequest& request) {
    Wishes wishes = wished;
    wishes.reads_light = wished.reads_light || request.linear;
    DrawResult result;
    FrameReport& report = result.report;
    request.between("planning");
    report.plan = checked_plan(scene, view, wishes, caps);
    report.caps = caps;
    report.scene = scene.name;
    append(report.notices, scene.notices);
    append(report.notices, report.plan.notices);

    Renderer renderer(gl, caps, {.program_cache_folder = request.trace ? "" : request.program_cache_folder});
    gl.ledger.clear();
    if (request.trace) {
        gl.start_trace();
    }
    request.between("loading textures and shaders");
    renderer.prepare(scene, report.plan);
    report.prepare_calls = call_report(gl.ledger);
    gl.ledger.clear();

    request.between("drawing");
    renderer.draw(view);
    report.frame_calls = call_report(gl.ledger);
    if (request.trace) {
        result.trace_json = gl.trace_json();
        gl.stop_trace();
    }
    report.display = renderer.read_display();
    if (request.linear) {
        result.linear = read_linear(renderer, report.notices);
    }
    expect_no_gl_error(renderer, scene.name, "drawing");
    report.texture_bytes = renderer.texture_bytes();
    report.programs = renderer.programs().statistics();
    report.program_uses = renderer.program_uses();
    append(report.notices, renderer.notices());

    if (request.measured_frames > 0 && !request.trace) {
        report.measurement = measure(renderer, view, request);
        expect_no_gl_error(renderer, scene.name, "measuring");
    }
    if (request.census) {
        report.census = take_census(gl, caps, scene, view, wishes, request);
    }
    return result;
}

}  // namespace halfframe::perf
