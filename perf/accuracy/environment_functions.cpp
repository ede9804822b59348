// The measured functions of the environment: harmonics, unpacking, and the low tier's mix.
#include <cmath>

#include "engine/effects/environment/environment_reference.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

using shader_ir::Columns;

constexpr const char* kSameFormula = "the same formula: what differs is the rounding of double, and of fp32 constants";
constexpr const char* kFloatRounding = "a dozen roundings of 6e-8";

FunctionEntry entry(const char* function, const char* domain) {
    FunctionEntry made;
    made.effect = "environment";
    made.function = function;
    made.files = {"environment/environment.glsl"};
    made.domain = domain;
    made.unit = Unit::light_codes;
    made.method = {1e-3, kSameFormula};
    made.in_float = {1e-3, kFloatRounding};
    return made;
}

/// A unit normal and nine terms as a bright sky over a dark street has them: the first up to 2, the others smaller than
/// it.
std::vector<Argument> harmonics() {
    const Columns u = unit_cube(8);
    std::vector<Argument> arguments{{"n", Columns(3)}};
    for (const char* name : {"c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7", "c8"})
        arguments.push_back({name, Columns(3)});
    for (std::size_t i = 0; i < u[0].size(); ++i) {
        const double z = 2.0 * u[0][i] - 1.0;
        const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
        const double turn = 6.283185307179586 * u[1][i];
        arguments[0].values[0].push_back(radius * std::cos(turn));
        arguments[0].values[1].push_back(radius * std::sin(turn));
        arguments[0].values[2].push_back(z);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double mean = 2.0 * u[2 + channel][i];
            arguments[1].values[channel].push_back(mean);
            for (std::size_t term = 1; term < 9; ++term) {
                // Every term another mix of three numbers: eight dimensions more would fill no better.
                const double share =
                    2.0 * std::fmod(u[5][i] * double(term) + u[6][i] + u[7][i] * double(channel), 1.0) - 1.0;
                arguments[1 + term].values[channel].push_back((term < 4 ? 0.5 : 0.15) * mean * share);
            }
        }
    }
    return arguments;
}

}  // namespace

std::vector<FunctionEntry> environment_functions() {
    FunctionEntry diffuse = entry("irradiance", "unit normals, nine terms of a mean 0..2");
    diffuse.arguments = harmonics;
    diffuse.reference = [](const Lane& in, std::size_t s) {
        std::array<double, 9> terms{};
        for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = in(1 + i, s);
        return reference::irradiance({in(0, 0), in(0, 1), in(0, 2)}, terms);
    };
    diffuse.half = {1.2,
                    "some twenty roundings of sums up to 3; where they nearly cancel the curve is steep, 1190 codes a "
                    "unit of light"};
    diffuse.flushed = {1.2, "as half"};

    FunctionEntry level = entry("reflection_level", "smoothness 0..1, four levels");
    level.arguments = [] {
        const Columns u = unit_cube(1);
        return std::vector<Argument>{{"smoothness", u}, {"roughest", {std::vector<double>(u[0].size(), 4.0)}}};
    };
    level.reference = [](const Lane& in, std::size_t) { return reference::reflection_level(in(0), in(1)); };
    level.unit = Unit::absolute;
    level.method = {1e-6, kSameFormula};
    level.in_float = {4e-6, "a rounding of levels up to 4; where the fraction jumps both sides give the same level"};
    level.half = {0.02,
                  "1 - smoothness is off by 2^-12, times 4 levels, times the bend's slope of 1.4; two roundings of a "
                  "level up to 4 follow, 2^-9 each"};
    level.flushed = {0.02, "as half"};

    FunctionEntry unpacked = entry("unpacked_rgbm", "texels 0..1, root of the range 0.125..8");
    unpacked.arguments = [] {
        const Columns u = unit_cube(5);
        Columns alpha{u[3]};
        Columns range{u[4]};
        for (double& value : alpha[0]) value = (1.0 + std::floor(value * 254.0)) / 255.0;
        for (double& value : range[0]) value = std::exp2(6.0 * value - 3.0);
        return std::vector<Argument>{{"stored", {u[0], u[1], u[2], alpha[0]}}, {"root_range", range}};
    };
    unpacked.reference = [](const Lane& in, std::size_t s) { return reference::rgbm_light(in(0, s), in(0, 3), in(1)); };
    unpacked.half = {0.5,
                     "six roundings of 2^-12, inputs among them, twice over for the square; half a code at the curve's "
                     "steepest relative slope"};
    unpacked.flushed = {0.5, "as half: light below 6e-5 is 0, 0.07 codes"};

    FunctionEntry mixed = entry("mixed_reflection", "three colours 0..2, smoothness 0..1");
    mixed.arguments = [] {
        const Columns u = unit_cube(4);
        const auto scaled = [&](std::size_t a, std::size_t b, std::size_t c) {
            Columns columns{u[a], u[b], u[c]};
            for (auto& column : columns) {
                for (double& value : column) value *= 2.0;
            }
            return columns;
        };
        return std::vector<Argument>{{"diffuse", scaled(0, 1, 2)},
                                     {"rough", scaled(1, 2, 0)},
                                     {"sharp", scaled(2, 0, 1)},
                                     {"smoothness", {u[3]}}};
    };
    mixed.reference = [](const Lane& in, std::size_t s) {
        return reference::low_reflection(in(0, s), in(1, s), in(2, s), in(3));
    };
    mixed.tier = Tier::low;
    mixed.half = {0.2,
                  "the weight is a rounded difference, 2^-11, of two colours up to 2 apart: 1e-3 of light in the dark"};
    mixed.flushed = {0.2, "as half"};

    FunctionEntry bands = entry("bands_about_axis", "cosines -1..1, two colours -1..1");
    bands.arguments = [] {
        Columns u = unit_cube(7);
        for (auto& column : u) {
            for (double& value : column) value = 2.0 * value - 1.0;
        }
        return std::vector<Argument>{{"along", {u[0]}}, {"third", {u[1], u[2], u[3]}}, {"fourth", {u[4], u[5], u[6]}}};
    };
    bands.reference = [](const Lane& in, std::size_t s) {
        return reference::axis_bands(in(0), in(1, s), in(2, s));
    };
    bands.unit = Unit::absolute;
    bands.method = {1e-6, kSameFormula};
    bands.in_float = {2e-6, kFloatRounding};
    bands.half = {1e-3, "the polynomials are FULL; two products and their sum of up to 2 are rounded"};
    bands.flushed = {1e-3, "as half"};
    return {diffuse, level, unpacked, mixed, bands};
}

}  // namespace halfframe::accuracy
