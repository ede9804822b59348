// Storage and whole frames in words and in JSON: what only a context can show.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/accuracy/accuracy_report.h"
#include "perf/report/text_table.h"

namespace halfframe::accuracy {
namespace {

using perf::Align;
using Json = nlohmann::ordered_json;

constexpr const char* kChannels[] = {"red", "green", "blue"};

const char* name(Relation relation) { return relation == Relation::same ? "same" : "never darker"; }

/// "0", or the largest error in codes and the share of pixels that have one.
std::string distance_text(const FrameAccuracy& frame) {
    if (frame.max_channel_error == 0) return "0";
    return fmt::format("{} / {:.2f} %", frame.max_channel_error, 100.0 * frame.bad_fraction);
}

/// Every bound that is not 0, once, with the pairs it is for.
std::string bounds_text(const std::vector<FrameAccuracy>& frames) {
    std::vector<std::pair<std::string, std::string>> bounds;  // text, pairs
    for (const FrameAccuracy& frame : frames) {
        if (frame.bound.max_channel_error == 0) continue;
        const std::string text = fmt::format("  {} / {:.2f} %: {}\n", frame.bound.max_channel_error,
                                             100.0 * frame.bound.max_bad_fraction, frame.bound.reason);
        const std::string pair = fmt::format("      {} ({})\n", frame.change, halfframe::name(frame.arithmetic));
        auto known = std::ranges::find(bounds, text, &std::pair<std::string, std::string>::first);
        if (known == bounds.end()) known = bounds.insert(bounds.end(), {text, ""});
        if (known->second.find(pair) == std::string::npos) known->second += pair;
    }
    std::string all;
    for (const auto& [text, pairs] : bounds) all += text + pairs;
    return all;
}

bool same_pair(const FrameAccuracy& a, const FrameAccuracy& b) { return a.kind == b.kind && a.change == b.change; }

}  // namespace

std::string storage_text(const std::vector<StorageAccuracy>& storage) {
    perf::TextTable table({{"scene_color", Align::left},
                           {"stored", Align::left},
                           {"largest", Align::right},
                           {"p99", Align::right},
                           {"mean", Align::right},
                           {"at a light of", Align::right},
                           {"channel", Align::left},
                           {"bound", Align::right},
                           {"", Align::left}});
    std::string reasons;
    for (const StorageAccuracy& row : storage) {
        if (!row.missing.empty()) {
            table.add_row({gl::name(row.format), name(row.source), "-", "-", "-", "-", "-", "-", row.missing});
            continue;
        }
        table.add_row({gl::name(row.format), name(row.source), fmt::format("{:.2g}", row.largest),
                       fmt::format("{:.2g}", row.p99), fmt::format("{:+.2g}", row.mean),
                       fmt::format("{:.3g}", row.worst_light), kChannels[row.worst_channel],
                       fmt::format("{:.3g}", row.bound.at_most), row.violations.empty() ? "holds" : "exceeded"});
        reasons += fmt::format("  {} of {}: {}\n", gl::name(row.format), name(row.source), row.bound.reason);
    }
    return "Storage: what writing light to scene_color and reading it back does to the display, in codes of 255, in "
           "highp.\n\n" +
           table.text() + (reasons.empty() ? "" : "\nBounds\n" + reasons);
}

nlohmann::ordered_json storage_json(const std::vector<StorageAccuracy>& storage) {
    Json all = Json::array();
    for (const StorageAccuracy& row : storage) {
        Json json{{"format", gl::name(row.format)}, {"stored", name(row.source)}, {"unit", "codes"}};
        if (row.missing.empty()) {
            json.update({{"lanes", row.lanes},
                         {"largest", row.largest},
                         {"p99", row.p99},
                         {"mean", row.mean},
                         {"worst_light", row.worst_light},
                         {"worst_channel", kChannels[row.worst_channel]},
                         {"not_finite", row.not_finite},
                         {"bound", row.bound.at_most},
                         {"bound_reason", row.bound.reason},
                         {"violations", row.violations}});
        } else {
            json["missing"] = row.missing;
        }
        all.push_back(json);
    }
    return all;
}

std::string depth_text(const std::vector<DepthAccuracy>& depth) {
    perf::TextTable table({{"depth", Align::left},
                           {"largest", Align::right},
                           {"p99", Align::right},
                           {"of the distance", Align::right},
                           {"at [m]", Align::right},
                           {"near [m]", Align::right},
                           {"surface apart", Align::right},
                           {"bounds", Align::left}});
    std::string reasons;
    for (const DepthAccuracy& row : depth) {
        if (!row.missing.empty()) {
            table.add_row({gl::name(row.format), "-", "-", "-", "-", "-", "-", row.missing});
            continue;
        }
        table.add_row({gl::name(row.format), fmt::format("{:.2g}", row.largest), fmt::format("{:.2g}", row.p99),
                       fmt::format("{:.2g}", row.of_distance), fmt::format("{:.3g}", row.worst_m),
                       fmt::format("{:g}", row.worst_near_m), std::to_string(row.apart),
                       row.violations.empty() ? "hold" : "exceeded"});
        reasons += fmt::format("  {} of {:g} steps: {}\n  {} of {:g} of the distance: {}\n", gl::name(row.format),
                               row.bound.at_most, row.bound.reason, gl::name(row.format), row.distance_bound.at_most,
                               row.distance_bound.reason);
    }
    return "Depth: what storing it costs, in steps of the format; how far the distance that is stored is from the one "
           "in\ndouble, at its worst; and in how many places surface.vert writes another depth than "
           "depth_prepass.\n\n" +
           table.text() + (reasons.empty() ? "" : "\nBounds\n" + reasons);
}

nlohmann::ordered_json depth_json(const std::vector<DepthAccuracy>& depth) {
    Json all = Json::array();
    for (const DepthAccuracy& row : depth) {
        Json json{{"format", gl::name(row.format)}, {"unit", "steps"}};
        if (row.missing.empty()) {
            json.update({{"lanes", row.lanes},
                         {"largest", row.largest},
                         {"p99", row.p99},
                         {"of_distance", row.of_distance},
                         {"worst_m", row.worst_m},
                         {"worst_near_m", row.worst_near_m},
                         {"surface_apart", row.apart},
                         {"bound", row.bound.at_most},
                         {"bound_reason", row.bound.reason},
                         {"of_distance_bound", row.distance_bound.at_most},
                         {"of_distance_bound_reason", row.distance_bound.reason},
                         {"violations", row.violations}});
        } else {
            json["missing"] = row.missing;
        }
        all.push_back(json);
    }
    return all;
}

std::string frames_text(const std::vector<FrameAccuracy>& frames) {
    std::vector<perf::TextTable::Column> columns{{"kind", Align::left}, {"change", Align::left}};
    for (const FrameAccuracy& frame : frames) {
        if (!same_pair(frame, frames.front())) break;
        columns.push_back(
            {fmt::format("{} {}", halfframe::name(frame.tier), halfframe::name(frame.arithmetic)), Align::right});
    }
    columns.push_back({"not finite", Align::right});
    columns.push_back({"bounds", Align::left});
    perf::TextTable table(columns);
    for (auto first = frames.begin(); first != frames.end();) {
        const auto last =
            std::find_if_not(first, frames.end(), [&](const auto& row) { return same_pair(row, *first); });
        std::vector<std::string> cells{first->kind, first->change};
        std::uint64_t not_finite = 0;
        bool holds = true;
        for (auto row = first; row != last; ++row) {
            cells.push_back(distance_text(*row));
            not_finite += row->not_finite;
            holds = holds && row->violations.empty();
        }
        cells.push_back(std::to_string(not_finite));
        cells.push_back(holds ? "hold" : "exceeded");
        table.add_row(cells);
        first = last;
    }
    return "Frames: a scene drawn twice, the second time changed. Largest channel error of 255, and the share of "
           "pixels\nthat differ at all; 0: to the bit. Where light is added, only what got darker counts. not finite: "
           "NaN and inf in\nevery colour target, drawn once more as RGBA32F.\n\n" +
           table.text() + "\nBounds that are not 0, and what they are for\n" + bounds_text(frames);
}

nlohmann::ordered_json frames_json(const std::vector<FrameAccuracy>& frames) {
    Json all = Json::array();
    for (const FrameAccuracy& frame : frames) {
        all.push_back({{"kind", frame.kind},
                       {"change", frame.change},
                       {"relation", name(frame.relation)},
                       {"tier", halfframe::name(frame.tier)},
                       {"arithmetic", halfframe::name(frame.arithmetic)},
                       {"storage", gl::name(frame.storage)},
                       {"max_channel_error", frame.max_channel_error},
                       {"bad_fraction", frame.bad_fraction},
                       {"covered", frame.covered},
                       {"not_finite", frame.not_finite},
                       {"census_values", frame.census_values},
                       {"max_channel_error_bound", frame.bound.max_channel_error},
                       {"max_bad_fraction", frame.bound.max_bad_fraction},
                       {"bound_reason", frame.bound.reason},
                       {"violations", frame.violations}});
    }
    return all;
}

}  // namespace halfframe::accuracy
