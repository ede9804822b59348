// Writes light, reads display values.
#include "perf/accuracy/storage_accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/effects/transparent/transparent_reference.h"
#include "engine/error.h"
#include "engine/gl/program.h"
#include "perf/accuracy/lane_canvas.h"
#include "perf/accuracy/samples.h"
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
    "    vec4 texel = texelFetch(light, ivec2(gl_FragCoord.xy), 0);\n"
    "    vec3 color = storable(texel.rgb, 65504.0);\n"
    "#ifdef SCENE_COLOR_DISPLAY\n"
    "    color = tone_map(color);\n"
    "#endif\n"
    "#ifdef SCENE_COLOR_PACKED\n"
    "    color = packed_scene_color(min(color, vec3(SCENE_COLOR_RANGE)));\n"
    "#endif\n"
    "    fragment_color = vec4(color, saturate(texel.a));\n"
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

/// The lanes of a source: what lies behind first.
std::vector<LightLayer> layers_of(StoredSource source) {
    if (source != StoredSource::panes) {
        const std::vector<double> lights = lights_of(source);
        return {{{lights, lights, lights}, std::vector<double>(lights.size(), 1.0)}};
    }
    const shader_ir::Columns u = unit_cube(7);
    std::vector<LightLayer> layers;
    for (std::size_t i = 0; i < 4; ++i) {
        std::vector<double> lights;
        for (const double display : u[i])
            lights.push_back(static_cast<float>(std::min(reference::inverse_tone_curve(display), kBrightest)));
        layers.push_back({{lights, lights, lights}, std::vector<double>(lights.size(), 1.0)});
        if (i == 0) continue;
        for (std::size_t lane = 0; lane < lights.size(); ++lane)
            layers[i].alpha[lane] = static_cast<float>(u[3 + i][lane]);
    }
    return layers;
}

/// Draws the layers, the first without blending.
class LayerBench {
public:
    LayerBench(gl::EntryPoints& gl, const gl::Caps& caps, std::size_t lanes)
        : canvas(gl, caps, lanes), gl_(gl), files_(gl::shader_files().begin(), gl::shader_files().end()) {
        files_.push_back({"<store>", kStore});
        programs_.emplace(gl, caps, std::filesystem::path{}, files_);
    }

    void run(const char* fragment, const char* input, PixelFormat format, const gl::Texture& from) {
        gl::Program& program = programs_->get(description(fragment, format));
        gl_.UseProgram(program.name());
        gl_.Uniform1i(program.uniform(input), 0);
        gl_.BindTexture(GL_TEXTURE_2D, from.name());
    }

    [[nodiscard]] gl::Texture held(PixelFormat format, std::span<const LightLayer> layers) {
        gl::Texture target = canvas.target(format);
        for (std::size_t i = 0; i < layers.size(); ++i) {
            shader_ir::Columns texels = layers[i].light;
            texels.push_back(layers[i].alpha);
            const gl::Texture source = canvas.texture(texels);
            run("<store>", "light", format, source);
            if (i == 0) canvas.draw_to(target);
            else canvas.blend_to(target);
        }
        return target;
    }

    LaneCanvas canvas;

private:
    gl::EntryPoints& gl_;
    std::vector<gl::ShaderFile> files_;
    std::optional<gl::ProgramCache> programs_;
};

/// Display values 0..1 of every lane, RGBA, behind a target of `format`.
std::vector<float> displayed(gl::EntryPoints& gl, const gl::Caps& caps, PixelFormat format,
                             std::span<const LightLayer> layers) {
    LayerBench bench(gl, caps, layers[0].alpha.size());
    const gl::Texture held = bench.held(format, layers);
    if (format == PixelFormat::rgba8) return bench.canvas.read_bytes();
    const gl::Texture display = bench.canvas.target(PixelFormat::rgba32f);
    bench.run("tone_map/tone_map.frag", "scene_color", format, held);
    bench.canvas.draw_to(display);
    return bench.canvas.read();
}

/// What a lane shows where nothing is lost but by blending what the format holds.
double truth_of(PixelFormat format, std::span<const LightLayer> layers, std::size_t lane) {
    std::vector<reference::BlendedLayer> before;
    for (std::size_t i = 1; i < layers.size(); ++i)
        before.push_back({.light = glm::dvec3(layers[i].light[0][lane]),
                          .alpha = layers[i].alpha[lane],
                          .distance_m = static_cast<double>(layers.size() - i)});
    const reference::Held held = format == PixelFormat::rgb10_a2 ? reference::Held::root
                                 : format == PixelFormat::rgba8  ? reference::Held::display
                                                                 : reference::Held::light;
    return reference::shown_through(before, glm::dvec3(layers[0].light[0][lane]), held).x;
}

void compare(StorageAccuracy& found, std::span<const LightLayer> layers, const std::vector<float>& display) {
    std::vector<double> errors;
    double sum = 0.0;
    for (std::size_t lane = 0; lane < found.lanes; ++lane) {
        const double truth = 255.0 * truth_of(found.format, layers, lane);
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
            found.worst_light = reference::inverse_tone_curve(truth / 255.0);
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
        case StoredSource::panes: return "three panes";
    }
    throw Mistake("a source of stored values without a name");
}

/// Four lights are stored one over the other: at most four times what one loses, less what the last panes hide.
Bound blended_bound(PixelFormat format) {
    switch (format) {
        case PixelFormat::rgba32f: return {2e-3, "nothing is lost: fp32 roundings of the blend and the curve"};
        case PixelFormat::rgba16f: return {0.2, "four stores of light's 0.067 each, less what later panes hide"};
        case PixelFormat::r11g11b10f: return {6.0, "four stores of light's 2.1 each, less what later panes hide"};
        case PixelFormat::rgb10_a2: return {3.0, "four stores of light's 1.0 each, less what later panes hide"};
        case PixelFormat::rgba8: return {2.0, "four stores of light's 0.502 each"};
        default: break;
    }
    throw Mistake("a format that scene_color never has");
}

// The curve's slope against the logarithm of light is largest at 0.22: 65.5 codes per factor of e.
Bound storage_bound(PixelFormat format, StoredSource source) {
    const bool codes = source == StoredSource::display_codes;
    if (source == StoredSource::panes) return blended_bound(format);
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

std::vector<float> layers_held(gl::EntryPoints& gl, const gl::Caps& caps, PixelFormat format,
                               std::span<const LightLayer> layers) {
    LayerBench bench(gl, caps, layers[0].alpha.size());
    const gl::Texture held = bench.held(format, layers);
    return bench.canvas.read();
}

std::vector<StorageAccuracy> measure_storage(gl::EntryPoints& gl, const gl::Caps& caps,
                                             std::span<const StoredSource> sources) {
    std::vector<StorageAccuracy> list;
    for (const PixelFormat format : {PixelFormat::rgba32f, PixelFormat::rgba16f, PixelFormat::r11g11b10f,
                                     PixelFormat::rgb10_a2, PixelFormat::rgba8}) {
        for (const StoredSource source : sources) {
            StorageAccuracy found{.format = format, .source = source, .bound = storage_bound(format, source)};
            found.missing = LaneCanvas::obstacle(caps);
            if (found.missing.empty() && !caps.renders[static_cast<std::size_t>(format)])
                found.missing = fmt::format("{} does not render {}", caps.renderer, gl::name(format));
            if (found.missing.empty()) {
                const std::vector<LightLayer> layers = layers_of(source);
                found.lanes = layers[0].alpha.size();
                compare(found, layers, displayed(gl, caps, format, layers));
                judge(found);
            }
            list.push_back(found);
        }
    }
    return list;
}

}  // namespace halfframe::accuracy
