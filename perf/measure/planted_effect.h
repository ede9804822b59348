// An effect that no build has: it inserts code to see what the rest of the house makes of it.
#pragma once

#include <span>
#include <vector>

#include "engine/frame/effect_card.h"

namespace halfframe::perf {

/// A card that every scene calls for and that makes `insertions`: a plain function, because cards carry nothing.
inline EffectCard planted_effect(std::span<const gl::Insertion> (*insertions)(const PlanContext&)) {
    return {.name = "planted",
            .purpose = "Inserts code to see what becomes of it.",
            .sources = "none",
            .kind = EffectKind::material,
            .called_for_by = "always",
            .budget_row = "",
            .tiers = {},
            .indispensable = "",
            .called_for =
                [](const PlanContext&) {
                    return Demand{true, "it is planted"};
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

}  // namespace halfframe::perf
