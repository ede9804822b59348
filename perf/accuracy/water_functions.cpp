// The measured functions of wet_surface and of puddles.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/effects/puddles/puddles_reference.h"
#include "engine/effects/wet_surface/wet_surface_reference.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

using shader_ir::Columns;

FunctionEntry entry(const char* effect, const char* function, const char* domain) {
    FunctionEntry made;
    made.effect = effect;
    made.function = function;
    made.files = {"common/maths.glsl", std::string(effect) + "/" + effect + ".glsl"};
    made.domain = domain;
    made.method = {1e-6, "the same formula, the lerps taken apart: what differs is the rounding of double"};
    made.in_float = {2e-6, "a few roundings of 6e-8, times slopes up to 7.5"};
    made.half = {2e-3, "some five roundings of 2^-12"};
    made.flushed = {2e-3, "as half"};
    return made;
}

std::vector<FunctionEntry> smoothing_functions() {
    const auto material = [] {
        Columns u = unit_cube(3);
        return std::vector<Argument>{{"smoothness", {u[0]}}, {"pores", {u[1]}}, {"wetness", {u[2]}}};
    };
    FunctionEntry smoothness = entry("wet_surface", "wet_smoothness", "smoothness, porosity and wetness 0..1");
    smoothness.arguments = material;
    smoothness.reference = [](const Lane& in, std::size_t) {
        // 1 lerped towards the dry value by what the talk calls the factor of half the wetness.
        const double factor = 1.0 - 0.8 * in(1);
        const double kept = 1.0 + (factor - 1.0) * 0.5 * in(2);
        return 1.0 - kept * (1.0 - in(0));
    };
    FunctionEntry power = entry("wet_surface", "smoother_power", "smoothness 0..1, gain up to a mirror");
    power.arguments = [] {
        Columns u = unit_cube(2);
        std::vector<double> powers, gains;
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            powers.push_back(std::exp2(10.0 * u[0][i] + 1.0));
            gains.push_back((1.0 - u[0][i]) * u[1][i]);
        }
        return std::vector<Argument>{{"power", {powers}}, {"gain", {gains}}};
    };
    power.reference = [](const Lane& in, std::size_t) {
        const double smoothness_then = (std::log2(in(0)) - 1.0) / 10.0 + in(1);
        return std::min(std::pow(2.0, 10.0 * smoothness_then + 1.0), 2048.0);
    };
    power.unit = Unit::of_peak;
    power.peak = [](const Lane& in, std::size_t) { return in(0) * std::exp2(10.0 * in(1)); };
    power.in_float = {1e-5, "10 gain is rounded to 6e-8 of up to 10, and is an exponent"};
    power.half = {8e-3, "gain is rounded to 2^-12 of up to 1 and 10 gain to 2^-9 of 8: an exponent off by 0.006"};
    power.flushed = power.half;
    return {smoothness, power};
}

}  // namespace

std::vector<FunctionEntry> wet_surface_functions() {
    FunctionEntry pores = entry("wet_surface", "porosity", "specular and smoothness 0..1");
    pores.arguments = [] {
        Columns u = unit_cube(4);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t lane = 0; lane < u[i].size(); lane += 2) u[i][lane] = 0.35 + 0.3 * u[i][lane];
        }
        return std::vector<Argument>{{"specular", {u[0], u[1], u[2]}}, {"smoothness", {u[3]}}};
    };
    pores.reference = [](const Lane& in, std::size_t) {
        return reference::porosity({in(0, 0), in(0, 1), in(0, 2)}, in(1));
    };
    pores.method = {1e-3, "0.3333 stands for a third, which is 7.5 times 5e-5 on the ramp of metals"};
    pores.half = {8e-3, "the mean of three is off by 2^-11 and smoothstep's slope is 7.5"};
    pores.flushed = pores.half;

    FunctionEntry albedo = entry("wet_surface", "wet_albedo", "albedo, porosity and wetness 0..1");
    albedo.arguments = [] {
        const Columns u = unit_cube(5);
        return std::vector<Argument>{{"albedo", {u[0], u[1], u[2]}}, {"pores", {u[3]}}, {"wetness", {u[4]}}};
    };
    albedo.reference = [](const Lane& in, std::size_t s) {
        // A material of this porosity: a dielectric of that smoothness.
        const reference::DryMaterial dry{{in(0, 0), in(0, 1), in(0, 2)}, {0.04, 0.04, 0.04}, 0.5 - 0.4 * in(1)};
        return reference::wet_material(dry, in(2)).albedo[s];
    };
    std::vector<FunctionEntry> list{pores, albedo};
    for (FunctionEntry& more : smoothing_functions()) list.push_back(std::move(more));
    return list;
}

std::vector<FunctionEntry> puddles_functions() {
    FunctionEntry share = entry("puddles", "puddle_share", "hollow, height and level 0..1, slope 0..90 degrees");
    share.arguments = [] {
        Columns u = unit_cube(4);
        for (std::size_t lane = 0; lane < u[3].size(); ++lane) u[3][lane] = lane % 2 == 0 ? u[3][lane] : 0.9 + 0.1 * u[3][lane];
        return std::vector<Argument>{{"hollow", {u[0]}}, {"height", {u[1]}}, {"level", {u[2]}}, {"up", {u[3]}}};
    };
    share.reference = [](const Lane& in, std::size_t) {
        return reference::water_accumulation(1.0 - in(0), in(1), in(2), std::acos(std::clamp(in(3), -1.0, 1.0)));
    };
    share.method = {5e-3, "0.906 and 12.7 stand for the cosines of 25 and 10 degrees"};
    share.in_float = {2e-5, "up is rounded to 6e-8 and multiplied by 12.7; 0.906 is rounded once"};
    share.half = {1.3e-2, "0.906 is rounded by up to 2^-12 and the product by 2^-12: 12.7 times 5e-4, and five roundings"};
    share.flushed = share.half;

    FunctionEntry specular = entry("puddles", "water_specular", "specular and share 0..1");
    specular.arguments = [] {
        const Columns u = unit_cube(4);
        return std::vector<Argument>{{"specular", {u[0], u[1], u[2]}}, {"share", {u[3]}}};
    };
    specular.reference = [](const Lane& in, std::size_t s) { return reference::specular_under_water(in(0, s), in(1)); };

    FunctionEntry smoothness = entry("puddles", "water_smoothness", "smoothness and share 0..1");
    smoothness.arguments = [] {
        const Columns u = unit_cube(2);
        return std::vector<Argument>{{"smoothness", {u[0]}}, {"share", {u[1]}}};
    };
    smoothness.reference = [](const Lane& in, std::size_t) { return reference::smoothness_under_water(in(0), in(1)); };

    FunctionEntry normal = entry("puddles", "over_water", "ground up to 60 degrees from the water's normal, share 0..1");
    normal.arguments = [] {
        const Columns u = unit_cube(3);
        std::vector<Argument> arguments{{"ground", Columns(3)}, {"water", Columns(3)}, {"share", {u[2]}}};
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            const double angle = std::numbers::pi / 3.0 * u[0][i], turn = 2.0 * std::numbers::pi * u[1][i];
            const double ground[] = {std::sin(angle) * std::cos(turn), std::cos(angle), std::sin(angle) * std::sin(turn)};
            const double water[] = {0.0, 1.0, 0.0};
            for (std::size_t s = 0; s < 3; ++s) {
                arguments[0].values[s].push_back(ground[s]);
                arguments[1].values[s].push_back(water[s]);
            }
        }
        return arguments;
    };
    normal.reference = [](const Lane& in, std::size_t s) {
        return reference::normal_under_water({in(0, 0), in(0, 1), in(0, 2)}, {in(1, 0), in(1, 1), in(1, 2)}, in(2))[s];
    };
    return {share, specular, smoothness, normal};
}

}  // namespace halfframe::accuracy
