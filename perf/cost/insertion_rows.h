// What material effects add to the shaders of others, at every tier: gathered from the built-in scenes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/frame/effect_card.h"

namespace halfframe::cost {

/// One effect's code in one shader of another effect.
struct InsertionRow {
    const EffectCard* effect = nullptr;
    const EffectCard* host = nullptr;
    ShaderVariant variant;  ///< of the host
    std::vector<gl::Insertion> insertions;
};

/// By tier, every effect that adds code, with each host program that it goes into, in the order of the cards. Of the
/// answers that the built-in scenes get, the longest: the most that the effect adds.
[[nodiscard]] std::array<std::vector<InsertionRow>, kTierCount> insertion_rows();

}  // namespace halfframe::cost
