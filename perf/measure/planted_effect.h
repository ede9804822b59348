// An effect that only a test has: it inserts what the test wants to see the rest of the house survive.
#pragma once

#include <span>
#include <vector>

#include "engine/frame/effect_card.h"

namespace halfframe::harness {

/// A card that every scene calls for and that makes `insertions`: a plain function, because cards carry nothing.
inline EffectCard planted_effect(std::span<const gl::Insertion> (*insertions)(const PlanContext&)) {
    return {.name = "planted",
            .purpose = "Plants what a test looks for.",
            .sources = "none",
            .kind = EffectKind::material,
            .called_for_by = "always",
            .budget_row = "",
            .tiers = {},
            .indispensable = "",
            .called_for =
                [](const PlanContext&) {
                    return Demand{true, "a test plants it"};
                },
            .add_passes = nullptr,
            .insertions = insertions,
            .prepare = nullptr};
}

/// Every effect of the build and `planted`, which must live as long as the list.
[[nodiscard]] inline std::vector<const EffectCard*> all_effects_and(const EffectCard& planted) {
    std::vector<const EffectCard*> cards(all_effects().begin(), all_effects().end());
    cards.push_back(&planted);
    return cards;
}

}  // namespace halfframe::harness
