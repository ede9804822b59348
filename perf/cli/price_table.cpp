// Children count, this fits a line through two sizes.
#include "perf/cli/price_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/cli/cost_views.h"
#include "perf/cost/effect_table.h"
#include "perf/cost/model.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A night street, a room, translucents, and materials: what stands for scenes that are not known yet.
constexpr std::array kScenes = {"street", "test_room", "memory_room", "spheres", "lamps"};

struct Size {
    const char* words;
    double mpixels;
};
constexpr std::array kSizes = {Size{"640x360", 0.2304}, Size{"1280x720", 0.9216}};

/// Effect, tier, arithmetic, and whether it draws passes or only adds code to others'.
using Row = std::tuple<std::string, std::string, std::string, bool>;
/// A row and a device.
using Key = std::pair<Row, std::string>;
/// By view, the milliseconds at each size.
using Samples = std::map<std::string, std::array<double, kSizes.size()>>;

/// Four digits behind the point: less than any figure here means.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

/// Effects, tiers and views in the order they were counted.
struct Gathered {
    std::vector<Row> rows;
    std::vector<std::string> devices;
    std::map<Key, Samples> samples;
    Json views = Json::array();
};

template <typename List, typename Value>
void add_once(List& list, const Value& value) {
    if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

void gather(const Json& view, std::size_t size, Gathered& all) {
    const std::string scene = view.at("scene").get<std::string>(), camera = view.at("camera").get<std::string>();
    const std::string tier = view.at("tier").get<std::string>();
    Json kept{{"scene", scene}, {"camera", camera}, {"size", kSizes[size].words}, {"tier", tier}};
    for (const Json& device : view.at("devices")) {
        const std::string profile = device.at("profile").get<std::string>();
        add_once(all.devices, profile);
        kept[profile + "_ms"] = rounded(device.at("frame_ms").get<double>());
        for (const Json& effect : device.at("effects")) {
            const std::string name = effect.at("effect").get<std::string>();
            const bool passes = effect.at("passes").get<int>() > 0;
            for (const char* arithmetic : {"half", "full"}) {
                const Row row(name, tier, arithmetic, passes);
                add_once(all.rows, row);
                const char* key = *arithmetic == 'h' ? "ms" : "other_arithmetic_ms";
                all.samples[{row, profile}][scene + " " + camera][size] = effect.at(key).get<double>();
            }
        }
    }
    all.views.push_back(std::move(kept));
}

/// The mean over the views of the line through both sizes.
Json price_of(const Samples& samples) {
    double small_ms = 0.0, large_ms = 0.0;
    double least_ms = 1e30, most_ms = -1e30;
    for (const auto& [view, ms] : samples) {
        small_ms += ms[0] / static_cast<double>(samples.size());
        large_ms += ms[1] / static_cast<double>(samples.size());
        least_ms = std::min(least_ms, ms[1]);
        most_ms = std::max(most_ms, ms[1]);
    }
    const double slope = (large_ms - small_ms) / (kSizes[1].mpixels - kSizes[0].mpixels);
    const bool any = large_ms > 1e-6;
    return {{"fixed_ms", rounded(large_ms - slope * kSizes[1].mpixels)},
            {"ms_per_mpixel", rounded(slope)},
            {"least", any ? std::clamp(rounded(least_ms / large_ms), 0.0, 1.0) : 1.0},
            {"most", any ? std::max(rounded(most_ms / large_ms), 1.0) : 1.0}};
}

Json row_of(const Row& row, const Gathered& all) {
    const auto& [effect, tier, arithmetic, passes] = row;
    Json devices = Json::object();
    std::size_t views = 0;
    for (const std::string& device : all.devices) {
        const Samples& samples = all.samples.at({row, device});
        devices[device] = price_of(samples);
        views = samples.size();
    }
    return {{"effect", effect}, {"tier", tier},   {"arithmetic", arithmetic},
            {"passes", passes}, {"views", views}, {"devices", devices}};
}

std::string lines_of(const Json& rows) {
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i)
        text += "    " + rows[i].dump() + (i + 1 < rows.size() ? ",\n" : "\n");
    return text;
}

}  // namespace

std::string price_table(const std::string& effects, int jobs, const std::string& cache,
                        const std::function<void(const std::string&)>& between) {
    std::vector<std::vector<std::string>> children;
    std::vector<std::size_t> sizes;
    for (const char* scene : kScenes) {
        for (std::size_t size = 0; size < kSizes.size(); ++size) {
            children.push_back({"cost", scene, "--all-cameras", "--tiers", "low,console,reference", "--size",
                                kSizes[size].words, "--jobs", "1", "--budget", "none", "--json"});
            if (!cache.empty()) children.back().insert(children.back().end(), {"--cache", cache});
            sizes.push_back(size);
        }
    }
    Gathered all;
    for (std::size_t done = 0; done < children.size();) {
        const std::size_t end = std::min(children.size(), done + static_cast<std::size_t>(jobs));
        const auto step = [&](const std::string&) {
            between(fmt::format("counting the built-in scenes, {} of {}", done + 1, children.size()));
        };
        const ChildOutputs made = outputs_of_own(
            {children.begin() + static_cast<std::ptrdiff_t>(done), children.begin() + static_cast<std::ptrdiff_t>(end)},
            step);
        for (std::size_t i = done; i < end; ++i)
            for (const Json& view : Json::parse(made.outputs[i - done])) gather(view, sizes[i], all);
        done = end;
    }
    Json rows = Json::array();
    for (const auto& row : all.rows) rows.push_back(row_of(row, all));
    return fmt::format(
        "{{\n  \"model_version\": {},\n  \"compiler\": {},\n  \"counts\": \"{}\",\n  \"views\": [\n{}  ],\n"
        "  \"prices\": [\n{}  ]\n}}\n",
        cost::kModelVersion, Json(shader_ir::compiler_versions()).dump(), cost::counts_fingerprint(effects),
        lines_of(all.views), lines_of(rows));
}

}  // namespace halfframe::cli
