// The card of an effect: everything the house knows about it in one place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/scene.h"
#include "engine/frame/tier.h"
#include "engine/gl/caps.h"
#include "engine/gl/program.h"

namespace halfframe {

struct FramePlan;
class Renderer;

/// What an effect needs to know to decide and to plan.
struct PlanContext {
    const Scene& scene;
    const View& view;
    const gl::Caps& caps;
    Tier tier;  ///< of this effect
    Arithmetic arithmetic;
    gl::PixelFormat storage;  ///< of scene_color
    const FramePlan& plan;    ///< so far: what the cards before this one in the list decided
};

/// The answer of a demand predicate: does the scene call for the effect, and the sentence why or why not.
struct Demand {
    bool called_for = false;
    std::string why;
};

/// A program of a tier and the defines that vary it. The shader gates compile the base, each define alone, and all
/// together, so what is not listed here cannot be used: Renderer::describe() checks.
struct ShaderVariant {
    std::string_view vertex;
    std::string_view fragment;
    std::string_view defines;  ///< names, space separated
    /// Those of them that put something simpler in the place of what others add: a program "with all" is without these.
    std::string_view simpler = {};
};

/// What one tier of an effect is.
struct TierCard {
    std::span<const ShaderVariant> shaders;
    std::string_view targets;  ///< what it writes, in words: "scene_color, depth"
    std::string_view eye;      ///< what the eye sees at this tier, and what it loses
};

enum class EffectKind : std::uint8_t {
    pass,      ///< adds passes to the plan
    material,  ///< adds code to other effects' shaders at named insertion points
};

/// Draws the passes of one effect, and feeds the code it has inserted into others' programs. Made while preparing;
/// draw() and feed() neither allocate nor create.
class EffectWork {
public:
    EffectWork() = default;
    EffectWork(const EffectWork&) = delete;
    EffectWork& operator=(const EffectWork&) = delete;
    virtual ~EffectWork() = default;
    /// Draws pass `phase` of this effect; targets, viewport and start actions are set already.
    virtual void draw(Renderer& renderer, const View& view, int phase);
    /// True while what an earlier frame drew in pass `phase` is right for `view` too: the frame leaves the pass out,
    /// its clears included. Only for a pass whose targets no other pass writes.
    [[nodiscard]] virtual bool still_holds(const Renderer& renderer, const View& view, int phase) const;
    /// `program` of another effect holds insertions of this one: claims their uniforms and gives their samplers texture
    /// units. The number returned comes back in feed(). Runs while preparing; `program` is current.
    virtual int adopt(Renderer& renderer, gl::Program& program);
    /// An adopted program has become current: sets what its insertions read, binds their textures.
    virtual void feed(Renderer& renderer, const View& view, int adopted);
    /// The same for what depends on the material: the draws that follow with an adopted program have this one.
    virtual void feed_material(Renderer& renderer, int adopted, int material);
};

/// What effects may write into a scene once and for all: its materials, and images that are new beside Scene::images.
struct MaterialChanges {
    std::vector<Material> materials;  ///< as many as the scene has
    std::vector<Image> images;        ///< image i of these is Scene::images.size() + i to a Texture
    std::vector<int> instead_of;      ///< for each of them the image of the scene that it replaces, as large; -1: none
};

struct EffectCard {
    std::string_view name;     ///< folder, budget row, ctest label and command-line name
    std::string_view purpose;  ///< one sentence
    std::string_view sources;  ///< papers and talks, with sections
    EffectKind kind = EffectKind::pass;
    std::string_view called_for_by;  ///< what in a scene calls for it, in words
    std::string_view budget_row;     ///< a row of the budget; its own name or a shared group's
    std::array<TierCard, kTierCount> tiers;
    /// Why it cannot be switched off by hand where the scene calls for it; empty: it can.
    std::string_view indispensable;

    Demand (*called_for)(const PlanContext&) = nullptr;
    /// Pass effects: appends targets and passes. Runs only when called for.
    void (*add_passes)(const PlanContext&, FramePlan&) = nullptr;
    /// Material effects (and pass effects that also change other shaders): the code to add. Runs only when called for.
    std::span<const gl::Insertion> (*insertions)(const PlanContext&) = nullptr;
    /// Material effects that only some surfaces call for: adds the defines that the program of `surface` needs for its
    /// insertions (Insertion::only_with). Runs while preparing; only when called for.
    void (*add_defines)(const Renderer&, int surface, std::vector<std::string_view>& defines) = nullptr;
    /// What never changes may be written into the materials before they are uploaded: it costs a frame nothing. Runs
    /// only when called for.
    void (*change_materials)(const Scene&, const FramePlan&, MaterialChanges&) = nullptr;
    /// Compiles and uploads what draw() and feed() need. Runs only when the plan holds a pass of the effect, or a
    /// program that it inserts code into. May be nullptr for insertions that read nothing.
    std::unique_ptr<EffectWork> (*prepare)(Renderer&) = nullptr;
};

/// Everything that decides the text of one variant of a card's program at a tier: dialect (low is ES 1.00, the others
/// ES 3.00), TIER_* define, attribute bindings, `defines`. A define the variant does not list: Mistake.
[[nodiscard]] gl::ProgramDescription describe_variant(const EffectCard& card, const ShaderVariant& variant, Tier tier,
                                                      Arithmetic arithmetic, bool fragment_highp,
                                                      std::span<const std::string_view> defines);

/// "surface." for a variant of surface/surface.frag: how the names of the insertion points in its text begin.
[[nodiscard]] std::string insertion_prefix(const ShaderVariant& variant);

/// The one explicit list, in the order the plan asks (engine/effects.cpp). Nothing registers itself.
[[nodiscard]] std::span<const EffectCard* const> all_effects();
[[nodiscard]] const EffectCard* find_effect(std::string_view name);

}  // namespace halfframe
