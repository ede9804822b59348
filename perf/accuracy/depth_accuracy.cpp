// The measured stage of depth_prepass, and what depth targets keep.
#include "perf/accuracy/depth_accuracy.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/accuracy/depth_lanes.h"
#include "perf/accuracy/lane_canvas.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::accuracy {
namespace {

using gl::PixelFormat;

/// gl_Position of depth_prepass.vert, and the window depth that it means.
shader_ir::Columns depth_in_model(const std::vector<Argument>& arguments, shader_ir::Model model) {
    const shader_ir::Module module =
        shader_ir::compile(description_of(DepthStage::prepass), gl::Stage::vertex, shader_ir::Cleaning::none);
    shader_ir::Bindings bindings;
    for (const Argument& argument : arguments) bindings.variables[argument.name] = argument.values;
    const shader_ir::Columns at = shader_ir::evaluate(module, "main", {}, model, bindings).outputs.at("gl_Position");
    std::vector<double> depth;
    for (std::size_t lane = 0; lane < at[2].size(); ++lane) depth.push_back(0.5 + 0.5 * at[2][lane] / at[3][lane]);
    return {depth};
}

shader_ir::Columns depth_on_context(const std::vector<Argument>&, gl::EntryPoints& gl, const gl::Caps& caps,
                                    Arithmetic) {
    return {DepthCanvas(gl, caps).rasterised(DepthStage::prepass)};
}

double steps_of(PixelFormat format) { return format == PixelFormat::depth16 ? 65535.0 : 16777215.0; }

void set_bounds(DepthAccuracy& found) {
    if (found.format == PixelFormat::depth16) {
        found.bound = {0.502, "half a step"};
        found.distance_bound = {0.16, "half of 2^-16, times a far plane 20000 times as far as the near one"};
    } else {
        found.bound = {1.01, "a whole step where the depth is cut off (llvmpipe; half of it where it rounds)"};
        found.distance_bound = {3e-3, "a few of 2^-24, in fp32 and in storage, times a far plane 20000 times as far"};
    }
}

void judge(DepthAccuracy& found) {
    const char* format = gl::name(found.format);
    const auto at_most = [&](double value, const char* unit, const Bound& bound) {
        if (value <= bound.at_most) return;
        found.violations.push_back(fmt::format("{}: {:.3g} {} is over the bound of {:.3g} ({})", format, value, unit,
                                               bound.at_most, bound.reason));
    };
    at_most(found.largest, "steps", found.bound);
    at_most(found.of_distance, "of the distance", found.distance_bound);
    if (found.apart > 0) {
        found.violations.push_back(
            fmt::format("{}: in {} of {} places surface.vert writes another depth", format, found.apart, found.lanes));
    }
}

void compare(DepthAccuracy& found, const std::vector<double>& before, const std::vector<double>& stored,
             DistanceAt meant) {
    const std::vector<DepthTruth>& lanes = depth_truths();
    std::vector<double> errors;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        const DepthTruth& lane = lanes[i];
        errors.push_back(steps_of(found.format) * std::fabs(stored[i] - before[i]));
        const double seen_m = meant(stored[i], lane.range);
        const double of_distance = std::fabs(seen_m - lane.along_m) / lane.along_m;
        if (of_distance <= found.of_distance) continue;
        found.of_distance = of_distance;
        found.worst_m = lane.along_m;
        found.worst_near_m = lane.range.near_m;
    }
    found.lanes = errors.size();
    found.largest = *std::max_element(errors.begin(), errors.end());
    const auto place = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
    std::nth_element(errors.begin(), place, errors.end());
    found.p99 = *place;
}

}  // namespace

std::vector<FunctionEntry> depth_prepass_functions() {
    FunctionEntry made;
    made.effect = "depth_prepass";
    made.function = "depth";
    made.files = {"depth_prepass/depth_prepass.vert"};
    made.arithmetic = Arithmetic::full;  // the vertex stage is highp in both
    made.domain = "window depth of places 0.05 m to 10 km away, three lenses and parallel rays";
    made.arguments = depth_arguments;
    made.in_model = depth_in_model;
    made.on_context = depth_on_context;
    made.reference = [](const Lane& in, std::size_t) {
        const DepthTruth& lane = depth_truths()[in.number()];
        return reference::window_depth(lane.along_m, lane.range);
    };
    made.method = {2.5e-5,
                   "the same depth of a matrix rounded to fp32: 6e-8 of the 15 m to the mesh's origin, over 0.05 m"};
    made.in_float = {2.5e-5, "products and sums of 15 m rounded by 6e-8 each, over a nearest distance of 0.05 m"};
    made.half = {2.5e-5, "full arithmetic: nothing is mediump, as float"};
    made.flushed = made.half;
    made.here_highp = Bound{5e-5, "as float, and each corner of a triangle is rounded by itself"};
    return {made};
}

std::vector<DepthAccuracy> measure_depth(gl::EntryPoints& gl, const gl::Caps& caps, DistanceAt meant,
                                         std::span<const gl::ShaderFile> files) {
    std::vector<DepthAccuracy> list;
    for (const PixelFormat format : {PixelFormat::depth24, PixelFormat::depth16}) {
        DepthAccuracy found{.format = format};
        set_bounds(found);
        found.missing = LaneCanvas::obstacle(caps);
        if (found.missing.empty() && !caps.renders[static_cast<std::size_t>(format)])
            found.missing = fmt::format("{} does not render {}", caps.renderer, gl::name(format));
        if (found.missing.empty()) {
            DepthCanvas canvas(gl, caps, files);
            const std::vector<double> stored = canvas.stored(DepthStage::prepass, format);
            const std::vector<double> surface = canvas.stored(DepthStage::surface, format);
            compare(found, canvas.rasterised(DepthStage::prepass), stored, meant);
            for (std::size_t i = 0; i < stored.size(); ++i) found.apart += stored[i] != surface[i] ? 1 : 0;
            judge(found);
        }
        list.push_back(found);
    }
    return list;
}

}  // namespace halfframe::accuracy
