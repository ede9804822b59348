// The measured functions of the shadow: the step off a surface, the mean of the taps, and the blob.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/effects/shadow/shadow_reference.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

constexpr const char* kSameFormula = "the same formula: what differs is the rounding of double, and of fp32 constants";

FunctionEntry entry(const char* function, const char* domain) {
    FunctionEntry made;
    made.effect = "shadow";
    made.function = function;
    made.files = {"shadow/shadow.glsl"};
    made.domain = domain;
    made.method = {1e-6, kSameFormula};
    made.in_float = {1e-6, "a few roundings of 6e-8"};
    return made;
}

FunctionEntry lift() {
    FunctionEntry made = entry("shadow_lift", "angle of normal and sun 0..90 degrees, filter radius 0..1 m");
    made.arithmetic = Arithmetic::full;  // the vertex stage is highp in both
    made.arguments = [] {
        const shader_ir::Columns u = unit_cube(3);
        std::vector<Argument> arguments{
            {"n", shader_ir::Columns(3)}, {"toward_sun", shader_ir::Columns(3)}, {"reach_m", {u[2]}}};
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            const double angle = 0.5 * std::numbers::pi * u[0][i];
            const double turn = 2.0 * std::numbers::pi * u[1][i];
            const double n[] = {std::sin(angle) * std::cos(turn), std::cos(angle), std::sin(angle) * std::sin(turn)};
            const double sun[] = {0.0, 1.0, 0.0};
            for (std::size_t s = 0; s < 3; ++s) {
                arguments[0].values[s].push_back(n[s]);
                arguments[1].values[s].push_back(sun[s]);
            }
        }
        return arguments;
    };
    made.reference = [](const Lane& in, std::size_t s) {
        const double cosine = in(0, 0) * in(1, 0) + in(0, 1) * in(1, 1) + in(0, 2) * in(1, 2);
        return in(0, s) * reference::plane_lift(std::acos(std::clamp(cosine, -1.0, 1.0)), in(2));
    };
    made.in_float = {1e-6, "the cross product is of fp32 directions: 6e-8 of each near 0"};
    made.half = {1e-6, "full arithmetic: nothing is mediump, as float"};
    made.flushed = made.half;
    return made;
}

FunctionEntry share() {
    FunctionEntry made = entry("lit_share", "four comparisons 0..1");
    made.arguments = [] { return std::vector<Argument>{{"lit", unit_cube(4)}}; };
    made.reference = [](const Lane& in, std::size_t) { return (in(0, 0) + in(0, 1) + in(0, 2) + in(0, 3)) / 4.0; };
    made.half = {1e-3, "four inputs, three sums and a result, each rounded to 2^-12"};
    made.flushed = {1e-3, "as half"};
    return made;
}

FunctionEntry blob() {
    FunctionEntry made = entry("blob_shade", "place -1..1 radii, strength 0..1");
    made.tier = Tier::low;
    made.arguments = [] {
        shader_ir::Columns u = unit_cube(3);
        for (std::size_t s = 0; s < 2; ++s) {
            for (double& place : u[s]) place = 2.0 * place - 1.0;
        }
        return std::vector<Argument>{{"from_centre", {u[0], u[1]}}, {"strength", {u[2]}}};
    };
    made.reference = [](const Lane& in, std::size_t) {
        return reference::blob_left(std::hypot(in(0, 0), in(0, 1)), in(1));
    };
    made.half = {2e-3, "1 - d^2 is off by 2^-11, its square by twice that, and the result is rounded to 2^-12"};
    made.flushed = {2e-3, "as half: what is below 6e-5 is a 60th of a display code"};
    return made;
}

}  // namespace

std::vector<FunctionEntry> shadow_functions() { return {lift(), share(), blob()}; }

}  // namespace halfframe::accuracy
