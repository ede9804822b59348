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
    if (function.here) count += function.here->highp.not_finite;
    if (function.here && function.here->mediump) count += function.here->mediump->not_finite;
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

std::string functions_text(const std::vector<FunctionAccuracy>& functions) {
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
                           {"highp here", Align::right},
                           {"mediump here", Align::right},
                           {"not finite", Align::right},
                           {"bounds", Align::left}});
    std::string inputs;
    for (const FunctionAccuracy& function : functions) {
        const FunctionEntry& entry = function.entry;
        const auto& [in_float, half, flushed, minimum] = function.arithmetic;
        const bool mediump_here = function.here && function.here->mediump;
        table.add_row({entry.effect, entry.function, name(entry.tier), halfframe::name(entry.arithmetic),
                       name(entry.unit), figure(function.method.largest), figure(function.method.p99),
                       figure(in_float.largest), figure(half.largest), figure(half.p99), figure(flushed.largest),
                       figure(minimum.largest), function.here ? figure(function.here->highp.largest) : "-",
                       mediump_here ? figure(function.here->mediump->largest) : "-",
                       std::to_string(not_finite(function)), function.violations.empty() ? "hold" : "exceeded"});
        inputs += fmt::format("{}.{} ({})\n", entry.effect, entry.function, name(entry.tier));
        inputs += fmt::format("  {} inputs: {}\n", function.lanes, entry.domain);
        inputs += fmt::format("  method  {}\n", input_text(function, function.method.worst_lane));
        inputs += fmt::format("  half    {}\n", input_text(function, half.worst_lane));
        if (flushed.worst_lane != half.worst_lane) {
            inputs += fmt::format("  flushed {}\n", input_text(function, flushed.worst_lane));
        }
        if (mediump_here && function.here->mediump->worst_lane != half.worst_lane) {
            inputs += fmt::format("  here    {}\n", input_text(function, function.here->mediump->worst_lane));
        }
    }
    return "method: the shader in double against its reference. float, half, flushed (half without subnormals), ES "
           "min\n"
           "(the least GLSL ES allows): the shader in that arithmetic against itself in double; here: drawn on the "
           "context\n"
           "above over the same inputs. Largest error, p99 beside two of them. Nothing is stored, so no target format "
           "is in\n"
           "these figures. codes: of 255, behind the tone curve.\n\n" +
           table.text() + "\nInputs, and the worst of them\n" + inputs;
}

Json functions_json(const std::vector<FunctionAccuracy>& functions) {
    Json all = Json::array();
    for (const FunctionAccuracy& function : functions) {
        const FunctionEntry& entry = function.entry;
        Json arithmetics = Json::object();
        for (std::size_t i = 0; i < kArithmetics.size(); ++i) {
            const shader_ir::Model model = kArithmetics[i];
            arithmetics[shader_ir::name(model)] = gap_json(function, function.arithmetic[i], bound_of(entry, model));
        }
        Json here;  // null: no context
        if (function.here) {
            here["highp"] = gap_json(function, function.here->highp, function.here->highp_bound);
            if (function.here->mediump)
                here["mediump"] = gap_json(function, *function.here->mediump, function.here->mediump_bound);
        }
        all.push_back({{"effect", entry.effect},
                       {"function", entry.function},
                       {"files", entry.files},
                       {"tier", name(entry.tier)},
                       {"arithmetic", halfframe::name(entry.arithmetic)},
                       {"unit", name(entry.unit)},
                       {"domain", entry.domain},
                       {"lanes", function.lanes},
                       {"method_gap", gap_json(function, function.method, entry.method)},
                       {"arithmetic_gap", arithmetics},
                       {"context_gap", here},
                       {"violations", function.violations}});
    }
    return all;
}

}  // namespace

std::vector<std::string> AccuracyReport::violations() const {
    std::vector<std::string> all;
    const auto add = [&](const auto& rows) {
        for (const auto& row : rows) all.insert(all.end(), row.violations.begin(), row.violations.end());
    };
    add(functions);
    add(models);
    add(storage);
    add(depth);
    add(frames);
    return all;
}

std::string accuracy_text(const AccuracyReport& report) {
    std::string text =
        report.here.missing.empty() ? "here: " + report.here.driver : "here: nothing was drawn: " + report.here.missing;
    text += "\n";
    if (!report.functions.empty()) text += '\n' + functions_text(report.functions);
    if (!report.models.empty()) text += '\n' + models_text(report.models);
    if (!report.storage.empty()) text += '\n' + storage_text(report.storage);
    if (!report.depth.empty()) text += '\n' + depth_text(report.depth);
    if (!report.frames.empty()) text += '\n' + frames_text(report.frames);
    const std::vector<std::string> violations = report.violations();
    if (!violations.empty()) text += "\n";
    for (const std::string& violation : violations) text += "exceeded: " + violation + "\n";
    return text;
}

nlohmann::ordered_json accuracy_json(const AccuracyReport& report) {
    Json here{{"driver", nullptr}, {"missing", nullptr}};
    if (report.here.missing.empty()) here["driver"] = report.here.driver;
    else here["missing"] = report.here.missing;
    Json all{{"context", here}};
    if (!report.functions.empty()) all["functions"] = functions_json(report.functions);
    if (!report.models.empty()) all["models"] = models_json(report.models);
    if (!report.storage.empty()) all["storage"] = storage_json(report.storage);
    if (!report.depth.empty()) all["depth"] = depth_json(report.depth);
    if (!report.frames.empty()) all["frames"] = frames_json(report.frames);
    return all;
}

}  // namespace halfframe::accuracy
