// What effects cost on devices that are not here, as data: the cost model makes it, content/costs keeps it, plans read
// it. Nothing here computes a model; a price is what the model said of the built-in scenes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/frame_plan.h"
#include "engine/frame/tier.h"

namespace halfframe {

/// An effect at a tier on one device: the middle of the views of the built-in scenes that call for it, with what it
/// adds to others' passes. [ms] = fixed_ms + ms_per_mpixel x pixels / 1e6, between 640x360 and 1280x720 as counted.
struct EffectPrice {
    std::string effect;
    Tier tier = Tier::console;
    Arithmetic arithmetic = Arithmetic::half;
    std::string device;  ///< "ps3", "x360", "es2_class"
    bool passes = true;  ///< of views where it draws passes; false: it only adds code to others' (tone_map without light)
    double fixed_ms = 0.0;
    double ms_per_mpixel = 0.0;
    double least = 1.0;  ///< the cheapest view over the middle, at 1280x720
    double most = 1.0;   ///< the dearest
    int views = 0;       ///< counted
};

struct CostTable {
    int model_version = 0;
    std::string compiler;  ///< that the counts drift with
    std::vector<EffectPrice> prices;
    /// `passes` empty: the first form that the table has.
    [[nodiscard]] const EffectPrice* find(std::string_view effect, Tier tier, Arithmetic arithmetic,
                                          std::string_view device, std::optional<bool> passes = {}) const;
    [[nodiscard]] std::vector<std::string> devices() const;  ///< in the order of the table
};

struct EffectEstimate {
    std::string effect;
    Tier tier = Tier::console;
    bool priced = false;  ///< false: no built-in scene calls for it at this tier, so it counts as nothing
    double ms = 0.0;
    double least_ms = 0.0;  ///< in the cheapest counted view
    double most_ms = 0.0;
};

/// Modelled milliseconds of a plan before anything is drawn. An estimate: how much of the picture an effect covers is
/// that of the built-in scenes, not of this one; halfframe cost counts this one.
struct FrameEstimate {
    std::string device;
    Arithmetic arithmetic = Arithmetic::half;
    std::vector<EffectEstimate> effects;  ///< those in the plan, in its order
    [[nodiscard]] double ms() const;
    [[nodiscard]] double least_ms() const;
    [[nodiscard]] double most_ms() const;
    [[nodiscard]] const EffectEstimate* find(std::string_view effect) const;
};

/// Pure. `arithmetic` is the priced one, whatever the plan runs in here: a software driver runs full, a console half. A
/// device that the table does not have: Error(usage) with those it has.
[[nodiscard]] FrameEstimate estimate_frame(const FramePlan& plan, const CostTable& table, std::string_view device,
                                           Arithmetic arithmetic = Arithmetic::half);

/// A frame budget that a plan is to fit.
struct FrameBudget {
    std::string device = "ps3";
    double ms = 33.3;
    Arithmetic arithmetic = Arithmetic::half;
    double margin = 0.0;  ///< share of `ms` that is kept free for what the table cannot know, 0 to below 1
};

/// The tiers that were chosen for a frame budget.
struct BudgetedTiers {
    Wishes wishes;  ///< what was wished, with a tier for the frame and for each effect that differs from it
    FramePlan plan;
    FrameEstimate estimate;
    bool fits = false;               ///< false: even the cheapest tiers are over; these are they
    std::vector<std::string> steps;  ///< one sentence for each tier that was given up, in order
};

/// The best tiers that fit. For each tier of the frame (its storage), from the wished one down, or from reference:
/// every effect begins there and gives up tiers one step at a time, each time the step that saves most for what it is
/// worth, until the estimate fits; then whatever fits again is taken back, latest first. Of the frame tiers that fit,
/// the one whose effects keep most is taken, then the cheapest. A step from console to low weighs as much as ten
/// from reference to console: a technique is worth more than its refinement. Tiers of `wishes.effect_tiers` stay.
/// Greedy: it may miss a better choice by a step; the same arguments give the same answer. Errors as plan_frame() and
/// estimate_frame(); Error(usage) for a budget that is no positive number.
[[nodiscard]] BudgetedTiers budgeted_tiers(const FrameBudget& budget, const CostTable& table, const Scene& scene,
                                           const View& view, const Wishes& wishes, const gl::Caps& caps,
                                           std::span<const EffectCard* const> cards);

}  // namespace halfframe
