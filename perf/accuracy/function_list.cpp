// The list of measured functions, and those of the tone map and the sky.
#include "perf/accuracy/function_list.h"

#include <array>

#include "engine/effects/sky/sky_reference.h"
#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

constexpr const char* kSameFormula = "the same formula: what differs is the rounding of double, and of fp32 constants";
constexpr const char* kFloatRounding = "a dozen roundings of 6e-8";

}  // namespace

const char* name(Unit unit) {
    switch (unit) {
        case Unit::absolute: return "absolute";
        case Unit::of_peak: return "of peak";
        case Unit::display_codes: return "codes";
        case Unit::light_codes: return "codes";
    }
    throw Mistake("a unit without a name");
}

std::vector<FunctionEntry> tone_map_functions() {
    const auto light = [] {
        std::vector<std::vector<double>> u = unit_cube(3);
        // The channels take three ranges: the darkest tenth of the curve, the curve, and all that a half target stores.
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            u[0][i] *= 0.5;
            u[1][i] *= 8.0;
            u[2][i] *= 65504.0 * u[2][i] * u[2][i] * u[2][i];
        }
        return std::vector<Argument>{{"light", u}};
    };
    const auto display = [] {
        std::vector<std::vector<double>> u = unit_cube(3);
        for (double& value : u[1]) value = 0.9 + 0.1 * value;
        for (double& value : u[2]) value *= 0.1;
        return std::vector<Argument>{{"display", u}};
    };
    std::vector<FunctionEntry> list;
    list.push_back(
        {.effect = "tone_map",
         .function = "tone_map",
         .files = {"tone_map/tone_map.glsl"},
         .domain = "light 0..65504",
         .arguments = light,
         .reference = [](const Lane& in, std::size_t s) { return reference::tone_curve(in(0, s)); },
         .unit = Unit::display_codes,
         .method = {1e-4, kSameFormula},
         .in_float = {1e-3, kFloatRounding},
         .half = {0.5, "some six roundings, constants and input among them, of at most 2^-12 or 0.06 codes each"},
         .flushed = {0.5, "as half; light below 6e-5 is 0, 0.07 codes"}});
    list.push_back({.effect = "tone_map",
                    .function = "inverse_tone_map",
                    .files = {"tone_map/tone_map.glsl"},
                    .domain = "display 0..1",
                    .arguments = display,
                    .reference = [](const Lane& in, std::size_t s) { return reference::inverse_tone_curve(in(0, s)); },
                    .unit = Unit::light_codes,
                    .method = {1e-3, "a slope of 299 at white multiplies the error of fp32 constants"},
                    .in_float = {1e-3, "the same slope, times a rounding"},
                    .half = {0.3, "the input is rounded to 2^-12, 0.06 codes; three roundings of the result follow"},
                    .flushed = {0.3, "as half; light below 6e-5 is 0, 0.07 codes"}});
    return list;
}

std::vector<FunctionEntry> sky_functions() {
    const auto arguments = [] {
        std::vector<std::vector<double>> u = unit_cube(4);
        for (double& height : u[0]) {
            height = 2.0 * height - 1.0;
            height *= height < 0.0 ? -height : height;  // closer near the horizon, where the colours change
        }
        // Every channel has other colours: the three columns change places.
        return std::vector<Argument>{{"height", {u[0]}},
                                     {"zenith", {u[1], u[2], u[3]}},
                                     {"horizon", {u[2], u[3], u[1]}},
                                     {"ground", {u[3], u[1], u[2]}}};
    };
    return {{.effect = "sky",
             .function = "sky_gradient",
             .files = {"common/maths.glsl", "sky/sky.glsl"},
             .domain = "height -1..1, colours 0..1",
             .arguments = arguments,
             .reference = [](const Lane& in,
                             std::size_t s) { return reference::sky_gradient(in(0), in(1, s), in(2, s), in(3, s)); },
             .unit = Unit::display_codes,
             .method = {1e-4, kSameFormula},
             .in_float = {1e-3, kFloatRounding},
             .half = {0.5, "some ten roundings of values up to 1, at most 0.06 codes each"},
             .flushed = {0.5, "as half: what is below 6e-5 is 0.02 codes"}}};
}

std::vector<FunctionEntry> function_list() {
    std::vector<FunctionEntry> list;
    const std::array parts{anti_alias_functions(),  bloom_functions(),    depth_prepass_functions(),
                           environment_functions(), shadow_functions(),   sky_functions(),
                           surface_functions(),     tone_map_functions(), transparent_functions(),
                           wet_surface_functions(), puddles_functions()};
    for (const EffectCard* card : all_effects()) {
        for (const std::vector<FunctionEntry>& part : parts) {
            for (const FunctionEntry& entry : part) {
                if (entry.effect == card->name) list.push_back(entry);
            }
        }
    }
    return list;
}

}  // namespace halfframe::accuracy
