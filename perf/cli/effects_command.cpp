// halfframe effects: the cards.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/frame/effect_card.h"
#include "perf/cli/command.h"
#include "perf/cli/terminal.h"
#include "perf/report/text_table.h"

namespace halfframe::cli {
namespace {

constexpr std::size_t kLineWidth = 118;

const char* name(EffectKind kind) { return kind == EffectKind::pass ? "pass" : "material"; }

std::string field(const char* title, std::string_view text, std::size_t indent) {
    return std::string(indent, ' ') +
           perf::wrapped(fmt::format("{}: {}", title, text), kLineWidth - indent, indent + 4) + "\n";
}

/// At 1280x720 in half arithmetic, by the table of prices; empty: the table has none.
std::string prices_text(const EffectCard& card, Tier tier, const CostTable& table) {
    constexpr double kMpixels720p = 0.9216;
    std::string text;
    for (const std::string& device : table.devices()) {
        const EffectPrice* price = table.find(card.name, tier, Arithmetic::half, device);
        if (price == nullptr) continue;
        const double ms = price->fixed_ms + price->ms_per_mpixel * kMpixels720p;
        text += fmt::format("{}{} {} ms ({}..{})", text.empty() ? "" : ", ", device, perf::ms_text(ms),
                            perf::ms_text(ms * price->least), perf::ms_text(ms * price->most));
    }
    return text;
}

std::string card_text(const EffectCard& card, const CostTable& table) {
    std::string text = std::string(card.name) + "\n";
    text += field("purpose", card.purpose, 2);
    text += field("kind", name(card.kind), 2);
    text += field("called for by", card.called_for_by, 2);
    text += field("budget row", card.budget_row, 2);
    text += field("sources", card.sources, 2);
    for (int index = 0; index < kTierCount; ++index) {
        const TierCard& tier = card.tiers[static_cast<std::size_t>(index)];
        text += fmt::format("  {}\n", halfframe::name(static_cast<Tier>(index)));
        text += field("seen", tier.eye, 4);
        text += field("writes", tier.targets, 4);
        if (const std::string prices = prices_text(card, static_cast<Tier>(index), table); !prices.empty())
            text += field("modelled, 1280x720, half", prices, 4);
        for (const ShaderVariant& variant : tier.shaders) {
            text += field("shader",
                          fmt::format("{} + {}{}{}", variant.vertex, variant.fragment,
                                      variant.defines.empty() ? "" : ", variants ", variant.defines),
                          4);
        }
    }
    return text;
}

nlohmann::ordered_json card_json(const EffectCard& card) {
    nlohmann::ordered_json tiers = nlohmann::ordered_json::array();
    for (int index = 0; index < kTierCount; ++index) {
        const TierCard& tier = card.tiers[static_cast<std::size_t>(index)];
        nlohmann::ordered_json shaders = nlohmann::ordered_json::array();
        for (const ShaderVariant& variant : tier.shaders) {
            shaders.push_back(
                {{"vertex", variant.vertex}, {"fragment", variant.fragment}, {"defines", variant.defines}});
        }
        tiers.push_back({{"tier", halfframe::name(static_cast<Tier>(index))},
                         {"eye", tier.eye},
                         {"targets", tier.targets},
                         {"shaders", shaders}});
    }
    return {{"name", card.name},
            {"purpose", card.purpose},
            {"kind", name(card.kind)},
            {"called_for_by", card.called_for_by},
            {"budget_row", card.budget_row},
            {"sources", card.sources},
            {"tiers", tiers}};
}

class EffectsCommand : public Command {
public:
    explicit EffectsCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "effects", "Lists the effects: purpose, what calls for them, and what each tier of them shows and costs");
        command.add_flag("--json", json_, "Standard output is one JSON value");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "effects"; }

    int run() override {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        std::string text;
        const CostTable table = content::cost_table();
        for (const EffectCard* card : all_effects()) {
            all.push_back(card_json(*card));
            text += (text.empty() ? "" : "\n") + card_text(*card, table);
        }
        if (json_) {
            print_json(all);
        } else {
            print(text);
        }
        return 0;
    }

private:
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_effects_command(CLI::App& app) { return std::make_unique<EffectsCommand>(app); }

}  // namespace halfframe::cli
