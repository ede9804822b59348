// What is said of a comparison.
#include "perf/peers/peers_report.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "perf/peers/comparison.h"
#include "perf/report/text_table.h"

namespace halfframe::peers {
namespace {

using perf::Align;
using perf::ms_text;

/// Others may use this share of the processors before the times are called noisy.
constexpr double kQuietShare = 0.05;

const Result* find(const Comparison& comparison, const std::string& name) {
    const auto found =
        std::ranges::find_if(comparison.results, [&](const Result& result) { return result.contestant.name == name; });
    return found == comparison.results.end() || found->refused || found->ms.empty() ? nullptr : &*found;
}

std::string ratio_text(const Result& result, const Result* other) {
    if (other == nullptr) return "-";
    if (other == &result) return "1";
    const Spread of = ratio(result.ms, other->ms);
    return fmt::format("{:.3f} ({:.3f}..{:.3f})", of.median, of.low, of.high);
}

std::string processor_ratio_text(const Result& result, const Result* other) {
    if (other == nullptr) return "-";
    return other == &result ? "1" : fmt::format("{:.3f}", ratio(result.processor_ms, other->processor_ms).median);
}

/// What halfframe is to reach on this model, and whether it does.
struct Verdict {
    Target target;
    bool reached = false;
};

std::optional<Verdict> verdict(const Comparison& comparison, const Result& result) {
    const Result* three = find(comparison, kThree);
    const Result* floor = find(comparison, result.contestant.floor);
    if (result.contestant.share_of_three <= 0.0 || three == nullptr || floor == nullptr) return std::nullopt;
    const Target aim = target(spread(three->ms).median, result.contestant.share_of_three, spread(floor->ms).median);
    return Verdict{.target = aim, .reached = spread(result.ms).median <= aim.ms};
}

std::string verdict_text(const Comparison& comparison, const Result& result) {
    const auto of = verdict(comparison, result);
    if (!of) return "";
    return fmt::format(
        "{} {} ms, {}", of->reached ? "reaches" : "misses", ms_text(of->target.ms),
        of->target.by_floor ? "1.5 x its fetches" : fmt::format("{} of three.js", result.contestant.share_of_three));
}

std::string model_table(const Comparison& comparison) {
    perf::TextTable table({{"renderer"},
                           {"ms", Align::right},
                           {"p25..p75", Align::right},
                           {"CPU ms", Align::right},
                           {"CPU of three.js", Align::right},
                           {"of three.js", Align::right},
                           {"of Filament", Align::right},
                           {"of its floor", Align::right},
                           {"covers", Align::right},
                           {"bright", Align::right},
                           {"IBL"},
                           {"aim"}});
    for (const Result& result : comparison.results) {
        if (result.refused || result.ms.empty()) {
            table.add_row({result.contestant.name, "refused", "", "", "", "", "", "", "", "", "", ""});
            continue;
        }
        const Spread ms = spread(result.ms);
        const bool ours = result.contestant.ours;
        table.add_row(
            {result.contestant.name, ms_text(ms.median), fmt::format("{}..{}", ms_text(ms.low), ms_text(ms.high)),
             ms_text(spread(result.processor_ms).median), processor_ratio_text(result, find(comparison, kThree)),
             ratio_text(result, find(comparison, kThree)), ratio_text(result, find(comparison, kFilament)),
             ours ? ratio_text(result, find(comparison, result.contestant.floor)) : "-",
             fmt::format("{:.1f} %", 100.0 * result.covered), fmt::format("{:.2f}", result.brightness),
             result.contestant.ours && result.contestant.floor.empty() ? "-" : result.lit_by,
             verdict_text(comparison, result)});
    }
    return table.text();
}

/// Who is not about as bright as console+full, one line each: it was lit by something else. Floors are not lit.
std::string brightness_notes(const Comparison& comparison) {
    const Result* ours = find(comparison, kConsole);
    std::string text;
    for (const Result& result : comparison.results) {
        const bool is_floor = result.contestant.ours && result.contestant.floor.empty();
        if (ours == nullptr || is_floor || result.refused || result.ms.empty()) continue;
        const double times = result.brightness / std::max(ours->brightness, 1e-3);
        if (times > 0.6 && times < 1.6)
            continue;  // tone curve against sRGB, one environment against its mean: 0.96..1.2
        text += fmt::format("look: {} is {:.2f} times as bright as {}; see {}\n", result.contestant.name, times,
                            kConsole, result.picture.string());
    }
    return text;
}

double noise(const Comparison& comparison) {
    return comparison.others_share.empty() ? 0.0 : spread(comparison.others_share).median;
}

nlohmann::json json_of(const Spread& value) {
    return {{"median", value.median}, {"p25", value.low}, {"p75", value.high}};
}

nlohmann::json json_of(const Comparison& comparison, const Result& result) {
    nlohmann::json value = {{"name", result.contestant.name},
                            {"driver", result.driver},
                            {"version", result.version},
                            {"lit_by", result.lit_by},
                            {"notices", result.notices},
                            {"covered", result.covered},
                            {"overlap", result.overlap},
                            {"brightness", result.brightness},
                            {"picture", result.picture.filename().string()}};
    if (result.refused) value["refused"] = *result.refused;
    if (result.ms.empty()) return value;
    value["frames_a_round"] = result.frames;
    value["ms"] = json_of(spread(result.ms));
    value["processor_ms"] = json_of(spread(result.processor_ms));
    value["rounds_ms"] = result.ms;
    value["rounds_processor_ms"] = result.processor_ms;
    for (const char* peer : {kThree, kFilament}) {
        const Result* other = find(comparison, peer);
        if (other == nullptr) continue;
        value["of"][peer] = json_of(ratio(result.ms, other->ms));
        value["processor_of"][peer] = json_of(ratio(result.processor_ms, other->processor_ms));
    }
    if (const Result* floor = find(comparison, result.contestant.floor)) {
        value["of"]["floor"] = json_of(ratio(result.ms, floor->ms));
    }
    if (const auto of = verdict(comparison, result)) {
        value["aim"] = {{"ms", of->target.ms}, {"by_floor", of->target.by_floor}, {"reached", of->reached}};
    }
    return value;
}

}  // namespace

std::string machine_text() {
    std::ifstream stream("/proc/cpuinfo");
    std::string model = "unknown processor";
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("model name")) model = line.substr(line.find(':') + 2);
    }
    utsname system{};
    uname(&system);
    return fmt::format("{} x {}, {} {}", sysconf(_SC_NPROCESSORS_ONLN), model, system.sysname, system.release);
}

std::string text_report(const Setting& setting, const std::vector<Comparison>& comparisons) {
    const CompareRequest& request = setting.request;
    std::string text = fmt::format("machine: {}\n", setting.machine);
    std::set<std::string> versions;
    for (const Comparison& comparison : comparisons) {
        for (const Result& result : comparison.results) {
            if (!result.version.empty()) versions.insert(fmt::format("{}, on {}", result.version, result.driver));
        }
    }
    for (const std::string& version : versions) text += fmt::format("renderer: {}\n", version);
    text += fmt::format(
        "{}x{}, a sun, two points, IBL, no shadow, no post but halfframe's own tone map; {} rounds, interleaved, each "
        "about {:.0f} ms of frames that end in a wait. Medians; ratios are medians of ratios within a round.\n",
        request.width, request.height, request.rounds, request.batch_ms);
    for (const std::string& notice : setting.notices) text += fmt::format("note: {}\n", notice);
    for (const Comparison& comparison : comparisons) {
        text += fmt::format("\n{}: {}; {} triangles in {} surfaces. Others used {:.1f} % of the processors{}.\n",
                            comparison.model.name, comparison.model.what, comparison.triangles, comparison.surfaces,
                            100.0 * noise(comparison),
                            noise(comparison) > kQuietShare ? ": NOISY, measure again on a quiet machine" : "");
        text += model_table(comparison) + brightness_notes(comparison);
        for (const Result& result : comparison.results) {
            if (result.refused) text += fmt::format("refused: {}\n", *result.refused);
        }
    }
    return text;
}

nlohmann::json json_report(const Setting& setting, const std::vector<Comparison>& comparisons) {
    nlohmann::json report = {{"schema_version", 1},
                             {"machine", setting.machine},
                             {"notices", setting.notices},
                             {"width", setting.request.width},
                             {"height", setting.request.height},
                             {"rounds", setting.request.rounds},
                             {"batch_ms", setting.request.batch_ms},
                             {"environment", setting.request.environment.filename().string()}};
    for (const Comparison& comparison : comparisons) {
        nlohmann::json value = {{"name", comparison.model.name},
                                {"what", comparison.model.what},
                                {"triangles", comparison.triangles},
                                {"surfaces", comparison.surfaces},
                                {"others_share", noise(comparison)}};
        for (const Result& result : comparison.results) value["renderers"].push_back(json_of(comparison, result));
        report["models"].push_back(value);
    }
    return report;
}

}  // namespace halfframe::peers
