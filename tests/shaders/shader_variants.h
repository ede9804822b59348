// Every program that the cards of the effects can ask for, and the few that belong to no effect.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/frame/effect_card.h"
#include "engine/frame/tier.h"
#include "engine/gl/program.h"
#include "tests/shaders/glslang_gate.h"

namespace halfframe::shaders {

struct NamedProgram {
    std::string name;  ///< effect, tier, arithmetic, highp, defines, insertions
    gl::ProgramDescription description;
};

/// The program as the compiler gets it.
[[nodiscard]] ProgramTexts texts_of(const NamedProgram& program);

/// Every variant of `tier` of every card: without defines, with each alone, with all, and with all but each; in half
/// and full arithmetic; half also without fragment highp at low; each without and with what other effects insert.
[[nodiscard]] std::vector<NamedProgram> every_variant(Tier tier,
                                                      std::span<const EffectCard* const> cards = all_effects());

/// What effects add to the shaders of others: every answer of every card over the built-in scenes and the storages.
[[nodiscard]] std::vector<std::vector<gl::Insertion>> every_insertion_set(Tier tier,
                                                                          std::span<const EffectCard* const> cards);

/// Programs whose two stages lie beside each other in shaders_es and that no card names (timing calibration, probes),
/// in both dialects.
[[nodiscard]] std::vector<NamedProgram> programs_without_card(std::span<const EffectCard* const> cards = all_effects());

/// Stage files (.vert, .frag) that neither a card nor a pair of files reaches: nothing would ever compile them.
[[nodiscard]] std::vector<std::string> unreached_stage_files(std::span<const EffectCard* const> cards = all_effects());

}  // namespace halfframe::shaders
