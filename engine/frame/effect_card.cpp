// Turns a card's variant into a program description; finds cards by name.
#include "engine/frame/effect_card.h"

#include <algorithm>
#include <vector>

#include "engine/error.h"
#include "engine/frame/vertex_layout.h"

namespace halfframe {

void EffectWork::draw(Renderer&, const View&, int) { throw Mistake("an effect without passes was asked to draw one"); }

bool EffectWork::still_holds(const Renderer&, const View&, int) const { return false; }

int EffectWork::adopt(Renderer&, gl::Program&) { return -1; }

void EffectWork::feed(Renderer&, const View&, int) {}

void EffectWork::feed_material(Renderer&, int, int) {}

namespace {

bool lists_word(std::string_view words, std::string_view word) {
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (words.substr(0, end) == word) return true;
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

const char* tier_define(Tier tier) {
    switch (tier) {
        case Tier::low: return "TIER_LOW";
        case Tier::console: return "TIER_CONSOLE";
        case Tier::reference: return "TIER_REFERENCE";
    }
    throw Mistake("a tier without a define");
}

}  // namespace

gl::ProgramDescription describe_variant(const EffectCard& card, const ShaderVariant& variant, Tier tier,
                                        Arithmetic arithmetic, bool fragment_highp,
                                        std::span<const std::string_view> defines) {
    gl::ProgramDescription description;
    description.name = card.name;
    description.vertex = variant.vertex;
    description.fragment = variant.fragment;
    description.dialect = tier == Tier::low ? gl::Dialect::es100 : gl::Dialect::es300;
    description.arithmetic = arithmetic;
    description.fragment_highp = fragment_highp;
    description.defines.emplace_back(tier_define(tier), "1");
    for (const std::string_view define : defines) {
        expect(lists_word(variant.defines, define), [&] {
            return "the card of " + std::string(card.name) + " does not list the define " + std::string(define) +
                   " at tier " + name(tier) + ", so no gate has compiled it";
        });
        description.defines.emplace_back(std::string(define), "1");
    }
    description.attributes = {
        {"position", kPosition}, {"normal", kNormal}, {"tangent", kTangent}, {"uv", kUv}, {"color", kColor}};
    // Named only where they are read, so that the calls of every other program stay what they are.
    const auto any = [&](auto holds) { return std::ranges::any_of(defines, holds); };
    if (any([](std::string_view define) { return define.ends_with("_FROM_1"); }))
        description.attributes.emplace_back("uv1", kUv1);
    if (any([](std::string_view define) { return define.starts_with("SKIN_"); })) {
        description.attributes.emplace_back("joints", kJoints);
        description.attributes.emplace_back("weights", kWeights);
    }
    return description;
}

const EffectCard* find_effect(std::string_view effect_name) {
    for (const EffectCard* card : all_effects()) {
        if (card->name == effect_name) return card;
    }
    return nullptr;
}

std::string insertion_prefix(const ShaderVariant& variant) {
    return std::string(variant.fragment.substr(0, variant.fragment.find('/'))) + ".";
}

}  // namespace halfframe
