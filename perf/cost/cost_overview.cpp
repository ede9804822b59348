// Several views beside each other, and a frame's cost as a report.
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/cost/cost_report.h"
#include "perf/report/text_table.h"

namespace halfframe::cost {
namespace {

using Json = nlohmann::ordered_json;
using perf::Align;
using perf::ms_text;

constexpr std::size_t kLineWidth = 118;

/// "surface 15.6: shader": the pass that takes most of the frame on a device.
std::string dearest(const Json& device) {
    const Json* most = nullptr;
    for (const Json& pass : device.at("passes"))
        if (most == nullptr || pass.at("ms").get<double>() > most->at("ms").get<double>()) most = &pass;
    if (most == nullptr) return "-";
    return fmt::format("{} {}: {}", most->at("pass").get<std::string>(), ms_text(most->at("ms").get<double>()),
                       most->at("bound").get<std::string>());
}

/// "within", or "1 over, 2 warned" with the first of them.
std::string verdict_of(const Json& view) {
    if (!view.contains("budget")) return "-";
    int over = 0, warned = 0;
    std::string first;
    const auto count = [&](const Json& line) {
        const std::string verdict = line.at("verdict").get<std::string>();
        over += verdict == "over" ? 1 : 0;
        warned += verdict == "warned" ? 1 : 0;
        if (first.empty() && (verdict == "over" || verdict == "warned")) first = line.at("name").get<std::string>();
    };
    for (const Json& line : view.at("budget").at("limits")) count(line);
    for (const Json& line : view.at("budget").at("lines")) count(line);
    if (over + warned == 0) return "within";
    return (over > 0 ? fmt::format("{} over", over) : "") + (over > 0 && warned > 0 ? ", " : "") +
           (warned > 0 ? fmt::format("{} warned", warned) : "") + ": " + first + (over + warned > 1 ? ", ..." : "");
}

}  // namespace

std::string overview_text(const Json& views) {
    if (views.empty()) return "nothing was counted\n";
    const Json& first = views.front();
    std::vector<perf::TextTable::Column> columns{
        {"camera"}, {"tier"}, {"draws", Align::right}, {"triangles", Align::right}, {"shaded a pixel", Align::right}};
    for (const Json& device : first.at("devices")) {
        columns.push_back({device.at("profile").get<std::string>(), Align::right});
        columns.push_back({"band"});
        columns.push_back({first.at("arithmetic") == "half" ? "full" : "half", Align::right});
    }
    columns.push_back({"dearest on " + first.at("devices").front().at("profile").get<std::string>()});
    columns.push_back({"budget"});
    perf::TextTable table(columns);
    std::string tier_before;
    for (const Json& view : views) {
        const std::string tier = view.at("tier").get<std::string>();
        if (!tier_before.empty() && tier != tier_before) table.add_rule();
        tier_before = tier;
        const Json& counts = view.at("frame_counts");
        const double pixels = view.at("width").get<double>() * view.at("height").get<double>();
        const std::string camera = view.at("camera").get<std::string>();
        std::vector<std::string> row{camera.empty() ? "-" : camera, tier,
                                     fmt::format("{:.0f}", counts.at("draws").get<double>()),
                                     fmt::format("{:.0f}", counts.at("triangles").get<double>()),
                                     fmt::format("{:.2f}", counts.at("fragments_shaded").get<double>() / pixels)};
        for (const Json& device : view.at("devices")) {
            row.push_back(ms_text(device.at("frame_ms").get<double>()));
            row.push_back(ms_text(device.at("frame_low_ms").get<double>()) + ".." +
                          ms_text(device.at("frame_high_ms").get<double>()));
            row.push_back(ms_text(device.at("other_arithmetic_frame_ms").get<double>()));
        }
        row.push_back(dearest(view.at("devices").front()));
        row.push_back(verdict_of(view));
        table.add_row(row);
    }
    return fmt::format("cost of {}, {} views of {}x{}, {} arithmetic; milliseconds\nmodel version {}, {}\n\n",
                       first.at("scene").get<std::string>(), views.size(), first.at("width").get<int>(),
                       first.at("height").get<int>(), first.at("arithmetic").get<std::string>(),
                       first.at("model_version").get<int>(), first.at("compiler").get<std::string>()) +
           table.text() + "\n" + perf::wrapped(kModelledWords, kLineWidth, 0) + "\n";
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return quoted + '"';
}

std::string csv_of(const Json& views) {
    constexpr std::array kFrame{"scene", "camera", "tier", "arithmetic"};
    constexpr std::array kPass{"pass",
                               "ms",
                               "low_ms",
                               "high_ms",
                               "shortest_ms",
                               "longest_ms",
                               "bound",
                               "fixed_ms",
                               "resolve_ms",
                               "memory_bytes",
                               "edram_tiles",
                               "edram_replays",
                               "work_per_fragment",
                               "temporaries",
                               "other_arithmetic_ms"};
    const auto field = [](const Json& value) {
        return value.is_number_float() ? fmt::format("{:.6f}", value.get<double>())
                                       : csv_field(value.is_string() ? value.get<std::string>() : value.dump());
    };
    std::string csv;
    for (const char* key : kFrame) csv += std::string(key) + ',';
    csv += "device";
    for (const char* key : kPass) csv += ',' + std::string(key);
    csv += '\n';
    for (const Json& view : views) {
        for (const Json& device : view.at("devices")) {
            for (const Json& pass : device.at("passes")) {
                for (const char* key : kFrame) csv += field(view.at(key)) + ',';
                csv += field(device.at("profile"));
                for (const char* key : kPass) csv += ',' + field(pass.at(key));
                csv += '\n';
            }
        }
    }
    return csv;
}

perf::FrameReport report_of(const FrameCost& cost) {
    perf::FrameReport report;
    report.scene = cost.scene;
    report.camera = cost.camera;
    report.caps.software = true;  // nothing here was timed
    report.plan = cost.plan;
    report.plan.arithmetic = cost.arithmetic;
    report.texture_bytes = cost.texture_bytes;
    report.notices = cost.notices;
    report.modelled = perf::modelled_from(cost_json(cost));
    return report;
}

}  // namespace halfframe::cost
