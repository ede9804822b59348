// The listings, measured and drawn in half.
#include "perf/stability/exhibit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/error.h"
#include "perf/cost/function_cost.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::stability {
namespace {

Declaration declared(const char* file, const char* name, std::span<const gl::ShaderFile> files) {
    for (const gl::ShaderFile& one : files) {
        if (one.path != std::string_view(file)) continue;
        const std::vector<Declaration> functions = functions_of(one.path, one.text);
        for (const Declaration& function : functions) {
            const bool usual = std::ranges::find(function.variants, "TIER_CONSOLE") != function.variants.end();
            if (function.name == name && usual) return function;
        }
    }
    throw Mistake(std::string("the exhibit names ") + name + " in " + file + ", which is not there");
}

/// A function (vec2 at) -> vec3 over the unit square. What is not finite is black, as an 8-bit target has it.
Picture drawn(const ExhibitEntry& entry, const char* function, std::span<const gl::ShaderFile> files) {
    constexpr int kWidth = 192, kHeight = 108;
    const shader_ir::Module module = shader_ir::compile(
        shader_ir::FunctionFiles{.paths = {"common/maths.glsl", entry.file}, .defines = {{"TIER_CONSOLE", "1"}}},
        files);
    std::vector<shader_ir::Columns> inputs(1, shader_ir::Columns(2));
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            inputs[0][0].push_back((x + 0.5) / kWidth);
            inputs[0][1].push_back(1.0 - (y + 0.5) / kHeight);
        }
    }
    const shader_ir::Columns color = shader_ir::evaluate(module, function, inputs, entry.pictured).returned;
    Picture picture{.width = kWidth, .height = kHeight, .rgba = {}};
    for (std::size_t pixel = 0; pixel < color[0].size(); ++pixel) {
        for (const std::vector<double>& channel : color) {
            const double value = std::isnan(channel[pixel]) ? 0.0 : std::clamp(channel[pixel], 0.0, 1.0);
            picture.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0 * value)));
        }
        picture.rgba.push_back(255);
    }
    return picture;
}

Picture difference(const Picture& a, const Picture& b) {
    Picture picture{.width = a.width, .height = a.height, .rgba = a.rgba};
    for (std::size_t at = 0; at < picture.rgba.size(); ++at) {
        if (at % 4 != 3)
            picture.rgba[at] = static_cast<std::uint8_t>(std::min(4 * std::abs(a.rgba[at] - b.rgba[at]), 255));
    }
    return picture;
}

double modelled_ms(const Subject& subject, const cost::Profile& profile, std::span<const gl::ShaderFile> files) {
    constexpr double kPixels = 1280.0 * 720.0;
    cost::FunctionCall call{.function = subject.function().name,
                            .returned = subject.function().returned,
                            .paths = subject.paths(),
                            .defines = subject.defines()};
    for (const DeclaredParameter& parameter : subject.function().parameters)
        call.parameters.push_back({.components = parameter.components, .full = parameter.full});
    return cost::modelled_ms(call, profile, kPixels, files);
}

std::vector<FixCost> costs_of(const Subject& printed, const Subject& mended, std::span<const gl::ShaderFile> files) {
    std::vector<FixCost> costs;
    for (const cost::Profile& profile : cost::built_in_profiles())
        costs.push_back({profile.name, modelled_ms(printed, profile, files), modelled_ms(mended, profile, files)});
    return costs;
}

}  // namespace

std::vector<ExhibitEntry> exhibit_list() {
    constexpr const char* kSurface = "surface/surface.glsl";
    return {
        {"dot and pow lobe", "exhibit/lobe.glsl", "lobe_as_printed", kSurface, "blinn_lobe",
         "n and h that almost meet: the cosine has three values inside the highlight",
         "surface: the lobe comes from the chord n - h"},
        {"length over 255", "exhibit/distance.glsl", "distance_as_printed", kSurface, "distance_falloff",
         "any vector longer than 255: its square is inf", "surface: distances are highp until they are a falloff"},
        {"R > 0 ? max : min box", "exhibit/box.glsl", "box_as_printed", "exhibit/box.glsl", "box_guarded",
         "a component of R that is exactly +0: -inf wins the min, in float too",
         "not yet: no effect projects onto a box; the guarded form stands here for it"},
        {"time in half", "exhibit/time.glsl", "scrolled_as_printed", "exhibit/time.glsl", "scrolled",
         "a clock past 2048 s has steps of 2 s", "not yet: no effect has a clock; the phase is taken in highp"},
        {"1e-6 epsilon", "exhibit/epsilon.glsl", "direction_as_printed", "exhibit/epsilon.glsl", "direction_guarded",
         "short vectors: their squares are 0 below 0.0078, and 1e-6 is 0 where subnormals are flushed",
         "surface: the half vector is guarded with 6.2e-5, in highp"},
        {"RGBM of black", "exhibit/rgbm.glsl", "rgbm_as_printed", "exhibit/rgbm.glsl", "rgbm_guarded",
         "black where subnormals are flushed: 0 / 0", "environment: black has an alpha of 1/255", shader_ir::Model::half_flushed},
        {"1000x - 500 step", "exhibit/metalness.glsl", "metalness_as_printed", "exhibit/metalness.glsl",
         "metalness_ramp", "brightness near 0.5: the ramp has two steps", "not yet: metalness is an input here"},
        {"unlimited tone curve", "exhibit/tone.glsl", "tone_as_printed", "tone_map/tone_map.glsl", "tone_map",
         "light over 63750: its product with 1.0275 is inf", "tone_map: light is cut at 8 first"},
    };
}

std::vector<gl::ShaderFile> files_with_exhibit() {
    std::vector<gl::ShaderFile> files(gl::shader_files().begin(), gl::shader_files().end());
    files.insert(files.end(), exhibit_files().begin(), exhibit_files().end());
    return files;
}

ExhibitResult measure(const ExhibitEntry& entry, const Effort& effort, const Drawing* drawing) {
    const std::vector<gl::ShaderFile> files = files_with_exhibit();
    const Subject printed(declared(entry.file, entry.printed, files), "TIER_CONSOLE", files);
    const Subject mended(declared(entry.mended_file, entry.mended, files), "TIER_CONSOLE", files);
    ExhibitResult result{.entry = entry,
                         .printed = search(printed, effort, drawing),
                         .mended = search(mended, effort, drawing),
                         .costs = costs_of(printed, mended, files),
                         .picture_printed = drawn(entry, "picture_printed", files),
                         .picture_mended = drawn(entry, "picture_mended", files),
                         .picture_difference = {}};
    result.picture_difference = difference(result.picture_printed, result.picture_mended);
    const std::string place = printed.function().place();
    result.found = std::ranges::any_of(result.printed.violations,
                                       [&](const std::string& one) { return one.starts_with(place); }) &&
                   result.mended.violations.empty();
    return result;
}

}  // namespace halfframe::stability
