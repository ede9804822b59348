// The search in words and in JSON.
#include "perf/stability/stability_report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/report/text_table.h"

namespace halfframe::stability {
namespace {

using perf::Align;
using Json = nlohmann::ordered_json;

std::string effect_of(const Declaration& function) { return function.file.substr(0, function.file.find('/')); }

std::string cell(const FunctionStability& function, const std::string& arithmetic) {
    const auto tally = std::ranges::find(function.tallies, arithmetic, &Tally::arithmetic);
    if (tally == function.tallies.end()) return "-";
    if (!tally->broken.empty()) return "broken";
    return ratio_text(std::max(tally->worst.ratio, 0.0));
}

std::string functions_text(const StabilityReport& report) {
    perf::TextTable table({{"effect", Align::left},
                           {"function", Align::left},
                           {"inputs", Align::right},
                           {"float", Align::right},
                           {"half", Align::right},
                           {"flushed", Align::right},
                           {"ES min", Align::right},
                           {"mediump here", Align::right},
                           {"highp here", Align::right},
                           {"portable", Align::left}});
    for (const FunctionStability& function : report.functions) {
        table.add_row({effect_of(function.function), function.title, std::to_string(function.lanes),
                       cell(function, "float"), cell(function, "half"), cell(function, "half_flushed"),
                       cell(function, "es_minimum"), cell(function, "mediump here"), cell(function, "highp here"),
                       function.portable()           ? "yes"
                       : function.violations.empty() ? "by exemption"
                                                     : "no"});
    }
    return "Worst error over the criterion (4 times what rounding the inputs must cause, and 2 steps of the result)\n" +
           table.text();
}

std::string exemptions_text(const StabilityReport& report) {
    std::string text;
    std::set<std::string> told;
    for (const FunctionStability& function : report.functions) {
        if (!told.insert(function.function.place()).second) continue;
        for (const Exemption& one : function.function.exemptions) {
            std::string models;
            for (const shader_ir::Model model : one.models)
                models += (models.empty() ? "" : ", ") + std::string(shader_ir::name(model));
            text += fmt::format("  {} {}, {}: {}: {}\n", function.function.place(), function.function.name, models,
                                one.bound(), one.reason);
        }
    }
    for (const Declaration& function : report.not_run)
        text += fmt::format("  {} {}, not run alone: {}\n", function.place(), function.name, function.not_run);
    return text.empty() ? "" : "\nExemptions\n" + text;
}

/// The price of the form that holds.
std::string costs_text(const std::vector<ExhibitResult>& exhibit) {
    std::vector<perf::TextTable::Column> columns{{"what the fix costs", Align::left}};
    for (const FixCost& cost : exhibit.front().costs) {
        columns.push_back({cost.profile + " printed", Align::right});
        columns.push_back({"mended", Align::right});
        columns.push_back({"fix [ms]", Align::right});
    }
    perf::TextTable table(columns);
    for (const ExhibitResult& one : exhibit) {
        std::vector<std::string> row{one.entry.name};
        for (const FixCost& cost : one.costs) {
            row.push_back(fmt::format("{:.3f}", cost.printed_ms));
            row.push_back(fmt::format("{:.3f}", cost.mended_ms));
            row.push_back(fmt::format("{:+.3f}", cost.mended_ms - cost.printed_ms));
        }
        table.add_row(row);
    }
    return "\nModelled milliseconds of the shading units, one call at each pixel of 1280x720, mediump as half; no "
           "mediump "
           "hardware was measured\n" +
           table.text();
}

std::string exhibit_text(const std::vector<ExhibitResult>& exhibit) {
    if (exhibit.empty()) return "";
    perf::TextTable table({{"listing as printed", Align::left},
                           {"half", Align::right},
                           {"flushed", Align::right},
                           {"ES min", Align::right},
                           {"beside it", Align::left},
                           {"half", Align::right},
                           {"flushed", Align::right},
                           {"ES min", Align::right},
                           {"found", Align::left}});
    std::string stories;
    for (const ExhibitResult& one : exhibit) {
        table.add_row({one.entry.name, cell(one.printed, "half"), cell(one.printed, "half_flushed"),
                       cell(one.printed, "es_minimum"), one.entry.mended, cell(one.mended, "half"),
                       cell(one.mended, "half_flushed"), cell(one.mended, "es_minimum"), one.found ? "yes" : "no"});
        stories += fmt::format("  {}: {}. {}.\n", one.entry.name, one.entry.breaks, one.entry.shipped);
        if (!one.printed.violations.empty()) stories += "    " + one.printed.violations.front() + "\n";
    }
    return "\nExhibit: listings as printed, half everywhere\n" + table.text() + stories + costs_text(exhibit);
}

Json finding_json(const Declaration& function, const Finding& finding) {
    Json input = Json::object();
    std::size_t at = 0;
    for (const DeclaredParameter& parameter : function.parameters) {
        Json scalars = Json::array();
        for (int s = 0; s < parameter.components; ++s) scalars.push_back(finding.input.at(at++));
        input[parameter.name] = scalars;
    }
    return {{"input", input},     {"component", finding.component}, {"expected", finding.expected},
            {"got", finding.got}, {"allowed", finding.allowed},     {"ratio", finding.ratio}};
}

Json costs_json(const std::vector<FixCost>& costs) {
    Json json = Json::object();
    for (const FixCost& cost : costs) json[cost.profile] = {{"printed", cost.printed_ms}, {"mended", cost.mended_ms}};
    return json;
}

Json function_json(const FunctionStability& function) {
    Json tallies = Json::array();
    for (const Tally& tally : function.tallies) {
        Json broken = Json::array();
        for (const BrokenPromise& one : tally.broken)
            broken.push_back({{"promise", one.promise},
                              {"inputs", one.lanes},
                              {"first", finding_json(function.function, one.first)}});
        Json row{{"arithmetic", tally.arithmetic}, {"inputs", tally.lanes},
                 {"not_finite", tally.not_finite}, {"over", tally.over},
                 {"at_most", tally.at_most},       {"broken_promises", broken},
                 {"holds", tally.holds()}};
        if (tally.worst.ratio >= 0.0) row["worst"] = finding_json(function.function, tally.worst);
        tallies.push_back(row);
    }
    return {{"function", function.title},       {"place", function.function.place()},
            {"variant", function.variant},      {"method", function.method},
            {"inputs", function.lanes},         {"near_jump", function.near_jump},
            {"portable", function.portable()},  {"arithmetics", tallies},
            {"violations", function.violations}};
}

}  // namespace

std::string ratio_text(double ratio) {
    if (!std::isfinite(ratio)) return "inf";
    return ratio == 0.0 ? "0" : ratio < 0.01 ? "<0.01" : fmt::format("{:.2g}", ratio);
}

std::size_t StabilityReport::covered() const {
    std::set<std::string> places;
    for (const FunctionStability& one : functions) places.insert(one.function.place());
    for (const Declaration& one : not_run) places.insert(one.place());
    return places.size();
}

std::size_t StabilityReport::inputs() const {
    std::size_t sum = 0;
    for (const FunctionStability& one : functions) {
        for (const Tally& tally : one.tallies) sum += tally.lanes;
    }
    return sum;
}

std::size_t StabilityReport::not_finite() const {
    std::size_t sum = 0;
    for (const FunctionStability& one : functions) {
        for (const Tally& tally : one.tallies) sum += tally.not_finite;
    }
    return sum;
}

std::size_t StabilityReport::found() const {
    return static_cast<std::size_t>(std::ranges::count(exhibit, true, &ExhibitResult::found));
}

std::vector<std::string> StabilityReport::violations() const {
    std::vector<std::string> all;
    for (const Declaration& one : gaps) all.push_back(gap_in(one));
    for (const FunctionStability& one : functions) all.insert(all.end(), one.violations.begin(), one.violations.end());
    for (const ExhibitResult& one : exhibit) {
        if (!one.found) {
            all.push_back(fmt::format("{}: the planted fault '{}' was not found, or {} is refused too", one.entry.file,
                                      one.entry.name, one.entry.mended));
        }
    }
    return all;
}

std::string stability_text(const StabilityReport& report) {
    std::string text =
        report.missing.empty() ? "on " + report.driver + "\n" : "nothing was drawn: " + report.missing + "\n";
    text += '\n' + functions_text(report) + exemptions_text(report) + exhibit_text(report.exhibit) + "\n";
    const std::vector<std::string> violations = report.violations();
    if (!violations.empty()) text += "Does not hold\n";
    for (const std::string& one : violations) text += "  " + perf::wrapped(one, 118, 4) + "\n";
    if (report.in_shaders_es > 0) {
        text += fmt::format("functions {} / {} in shaders_es ({} run, {} with a reason not to)\n", report.covered(),
                            report.in_shaders_es, report.covered() - report.not_run.size(), report.not_run.size());
    }
    if (report.from_earlier_run > 0) {
        text += fmt::format("{} of {} results are those of an earlier run that was interrupted\n",
                            report.from_earlier_run, report.functions.size());
    }
    text += fmt::format("inputs {}, NaN or inf {}\n", report.inputs(), report.not_finite());
    if (!report.exhibit.empty())
        text += fmt::format("planted faults found {} / {}\n", report.found(), report.exhibit.size());
    return text;
}

Json stability_json(const StabilityReport& report) {
    Json functions = Json::array(), not_run = Json::array(), exhibit = Json::array();
    for (const FunctionStability& one : report.functions) functions.push_back(function_json(one));
    for (const Declaration& one : report.not_run)
        not_run.push_back({{"function", one.name}, {"place", one.place()}, {"reason", one.not_run}});
    for (const ExhibitResult& one : report.exhibit) {
        exhibit.push_back({{"name", one.entry.name},
                           {"found", one.found},
                           {"breaks", one.entry.breaks},
                           {"shipped", one.entry.shipped},
                           {"printed", function_json(one.printed)},
                           {"mended", function_json(one.mended)},
                           {"modelled_ms", costs_json(one.costs)}});
    }
    const auto text_or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
    return {{"context", {{"driver", text_or_null(report.driver)}, {"missing", text_or_null(report.missing)}}},
            {"functions_in_shaders_es", report.in_shaders_es},
            {"functions_covered", report.covered()},
            {"inputs", report.inputs()},
            {"not_finite", report.not_finite()},
            {"planted", report.exhibit.size()},
            {"found", report.found()},
            {"functions", functions},
            {"not_run", not_run},
            {"exhibit", exhibit},
            {"violations", report.violations()}};
}

}  // namespace halfframe::stability
