// Accuracy figures in words and in JSON.
#include "perf/accuracy/accuracy_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/report/text_table.h"

namespace halfframe::accuracy {
namespace {

using perf::Align;
using Json = nlohmann::ordered_json;

std::string figure(double value) { return value == 0.0 ? "0" : fmt::format("{:.2g}", value); }

std::size_t not_finite(const FunctionAccuracy& function) {
    std::size_t count = function.method.not_finite;
    for (const Gap& gap : function.arithmetic) count += gap.not_finite;
    return count;
}

std::string input_text(const FunctionAccuracy& function, std::size_t lane) {
    std::string text;
    for (const Argument& argument : function.arguments) {
        text += fmt::format("{}{} ", text.empty() ? "" : ", ", argument.name);
        for (std::size_t scalar = 0; scalar < argument.values.size(); ++scalar) {
            text += fmt::format("{}{:.5g}", scalar == 0 ? "" : " ", argument.values[scalar][lane]);
        }
    }
    return text;
}

Json gap_json(const FunctionAccuracy& function, const Gap& gap, const Bound& bound) {
    Json input = Json::object();
    for (const Argument& argument : function.arguments) {
        Json scalars = Json::array();
        for (const std::vector<double>& column : argument.values) scalars.push_back(column[gap.worst_lane]);
        input[argument.name] = scalars;
    }
    return {{"largest", gap.largest},       {"p99", gap.p99},
            {"bound", bound.at_most},       {"bound_reason", bound.reason},
            {"not_finite", gap.not_finite}, {"worst_input", input}};
}

std::string signed_figure(double value) { return value == 0.0 ? "0" : fmt::format("{:+.3g}", value); }

Json model_json(const ModelAccuracy& model) {
    const ModelEntry& entry = model.entry;
    Json place = Json::object();
    for (std::size_t axis = 0; axis < entry.axes.size(); ++axis) {
        place[entry.axes[axis]] = model.errors[model.worst].at[axis];
    }
    return {{"effect", entry.effect},
            {"model", entry.model},
            {"truth", entry.truth},
            {"unit", entry.unit},
            {"places", model.errors.size()},
            {"lowest", model.lowest},
            {"highest", model.highest},
            {"mean", model.mean},
            {"worst_place", place},
            {"largest_bound", entry.largest.at_most},
            {"largest_bound_reason", entry.largest.reason},
            {"mean_bound", entry.mean.at_most},
            {"mean_bound_reason", entry.mean.reason},
            {"violations", model.violations}};
}

}  // namespace

std::string accuracy_text(std::span<const FunctionAccuracy> functions) {
    perf::TextTable table({{"effect", Align::left},
                           {"function", Align::left},
                           {"tier", Align::left},
                           {"arithmetic", Align::left},
                           {"error", Align::left},
                           {"method", Align::right},
                           {"p99", Align::right},
                           {"float", Align::right},
                           {"half", Align::right},
                           {"p99", Align::right},
                           {"flushed", Align::right},
                           {"ES min", Align::right},
                           {"not finite", Align::right},
                           {"bounds", Align::left}});
    std::string inputs;
    std::string exceeded;
    for (const FunctionAccuracy& function : functions) {
        const FunctionEntry& entry = function.entry;
        const auto& [in_float, half, flushed, minimum] = function.arithmetic;
        table.add_row({entry.effect, entry.function, name(entry.tier), halfframe::name(entry.arithmetic),
                       name(entry.unit), figure(function.method.largest), figure(function.method.p99),
                       figure(in_float.largest), figure(half.largest), figure(half.p99), figure(flushed.largest),
                       figure(minimum.largest), std::to_string(not_finite(function)),
                       function.violations.empty() ? "hold" : "exceeded"});
        inputs += fmt::format("{}.{} ({})\n", entry.effect, entry.function, name(entry.tier));
        inputs += fmt::format("  {} inputs: {}\n", function.lanes, entry.domain);
        inputs += fmt::format("  method  {}\n", input_text(function, function.method.worst_lane));
        inputs += fmt::format("  half    {}\n", input_text(function, half.worst_lane));
        if (flushed.worst_lane != half.worst_lane) {
            inputs += fmt::format("  flushed {}\n", input_text(function, flushed.worst_lane));
        }
        for (const std::string& violation : function.violations) exceeded += "exceeded: " + violation + "\n";
    }
    return "method: the shader in double against its reference. float, half, flushed (half without subnormals), ES "
           "min\n"
           "(the least GLSL ES allows): the shader in that arithmetic against itself in double. Largest error, p99 "
           "beside\n"
           "two of them. Nothing is stored, so no target format is in these figures. codes: of 255, behind the tone "
           "curve.\n\n" +
           table.text() + "\nInputs, and the worst of them\n" + inputs + (exceeded.empty() ? "" : "\n" + exceeded);
}

std::string models_text(std::span<const ModelAccuracy> models) {
    if (models.empty()) return "";
    perf::TextTable table({{"effect", Align::left},
                           {"model", Align::left},
                           {"error", Align::left},
                           {"lowest", Align::right},
                           {"highest", Align::right},
                           {"mean", Align::right},
                           {"places", Align::right},
                           {"bounds", Align::left}});
    std::string places;
    std::string exceeded;
    for (const ModelAccuracy& model : models) {
        const ModelEntry& entry = model.entry;
        table.add_row({entry.effect, entry.model, entry.unit, signed_figure(model.lowest), signed_figure(model.highest),
                       figure(model.mean), std::to_string(model.errors.size()),
                       model.violations.empty() ? "hold" : "exceeded"});
        places += fmt::format("{}, {}\n  truth  {}\n  worst ", entry.effect, entry.model, entry.truth);
        for (std::size_t axis = 0; axis < entry.axes.size(); ++axis) {
            places += fmt::format(" {} {:g}", entry.axes[axis], model.errors[model.worst].at[axis]);
        }
        places += "\n";
        for (const std::string& violation : model.violations) exceeded += "exceeded: " + violation + "\n";
    }
    return "\nModels against what they stand for, both in double: what is lost (lowest), what is gained (highest), and "
           "the\nmean size of the error.\n\n" +
           table.text() + "\n" + places + (exceeded.empty() ? "" : "\n" + exceeded);
}

nlohmann::ordered_json accuracy_json(std::span<const FunctionAccuracy> functions,
                                     std::span<const ModelAccuracy> models) {
    Json all = Json::array();
    for (const FunctionAccuracy& function : functions) {
        const FunctionEntry& entry = function.entry;
        Json arithmetics = Json::object();
        for (std::size_t i = 0; i < kArithmetics.size(); ++i) {
            const shader_ir::Model model = kArithmetics[i];
            arithmetics[shader_ir::name(model)] = gap_json(function, function.arithmetic[i], bound_of(entry, model));
        }
        all.push_back({{"effect", entry.effect},
                       {"function", entry.function},
                       {"files", entry.files},
                       {"tier", name(entry.tier)},
                       {"arithmetic", halfframe::name(entry.arithmetic)},
                       {"storage", nullptr},
                       {"unit", name(entry.unit)},
                       {"domain", entry.domain},
                       {"lanes", function.lanes},
                       {"method_gap", gap_json(function, function.method, entry.method)},
                       {"arithmetic_gap", arithmetics},
                       {"violations", function.violations}});
    }
    for (const ModelAccuracy& model : models) all.push_back(model_json(model));
    return all;
}

}  // namespace halfframe::accuracy
