// The measured blend of transparent: the blend unit is no shader, so the models run what it does as text, and the
// context blends three layers in a float target.
#include "engine/effects/transparent/transparent_reference.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/samples.h"
#include "perf/accuracy/storage_accuracy.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::accuracy {
namespace {

constexpr std::size_t kPanes = 3;

/// Blend::alpha (engine/frame/draw_state.h), three times, far to near.
constexpr const char* kBlended =
    "vec3 blended(vec3 behind, vec3 far, vec3 middle, vec3 near, vec3 alpha) {\n"
    "    vec3 seen = far * alpha.x + behind * (1.0 - alpha.x);\n"
    "    seen = middle * alpha.y + seen * (1.0 - alpha.y);\n"
    "    return near * alpha.z + seen * (1.0 - alpha.z);\n"
    "}\n";

std::vector<Argument> panes() {
    shader_ir::Columns u = unit_cube(7);
    for (std::size_t s = 0; s < 4; ++s) {
        for (double& light : u[s]) light *= 8.0 * light;  // closer near black, where the display's steps are finest
    }
    // Every channel has other lights: the columns change places.
    return {{"behind", {u[0], u[1], u[2]}},
            {"far", {u[1], u[2], u[3]}},
            {"middle", {u[2], u[3], u[0]}},
            {"near", {u[3], u[0], u[1]}},
            {"alpha", {u[4], u[5], u[6]}}};
}

shader_ir::Columns blended_in_model(const std::vector<Argument>& arguments, shader_ir::Model model) {
    const shader_ir::Module module = shader_ir::compile(shader_ir::FunctionFiles{.more_text = kBlended});
    std::vector<shader_ir::Columns> inputs;
    for (const Argument& argument : arguments) inputs.push_back(argument.values);
    return shader_ir::evaluate(module, "blended", inputs, model).returned;
}

/// mediump is a blend in RGBA16F, highp one in RGBA32F.
shader_ir::Columns blended_on_context(const std::vector<Argument>& arguments, gl::EntryPoints& gl, const gl::Caps& caps,
                                      Arithmetic arithmetic) {
    const shader_ir::Columns& alpha = arguments[kPanes + 1].values;
    std::vector<LightLayer> layers;
    for (std::size_t i = 0; i <= kPanes; ++i) {
        const std::vector<double> opaque(alpha[0].size(), 1.0);
        layers.push_back({arguments[i].values, i == 0 ? opaque : alpha[i - 1]});
    }
    const gl::PixelFormat format = arithmetic == Arithmetic::full ? gl::PixelFormat::rgba32f : gl::PixelFormat::rgba16f;
    const std::vector<float> pixels = layers_held(gl, caps, format, layers);
    shader_ir::Columns results(3);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (i % 4 < 3) results[i % 4].push_back(pixels[i]);
    }
    return results;
}

}  // namespace

std::vector<FunctionEntry> transparent_functions() {
    FunctionEntry made;
    made.effect = "transparent";
    made.function = "blended";
    made.domain = "three panes before a light, light 0..8, alpha 0..1";
    made.arguments = panes;
    made.in_model = blended_in_model;
    made.on_context = blended_on_context;
    made.reference = [](const Lane& in, std::size_t s) {
        std::vector<reference::BlendedLayer> layers;
        for (std::size_t i = 1; i <= kPanes; ++i)
            layers.push_back({.light = glm::dvec3(in(i, s)),
                              .alpha = in(kPanes + 1, i - 1),
                              .distance_m = static_cast<double>(kPanes - i)});
        return reference::seen_through(layers, glm::dvec3(in(0, s))).x;
    };
    made.unit = Unit::light_codes;
    made.method = {1e-9, "the same sum, far to near instead of near to far"};
    made.in_float = {1e-3, "a dozen roundings of 6e-8"};
    made.half = {1.5, "1 - alpha is off by 2^-12 where alpha is near 1: that much of a light of 8 shows through black"};
    made.flushed = {1.5, "as half: what is below 6e-5 is 0.07 codes"};
    made.here_mediump =
        Bound{0.2, "RGBA16F cuts off on llvmpipe: 0.064 codes a store, four of them, less what later panes hide"};
    return {made};
}

}  // namespace halfframe::accuracy
