// Wraps the call in a fragment stage and counts that.
#include "perf/cost/function_cost.h"

#include <array>

#include <fmt/format.h>

#include "perf/cost/model.h"
#include "perf/cost/shader_counts.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::cost {
namespace {

std::string type_of(int components) { return components == 1 ? "float" : fmt::format("vec{}", components); }

std::string stage_text(const FunctionCall& call) {
    std::string inputs, arguments;
    for (std::size_t i = 0; i < call.parameters.size(); ++i) {
        const FunctionCall::Parameter& parameter = call.parameters[i];
        inputs += fmt::format("FRAGMENT_IN {} {} input_{};\n", parameter.full ? "FULL" : "HALF",
                              type_of(parameter.components), i);
        arguments += fmt::format("{}input_{}", i == 0 ? "" : ", ", i);
    }
    constexpr std::array kPadding{"", ", 0.0, 0.0, 0.0", ", 0.0, 0.0", ", 0.0", ""};
    std::string text;
    for (const std::string& path : call.paths) text += fmt::format("#include \"{}\"\n", path);
    return text + inputs +
           fmt::format("void main() {{ fragment_color = vec4({}({}){}); }}\n", call.function, arguments,
                       kPadding.at(static_cast<std::size_t>(call.returned)));
}

}  // namespace

double modelled_ms(const FunctionCall& call, const Profile& profile, double pixels,
                   std::span<const gl::ShaderFile> files) {
    constexpr const char* kMainPath = "<call>";
    const std::string text = stage_text(call);
    std::vector<gl::ShaderFile> all(files.begin(), files.end());
    all.push_back({kMainPath, text});
    gl::ProgramDescription description;
    description.name = call.function;
    description.vertex = description.fragment = kMainPath;
    description.arithmetic = gl::Arithmetic::half;
    description.defines = call.defines;
    const ShaderCounts counts =
        count_shader(shader_ir::compile(gl::assemble_stage(description, gl::Stage::fragment, all), gl::Stage::fragment,
                                        shader_ir::Cleaning::optimised));
    DrawWork draw{.fragments_shaded = pixels,
                  .fragments_written = pixels,
                  .vertices = 3,
                  .triangles = 1,
                  .temporaries = counts.temporaries};
    draw.fragment = {FragmentWork{.work = counts.weighted.work}, FragmentWork{.work = counts.shortest.work},
                     FragmentWork{.work = counts.longest.work}};
    double ms = 0.0;
    for (const UnitTime& unit : cost_of({.name = call.function, .draws = {draw}}, profile).units)
        ms += unit.shading ? unit.ms : 0.0;
    return ms;
}

}  // namespace halfframe::cost
