// Prices of a plan, and the tiers that fit a frame budget.
#include "engine/frame/cost_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe {

const EffectPrice* CostTable::find(std::string_view effect, Tier tier, Arithmetic arithmetic, std::string_view device,
                                   std::optional<bool> passes) const {
    const auto found = std::ranges::find_if(prices, [&](const EffectPrice& price) {
        return price.effect == effect && price.tier == tier && price.arithmetic == arithmetic &&
               price.device == device && price.passes == passes.value_or(price.passes);
    });
    return found != prices.end() ? &*found : nullptr;
}

std::vector<std::string> CostTable::devices() const {
    std::vector<std::string> names;
    for (const EffectPrice& price : prices)
        if (std::ranges::find(names, price.device) == names.end()) names.push_back(price.device);
    return names;
}

double FrameEstimate::ms() const {
    double sum = 0.0;
    for (const EffectEstimate& effect : effects) sum += effect.ms;
    return sum;
}

double FrameEstimate::least_ms() const {
    double sum = 0.0;
    for (const EffectEstimate& effect : effects) sum += effect.least_ms;
    return sum;
}

double FrameEstimate::most_ms() const {
    double sum = 0.0;
    for (const EffectEstimate& effect : effects) sum += effect.most_ms;
    return sum;
}

const EffectEstimate* FrameEstimate::find(std::string_view effect) const {
    const auto found = std::ranges::find(effects, effect, &EffectEstimate::effect);
    return found != effects.end() ? &*found : nullptr;
}

FrameEstimate estimate_frame(const FramePlan& plan, const CostTable& table, std::string_view device,
                             Arithmetic arithmetic) {
    const std::vector<std::string> devices = table.devices();
    if (std::ranges::find(devices, device) == devices.end()) {
        std::string list;
        for (const std::string& one : devices) list += (list.empty() ? "" : ", ") + one;
        throw Error(Fault::usage, fmt::format("the cost table has no device called {}; it has {}", device, list));
    }
    FrameEstimate estimate{.device = std::string(device), .arithmetic = arithmetic};
    const double mpixels = static_cast<double>(plan.width) * static_cast<double>(plan.height) * 1e-6;
    for (const EffectDecision& decision : plan.effects) {
        if (!decision.in) continue;
        EffectEstimate effect{.effect = decision.effect, .tier = decision.tier};
        const bool passes = std::ranges::find(plan.passes, decision.effect, &Pass::effect) != plan.passes.end();
        if (const EffectPrice* price = table.find(decision.effect, decision.tier, arithmetic, device, passes)) {
            effect.priced = true;
            effect.ms = std::max(0.0, price->fixed_ms + price->ms_per_mpixel * mpixels);
            effect.least_ms = effect.ms * price->least;
            effect.most_ms = effect.ms * price->most;
        }
        estimate.effects.push_back(std::move(effect));
    }
    return estimate;
}

namespace {

/// What a tier is worth to the eye: low gives up techniques, reference refines what console has already.
constexpr std::array<int, kTierCount> kWorth = {0, 10, 11};

int worth(Tier tier) { return kWorth[static_cast<std::size_t>(tier)]; }

int worth(const FramePlan& plan) {
    int sum = 0;
    for (const EffectDecision& decision : plan.effects) sum += decision.in ? worth(decision.tier) : 0;
    return sum;
}

/// Searches tiers for one frame tier. Plans that cannot be made, or break a rule, are no choices.
class Search {
public:
    Search(const FrameBudget& budget, const CostTable& table, const Scene& scene, const View& view,
           const Wishes& wishes, const gl::Caps& caps, std::span<const EffectCard* const> cards)
        : budget_(budget), table_(table), scene_(scene), view_(view), wished_(wishes), caps_(caps), cards_(cards) {}

    /// Nothing: no plan of this tier can be made here.
    std::optional<BudgetedTiers> at(Tier tier) {
        Wishes wishes = wished_;
        wishes.tier = tier;
        std::optional<BudgetedTiers> best = tried(wishes);
        if (!best) return std::nullopt;
        std::vector<Step> given_up;
        while (!best->fits) {
            std::optional<BudgetedTiers> cheaper = cheapest_step(*best, given_up);
            if (!cheaper) return best;
            best = std::move(cheaper);
        }
        take_back(*best, given_up);
        return best;
    }

    [[nodiscard]] const std::string& first_obstacle() const { return first_obstacle_; }

private:
    struct Step {
        std::string effect;
        Tier from;
        Tier to;
    };

    [[nodiscard]] double allowed_ms() const { return budget_.ms * (1.0 - budget_.margin); }

    [[nodiscard]] std::optional<BudgetedTiers> tried(const Wishes& wishes) const {
        try {
            BudgetedTiers made{.wishes = wishes, .plan = plan_frame(scene_, view_, wishes, caps_, cards_)};
            if (broken_rule(made.plan, caps_)) return std::nullopt;
            made.estimate = estimate_frame(made.plan, table_, budget_.device, budget_.arithmetic);
            made.fits = made.estimate.ms() <= allowed_ms();
            return made;
        } catch (const Error& error) {
            if (error.fault() != Fault::usage) throw;
            first_obstacle_ = first_obstacle_.empty() ? error.what() : first_obstacle_;
            return std::nullopt;
        }
    }

    [[nodiscard]] bool wished_by_name(const std::string& effect) const {
        return std::ranges::any_of(wished_.effect_tiers, [&](const auto& one) { return one.first == effect; });
    }

    static Wishes with(Wishes wishes, const std::string& effect, Tier tier) {
        std::erase_if(wishes.effect_tiers, [&](const auto& one) { return one.first == effect; });
        if (wishes.tier != tier) wishes.effect_tiers.emplace_back(effect, tier);
        return wishes;
    }

    std::optional<BudgetedTiers> cheapest_step(const BudgetedTiers& from, std::vector<Step>& given_up) const {
        std::optional<BudgetedTiers> best;
        Step taken;
        double most_saved = 0.0;  // [ms] for each point of worth
        for (const EffectEstimate& effect : from.estimate.effects) {
            if (effect.tier == Tier::low || wished_by_name(effect.effect)) continue;
            const Step step{effect.effect, effect.tier, static_cast<Tier>(static_cast<int>(effect.tier) - 1)};
            std::optional<BudgetedTiers> one = tried(with(from.wishes, step.effect, step.to));
            if (!one) continue;
            const double saved = (from.estimate.ms() - one->estimate.ms()) / (worth(step.from) - worth(step.to));
            if (saved <= most_saved) continue;
            most_saved = saved;
            best = std::move(one);
            taken = step;
        }
        if (!best) return best;
        best->steps = from.steps;
        best->steps.push_back(fmt::format("{} from {} to {} saves {:.2f} ms", taken.effect, name(taken.from),
                                          name(taken.to), from.estimate.ms() - best->estimate.ms()));
        given_up.push_back(taken);
        return best;
    }

    void take_back(BudgetedTiers& best, const std::vector<Step>& given_up) const {
        for (auto step = given_up.rbegin(); step != given_up.rend(); ++step) {
            const EffectDecision* now = best.plan.find(step->effect);
            if (now == nullptr || now->tier != step->to) continue;
            std::optional<BudgetedTiers> back = tried(with(best.wishes, step->effect, step->from));
            if (!back || !back->fits) continue;
            back->steps = best.steps;
            back->steps.push_back(fmt::format("{} back to {}: it fits after all", step->effect, name(step->from)));
            best = std::move(*back);
        }
    }

    const FrameBudget& budget_;
    const CostTable& table_;
    const Scene& scene_;
    const View& view_;
    const Wishes& wished_;
    const gl::Caps& caps_;
    std::span<const EffectCard* const> cards_;
    mutable std::string first_obstacle_;  // why the first plan that could not be made could not
};

}  // namespace

BudgetedTiers budgeted_tiers(const FrameBudget& budget, const CostTable& table, const Scene& scene, const View& view,
                             const Wishes& wishes, const gl::Caps& caps, std::span<const EffectCard* const> cards) {
    if (!(budget.ms > 0.0) || !std::isfinite(budget.ms) || !(budget.margin >= 0.0 && budget.margin < 1.0))
        throw Error(Fault::usage, fmt::format("a frame budget of {} ms with a margin of {}: milliseconds above 0, and "
                                              "a share from 0 to below 1",
                                              budget.ms, budget.margin));
    Search search(budget, table, scene, view, wishes, caps, cards);
    std::optional<BudgetedTiers> best, cheapest;
    std::vector<std::string> misses;
    for (int tier = static_cast<int>(wishes.tier.value_or(Tier::reference)); tier >= 0; --tier) {
        std::optional<BudgetedTiers> found = search.at(static_cast<Tier>(tier));
        if (!found) continue;
        if (!found->fits) {
            misses.push_back(fmt::format("no choice at frame tier {} fits {:.2f} ms: {:.2f} ms at best",
                                         name(static_cast<Tier>(tier)), budget.ms, found->estimate.ms()));
            if (!cheapest || found->estimate.ms() < cheapest->estimate.ms()) cheapest = std::move(found);
        } else if (!best || worth(found->plan) > worth(best->plan) ||
                   (worth(found->plan) == worth(best->plan) && found->estimate.ms() < best->estimate.ms())) {
            best = std::move(found);
        }
    }
    if (!best && !cheapest)
        throw Error(Fault::usage, search.first_obstacle().empty() ? "no tier can be planned on this device"
                                                                  : search.first_obstacle());
    BudgetedTiers chosen = best ? *std::move(best) : *std::move(cheapest);
    chosen.steps.insert(chosen.steps.begin(), misses.begin(), misses.end());
    return chosen;
}

}  // namespace halfframe
