// Evaluates the measured functions and compares.
#include "perf/accuracy/measure.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/error.h"
#include "perf/accuracy/function_bench.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::accuracy {
namespace {

using shader_ir::Columns;
using shader_ir::Model;

gl::Define tier_define(const FunctionEntry& entry) {
    std::string tier = name(entry.tier);
    std::transform(tier.begin(), tier.end(), tier.begin(), [](char letter) {
        return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 32) : letter;
    });
    return {"TIER_" + tier, "1"};
}

shader_ir::Module module_of(const FunctionEntry& entry) {
    return shader_ir::compile(shader_ir::FunctionFiles{
        .paths = entry.files, .arithmetic = entry.arithmetic, .defines = {tier_define(entry)}, .more_text = ""});
}

/// The results on a real context, one array per scalar.
Columns drawn(const FunctionAccuracy& measured, gl::EntryPoints& gl, const gl::Caps& caps, gl::Arithmetic arithmetic) {
    const FunctionEntry& entry = measured.entry;
    if (entry.on_context) return entry.on_context(measured.arguments, gl, caps, arithmetic);
    DrawnFunction function{.function = entry.function,
                           .files = entry.files,
                           .arithmetic = arithmetic,
                           .defines = {tier_define(entry)},
                           .returned = static_cast<int>(measured.in_double.size())};
    const shader_ir::Module module = module_of(entry);
    const shader_ir::Function& declared = module.function(entry.function);
    std::vector<Columns> inputs;
    for (std::size_t i = 0; i < measured.arguments.size(); ++i) {
        inputs.push_back(measured.arguments[i].values);
        function.parameters.push_back({.components = static_cast<int>(inputs.back().size()),
                                       .full = !module.relaxed[declared.parameters.at(i).id]});
    }
    const std::vector<float> pixels = draw_function(gl, caps, function, inputs);
    Columns results(measured.in_double.size(), std::vector<double>(measured.lanes));
    for (std::size_t s = 0; s < results.size(); ++s) {
        for (std::size_t lane = 0; lane < measured.lanes; ++lane) results[s][lane] = pixels[lane * 4 + s];
    }
    return results;
}

double distance(const FunctionEntry& entry, const Lane& lane, std::size_t scalar, double found, double truth) {
    constexpr double kCodes = 255.0;
    switch (entry.unit) {
        case Unit::absolute: return std::fabs(found - truth);
        case Unit::of_peak: return std::fabs(found - truth) / entry.peak(lane, scalar);
        case Unit::display_codes: return kCodes * std::fabs(found - truth);
        case Unit::light_codes:
            // A negative light is stored as 0, which is what the display shows of it.
            return kCodes *
                   std::fabs(reference::tone_curve(std::max(found, 0.0)) - reference::tone_curve(std::max(truth, 0.0)));
    }
    throw Mistake("a unit that is not computed");
}

Gap gap(const FunctionEntry& entry, const std::vector<Argument>& arguments, const Columns& found,
        const Columns& truth) {
    Gap result;
    std::vector<double> errors;
    std::optional<std::size_t> first_not_finite;
    for (std::size_t scalar = 0; scalar < found.size(); ++scalar) {
        for (std::size_t lane = 0; lane < found[scalar].size(); ++lane) {
            if (!std::isfinite(found[scalar][lane])) {
                ++result.not_finite;
                if (!first_not_finite) first_not_finite = lane;
                continue;
            }
            if (!std::isfinite(truth[scalar][lane])) continue;  // counted where the truth was the one to be judged
            const double error =
                distance(entry, Lane(arguments, lane), scalar, found[scalar][lane], truth[scalar][lane]);
            if (error > result.largest) {
                result.largest = error;
                result.worst_lane = lane;
            }
            errors.push_back(error);
        }
    }
    if (first_not_finite) result.worst_lane = *first_not_finite;
    if (!errors.empty()) {
        const auto place = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
        std::nth_element(errors.begin(), place, errors.end());
        result.p99 = *place;
    }
    return result;
}

Columns reference_values(const FunctionEntry& entry, const std::vector<Argument>& arguments, std::size_t scalars,
                         std::size_t lanes) {
    Columns values(scalars, std::vector<double>(lanes));
    for (std::size_t scalar = 0; scalar < scalars; ++scalar) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double value = entry.reference(Lane(arguments, lane), scalar);
            expect(std::isfinite(value),
                   [&] { return fmt::format("the reference of {} is {} in lane {}", entry.function, value, lane); });
            values[scalar][lane] = value;
        }
    }
    return values;
}

void judge(std::vector<std::string>& violations, const FunctionEntry& entry, const std::string& what, const Gap& found,
           const Bound& bound) {
    const std::string subject = fmt::format("{}.{} ({}), {}", entry.effect, entry.function, name(entry.tier), what);
    if (found.not_finite > 0) {
        violations.push_back(fmt::format("{}: {} results are not finite", subject, found.not_finite));
    }
    if (found.largest > bound.at_most) {
        violations.push_back(fmt::format("{}: {:.3g} {} is over the bound of {:.3g} ({})", subject, found.largest,
                                         name(entry.unit), bound.at_most, bound.reason));
    }
}

}  // namespace

const Bound& bound_of(const FunctionEntry& entry, shader_ir::Model model) {
    switch (model) {
        case Model::in_float: return entry.in_float;
        case Model::half: return entry.half;
        case Model::half_flushed:
        case Model::es_minimum: return entry.flushed;
        case Model::in_double: break;
    }
    throw Mistake("double is what the other models are measured against");
}

FunctionAccuracy measure(const FunctionEntry& entry) {
    FunctionAccuracy result{.entry = entry, .arguments = entry.arguments()};
    std::vector<Columns> inputs;
    for (const Argument& argument : result.arguments) {
        for (const std::vector<double>& column : argument.values) {
            result.lanes = std::max(result.lanes, column.size());
        }
        inputs.push_back(argument.values);
    }
    for (const Argument& argument : result.arguments) {
        for (const std::vector<double>& column : argument.values) {
            expect(column.size() == result.lanes, "all arguments of a measured function have as many lanes");
        }
    }
    const shader_ir::Module module = entry.in_model ? shader_ir::Module{} : module_of(entry);
    const auto run = [&](Model model) {
        if (entry.in_model) return entry.in_model(result.arguments, model);
        return shader_ir::evaluate(module, entry.function, inputs, model).returned;
    };
    result.in_double = run(Model::in_double);
    const Columns& in_double = result.in_double;
    expect(!in_double.empty() && in_double[0].size() == result.lanes, "a measured function returns one value per lane");

    const Columns truth = reference_values(entry, result.arguments, in_double.size(), result.lanes);
    result.method = gap(entry, result.arguments, in_double, truth);
    judge(result.violations, entry, "method", result.method, entry.method);
    for (std::size_t i = 0; i < kArithmetics.size(); ++i) {
        const Model model = kArithmetics[i];
        result.arithmetic[i] = gap(entry, result.arguments, run(model), in_double);
        judge(result.violations, entry, shader_ir::name(model), result.arithmetic[i], bound_of(entry, model));
    }
    return result;
}

void measure_here(FunctionAccuracy& function, gl::EntryPoints& gl, const gl::Caps& caps,
                  const perf::PrecisionProbe& probe) {
    const FunctionEntry& entry = function.entry;
    const bool keeps_all = probe.mediump.keeps_subnormals || !probe.mediump.is_half();
    HereGaps here;
    here.mediump_bound = entry.here_mediump.value_or(keeps_all ? entry.half : entry.flushed);
    here.highp_bound = entry.here_highp.value_or(entry.in_float);
    const auto gap_of = [&](gl::Arithmetic arithmetic) {
        return gap(entry, function.arguments, drawn(function, gl, caps, arithmetic), function.in_double);
    };
    here.highp = gap_of(gl::Arithmetic::full);
    judge(function.violations, entry, "here, highp", here.highp, here.highp_bound);
    if (entry.arithmetic == Arithmetic::half) {
        here.mediump = gap_of(gl::Arithmetic::half);
        judge(function.violations, entry, "here, mediump", *here.mediump, here.mediump_bound);
    }
    function.here = here;
}

}  // namespace halfframe::accuracy
