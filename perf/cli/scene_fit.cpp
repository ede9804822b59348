// Prices of a plan for people, and tiers that fit.
#include "perf/cli/scene_fit.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "perf/cli/spelling.h"
#include "perf/report/text_table.h"

namespace halfframe::cli {
namespace {

constexpr double kLongest_ms = 1e6;
constexpr std::size_t kLineWidth = 118;

}  // namespace

FrameBudget parse_fit(const std::string& words, Arithmetic arithmetic) {
    FrameBudget budget{.arithmetic = arithmetic};
    const std::size_t equals = words.find('=');
    budget.device = words.substr(0, equals);
    const std::vector<std::string> devices = content::cost_table().devices();
    if (std::find(devices.begin(), devices.end(), budget.device) == devices.end())
        throw Error(Fault::usage, unknown("device in --fit", budget.device, devices));
    if (equals == std::string::npos) return budget;
    const char* end = words.data() + words.size();
    const auto [stop, error] = std::from_chars(words.data() + equals + 1, end, budget.ms);
    if (error != std::errc() || stop != end || !(budget.ms > 0.0 && budget.ms <= kLongest_ms))
        throw Error(Fault::usage,
                    fmt::format("--fit {}: write DEVICE=MS, milliseconds above 0, for example ps3=33.3", words));
    return budget;
}

std::string tiers_text(const Wishes& wishes) {
    std::string text = wishes.tier ? fmt::format("--tier {}", name(*wishes.tier)) : "";
    for (const auto& [effect, tier] : wishes.effect_tiers)
        text += fmt::format("{}--tier {}={}", text.empty() ? "" : " ", effect, name(tier));
    return text;
}

void fit_to_budget(OpenedScene& opened, const SceneOptions& options, const gl::Caps& caps) {
    if (options.fit.empty()) return;
    const Arithmetic arithmetic = options.arithmetic == "full" ? Arithmetic::full : Arithmetic::half;
    const FrameBudget budget = parse_fit(options.fit, arithmetic);
    const BudgetedTiers chosen =
        budgeted_tiers(budget, content::cost_table(), opened.scene, opened.view, opened.wishes, caps, all_effects());
    opened.wishes = chosen.wishes;
    std::string steps;
    for (const std::string& step : chosen.steps) steps += "; " + step;
    opened.scene.notices.push_back(
        fmt::format("--fit {}: {} an estimated {:.2f} of {:.2f} ms ({:.2f}..{:.2f}) with {}{}", options.fit,
                    chosen.fits ? "fits," : "DOES NOT FIT,", chosen.estimate.ms(), budget.ms,
                    chosen.estimate.least_ms(), chosen.estimate.most_ms(), tiers_text(chosen.wishes), steps));
}

std::string estimate_text(const FramePlan& plan, const CostTable& table, Arithmetic arithmetic) {
    using perf::Align;
    using perf::ms_text;
    std::vector<FrameEstimate> estimates;
    std::vector<perf::TextTable::Column> columns{{"estimate"}, {"tier"}};
    for (const std::string& device : table.devices()) {
        estimates.push_back(estimate_frame(plan, table, device, arithmetic));
        columns.push_back({device + " ms", Align::right});
        columns.push_back({"views"});
    }
    if (estimates.empty()) return "no cost table: nothing is estimated\n";
    perf::TextTable text(columns);
    const auto band = [](double least_ms, double most_ms) { return ms_text(least_ms) + ".." + ms_text(most_ms); };
    for (std::size_t i = 0; i < estimates.front().effects.size(); ++i) {
        const EffectEstimate& effect = estimates.front().effects[i];
        std::vector<std::string> row{effect.effect, name(effect.tier)};
        for (const FrameEstimate& estimate : estimates) {
            const EffectEstimate& here = estimate.effects[i];
            row.push_back(here.priced ? ms_text(here.ms) : "-");
            row.push_back(here.priced ? band(here.least_ms, here.most_ms) : "not in the table");
        }
        text.add_row(row);
    }
    text.add_rule();
    std::vector<std::string> total{"frame", ""};
    for (const FrameEstimate& estimate : estimates) {
        total.push_back(ms_text(estimate.ms()));
        total.push_back(band(estimate.least_ms(), estimate.most_ms()));
    }
    text.add_row(total);
    return text.text() +
           perf::wrapped(
               fmt::format("Modelled milliseconds of these effects in the built-in scenes (model version {}, "
                           "{} arithmetic), the middle of the views and the cheapest to the dearest; halfframe "
                           "cost counts this scene. Effects share passes, so an effect's own figure here holds "
                           "what it adds to others.",
                           table.model_version, name(arithmetic)),
               kLineWidth, 0) +
           "\n";
}

nlohmann::ordered_json estimate_json(const FramePlan& plan, const CostTable& table, Arithmetic arithmetic) {
    using Json = nlohmann::ordered_json;
    Json devices = Json::array();
    for (const std::string& device : table.devices()) {
        const FrameEstimate estimate = estimate_frame(plan, table, device, arithmetic);
        Json effects = Json::array();
        for (const EffectEstimate& effect : estimate.effects) {
            const auto figure = [&](double ms) { return effect.priced ? Json(ms) : Json(nullptr); };
            effects.push_back({{"effect", effect.effect},
                               {"tier", name(effect.tier)},
                               {"ms", figure(effect.ms)},
                               {"least_ms", figure(effect.least_ms)},
                               {"most_ms", figure(effect.most_ms)}});
        }
        devices.push_back({{"device", device},
                           {"arithmetic", name(arithmetic)},
                           {"model_version", table.model_version},
                           {"ms", estimate.ms()},
                           {"least_ms", estimate.least_ms()},
                           {"most_ms", estimate.most_ms()},
                           {"effects", effects}});
    }
    return devices;
}

}  // namespace halfframe::cli
