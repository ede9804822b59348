// Writes light, reads display values.
#include "perf/accuracy/storage_accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/error.h"
#include "engine/gl/program.h"
#include "perf/accuracy/lane_canvas.h"
#include "shaders_es/tone_map/tone_map_limits.h"

namespace halfframe::accuracy {
namespace {

using gl::PixelFormat;

constexpr double kBrightest = TONE_MAP_RANGE;
constexpr double kFaintest = 1e-5;  // a hundredth of a code

/// Stores as surface.frag does behind its last insertion point.
constexpr const char* kStore =
    "#include \"common/maths.glsl\"\n"
    "#include \"common/packing.glsl\"\n"
    "#include \"tone_map/tone_map.glsl\"\n"
    "uniform highp sampler2D light;\n"
    "void main() {\n"
    "    vec3 color = storable(texelFetch(light, ivec2(gl_FragCoord.xy), 0).rgb, 65504.0);\n"
    "#ifdef SCENE_COLOR_DISPLAY\n"
    "    color = tone_map(color);\n"
    "#endif\n"
    "#ifdef SCENE_COLOR_PACKED\n"
    "    color = packed_scene_color(min(color, vec3(SCENE_COLOR_RANGE)));\n"
    "#endif\n"
    "    fragment_color = vec4(color, 1.0);\n"
    "}\n";

/// Grey light of every lane.
std::vector<double> lights_of(StoredSource source) {
    std::vector<double> lights;
    if (source == StoredSource::display_codes) {
        for (int code = 0; code <= 255; ++code) lights.push_back(reference::inverse_tone_curve(code / 255.0));
        return lights;
    }
    constexpr int kEach = 8192;
    for (int i = 0; i <= kEach; ++i) {
        const double along = static_cast<double>(i) / kEach;
        lights.push_back(reference::inverse_tone_curve(along));
        lights.push_back(kFaintest * std::pow(kBrightest / kFaintest, along));
    }
    for (double& light : lights) light = static_cast<float>(std::min(light, kBrightest));  // what a texel holds
    return lights;
}

gl::ProgramDescription description(const char* fragment, PixelFormat format) {
    gl::ProgramDescription made;
    made.name = "storage";
    made.vertex = "tone_map/tone_map.vert";
    made.fragment = fragment;
    made.arithmetic = gl::Arithmetic::full;
    if (format == PixelFormat::rgb10_a2) made.defines.emplace_back("SCENE_COLOR_PACKED", "1");
    if (format == PixelFormat::rgba8) made.defines.emplace_back("SCENE_COLOR_DISPLAY", "1");
    made.attributes = LaneCanvas::attributes();
    return made;
}

/// Display values 0..1 of every lane, RGBA, behind a target of `format`.
std::vector<float> displayed(gl::EntryPoints& gl, const gl::Caps& caps, PixelFormat format,
                             const std::vector<double>& lights) {
    LaneCanvas canvas(gl, caps, lights.size());
    std::vector<gl::ShaderFile> files(gl::shader_files().begin(), gl::shader_files().end());
    files.push_back({"<store>", kStore});
    gl::ProgramCache programs(gl, caps, {}, files);
    const auto run = [&](const char* fragment, const char* input, const gl::Texture& from, const gl::Texture& to) {
        gl::Program& program = programs.get(description(fragment, format));
        gl.UseProgram(program.name());
        gl.Uniform1i(program.uniform(input), 0);
        gl.BindTexture(GL_TEXTURE_2D, from.name());
        canvas.draw_to(to);
    };
    const gl::Texture source = canvas.texture({lights, lights, lights});
    const gl::Texture stored = canvas.target(format);
    run("<store>", "light", source, stored);
    if (format == PixelFormat::rgba8) return canvas.read_bytes();
    const gl::Texture display = canvas.target(PixelFormat::rgba32f);
    run("tone_map/tone_map.frag", "scene_color", stored, display);
    return canvas.read();
}

void compare(StorageAccuracy& found, const std::vector<double>& lights, const std::vector<float>& display) {
    std::vector<double> errors;
    double sum = 0.0;
    for (std::size_t lane = 0; lane < lights.size(); ++lane) {
        const double truth = 255.0 * reference::tone_curve(lights[lane]);
        for (int channel = 0; channel < 3; ++channel) {
            const double error = 255.0 * display[lane * 4 + static_cast<std::size_t>(channel)] - truth;
            if (!std::isfinite(error)) {
                ++found.not_finite;
                continue;
            }
            sum += error;
            errors.push_back(std::fabs(error));
            if (errors.back() <= found.largest) continue;
            found.largest = errors.back();
            found.worst_light = lights[lane];
            found.worst_channel = channel;
        }
    }
    if (errors.empty()) return;
    found.mean = sum / static_cast<double>(errors.size());
    const auto place = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
    std::nth_element(errors.begin(), place, errors.end());
    found.p99 = *place;
}

void judge(StorageAccuracy& found) {
    const std::string subject = fmt::format("{} of {}", gl::name(found.format), name(found.source));
    if (found.not_finite > 0)
        found.violations.push_back(fmt::format("{}: {} values are not finite", subject, found.not_finite));
    if (found.largest > found.bound.at_most) {
        found.violations.push_back(fmt::format("{}: {:.3g} codes is over the bound of {:.3g} ({})", subject,
                                               found.largest, found.bound.at_most, found.bound.reason));
    }
}

}  // namespace

const char* name(StoredSource source) {
    switch (source) {
        case StoredSource::light: return "light";
        case StoredSource::display_codes: return "display codes";
    }
    throw Mistake("a source of stored values without a name");
}

// The curve's slope against the logarithm of light is largest at 0.22: 65.5 codes per factor of e.
Bound storage_bound(PixelFormat format, StoredSource source) {
    const bool codes = source == StoredSource::display_codes;
    switch (format) {
        case PixelFormat::rgba32f: return {2e-3, "nothing is lost: fp32 roundings of the curve"};
        case PixelFormat::rgba16f:
            return {0.067, "11 bits, cut off: a step of 2^-10 times 65.5 codes (llvmpipe; half of it where it rounds)"};
        case PixelFormat::r11g11b10f:
            return {2.1,
                    "blue has 6 bits, cut off: a step of 2^-5 times 65.5 codes (llvmpipe; half of it where it "
                    "rounds); red and green half of that"};
        case PixelFormat::rgb10_a2:
            return {
                1.0,
                "the square root in 1023 steps: a whole one is 1.0 codes at a light of 0.073 (llvmpipe cuts off after "
                "the product with 1024; half of it where it rounds)"};
        case PixelFormat::rgba8:
            if (codes) return {2e-3, "display values of 8 bits in a target of 8 bits"};
            return {0.502, "half a code: the display's own steps"};
        default: break;
    }
    throw Mistake("a format that scene_color never has");
}

std::vector<StorageAccuracy> measure_storage(gl::EntryPoints& gl, const gl::Caps& caps) {
    std::vector<StorageAccuracy> list;
    for (const PixelFormat format : {PixelFormat::rgba32f, PixelFormat::rgba16f, PixelFormat::r11g11b10f,
                                     PixelFormat::rgb10_a2, PixelFormat::rgba8}) {
        for (const StoredSource source : {StoredSource::light, StoredSource::display_codes}) {
            StorageAccuracy found{.format = format, .source = source, .bound = storage_bound(format, source)};
            found.missing = LaneCanvas::obstacle(caps);
            if (found.missing.empty() && !caps.renders[static_cast<std::size_t>(format)])
                found.missing = fmt::format("{} does not render {}", caps.renderer, gl::name(format));
            if (found.missing.empty()) {
                const std::vector<double> lights = lights_of(source);
                found.lanes = lights.size();
                compare(found, lights, displayed(gl, caps, format, lights));
                judge(found);
            }
            list.push_back(found);
        }
    }
    return list;
}

}  // namespace halfframe::accuracy
