// Card and drawing of anti_alias. Both its forms redirect other effects' passes: those that draw light get a
// multisampled target that is resolved into scene_color before anyone reads it; or those that finish the picture get a
// target that the edge filter reads.
#include "engine/effects/anti_alias/anti_alias.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

namespace {

constexpr int kSamples = 4;  // coverage in quarters; every ES 3.0 device has them for what must render
enum Phase : int { resolve_samples, filter_edges };

constexpr std::array kShaders = {ShaderVariant{"anti_alias/anti_alias.vert", "anti_alias/anti_alias.frag", ""}};

/// Does this tier multisample, and does the device do it for the formats of this frame?
bool multisamples(const PlanContext& context) {
    if (context.tier != Tier::reference) return false;
    const auto samples = [&](gl::PixelFormat format) { return context.caps.samples[static_cast<std::size_t>(format)]; };
    // The census stores every colour in RGBA32F.
    const gl::PixelFormat color = context.plan.census ? gl::PixelFormat::rgba32f : context.storage;
    return samples(color) >= kSamples && samples(context.plan.depth_format) >= kSamples;
}

Demand called_for(const PlanContext& context) {
    const std::size_t count = context.scene.surfaces.size();
    if (count == 0) return {false, "the scene has no surfaces, so it has no edges"};
    if (context.tier == Tier::low) return {false, "tier low has no anti-aliasing"};
    const std::string edges = fmt::format("the scene has {} surface{} with edges: ", count, count == 1 ? "" : "s");
    if (multisamples(context)) return {true, edges + fmt::format("{} samples a pixel", kSamples)};
    if (context.tier == Tier::console) return {true, edges + "a filter over the finished picture"};
    return {true, edges + fmt::format("a filter over the finished picture, because {} does not give {} {} samples",
                                      context.caps.device, name(context.storage), kSamples)};
}

Pass anti_alias_pass(Phase phase, PassOrder order, int color) {
    Pass pass;
    pass.name = "anti_alias";
    pass.effect = "anti_alias";
    pass.phase = phase;
    pass.order = order;
    pass.color = color;
    pass.full_screen = true;
    return pass;
}

void add_samples(FramePlan& plan) {
    const int resolved = plan.add_scene_color();
    Target target = plan.targets[static_cast<std::size_t>(resolved)];
    target.name += "_samples";
    target.samples = kSamples;
    const int multisampled = plan.add_target(target);
    for (Pass& pass : plan.passes) {
        if (pass.color != resolved || pass.order > PassOrder::resolve) continue;
        pass.color = multisampled;
        if (pass.depth) plan.targets[static_cast<std::size_t>(*pass.depth)].samples = kSamples;
    }
    Pass pass = anti_alias_pass(resolve_samples, PassOrder::resolve, resolved);
    pass.resolves = multisampled;
    plan.passes.push_back(pass);
}

void add_filter(FramePlan& plan) {
    Target target = plan.targets[static_cast<std::size_t>(plan.display)];
    target.name = "unfiltered";
    target.filtered = true;  // the filter mixes two pixels with one fetch
    const int unfiltered = plan.add_target(target);
    for (Pass& pass : plan.passes) {
        if (pass.color == plan.display) pass.color = unfiltered;
        std::ranges::replace(pass.reads, plan.display, unfiltered);
    }
    Pass pass = anti_alias_pass(filter_edges, PassOrder::finish, plan.display);
    pass.reads = {unfiltered};
    plan.passes.push_back(pass);
}

void add_passes(const PlanContext& context, FramePlan& plan) {
    // Switched on by hand: at the low tier there is nothing to add, and a picture nobody draws has no edges.
    if (context.tier == Tier::low || plan.display < 0) return;
    multisamples(context) ? add_samples(plan) : add_filter(plan);
}

class AntiAlias final : public EffectWork {
public:
    explicit AntiAlias(Renderer& renderer) {
        const FramePlan& plan = renderer.plan();
        const auto own = std::ranges::find(plan.passes, std::string("anti_alias"), &Pass::effect);
        if (own == plan.passes.end()) return;
        to_ = own->color.value_or(-1);
        if (own->phase == resolve_samples) {
            from_ = own->resolves.value_or(-1);
            return;
        }
        from_ = own->reads.front();
        program_ = &renderer.program(kAntiAlias, 0, {});
        renderer.use(*program_);
        renderer.gl().Uniform1i(program_->uniform("picture"), 0);
        const glm::vec4 texel(1.0f / static_cast<float>(plan.width), 1.0f / static_cast<float>(plan.height), 0.0f,
                              0.0f);
        renderer.gl().Uniform4fv(program_->uniform("texel"), 1, &texel.x);
        program_->expect_all_uniforms_claimed();
    }

    void draw(Renderer& renderer, const View&, int phase) override {
        if (phase == resolve_samples) {
            renderer.resolve(from_, to_);
            return;
        }
        renderer.set_depth(false, false, GL_ALWAYS);
        renderer.set_cull(false);
        renderer.set_blend(Blend::none);
        renderer.set_color_mask(true);
        renderer.use(*program_);
        renderer.bind_texture(0, renderer.target_texture(from_));
        renderer.draw_full_screen();
    }

private:
    gl::Program* program_ = nullptr;  ///< of the filter
    int from_ = -1, to_ = -1;         ///< targets
};

std::unique_ptr<EffectWork> prepare(Renderer& renderer) { return std::make_unique<AntiAlias>(renderer); }

}  // namespace

const EffectCard kAntiAlias{
    .name = "anti_alias",
    .purpose = "Smooths the staircases of edges: four samples a pixel, or a filter over the finished picture.",
    .sources = "ours; that a staircase tells the line behind it: A. Reshetov, Morphological Antialiasing, HPG 2009",
    .kind = EffectKind::pass,
    .called_for_by = "surfaces, above the low tier",
    .budget_row = "anti_alias",
    .tiers = {TierCard{{}, "", "none: staircases stay"},
              TierCard{kShaders, "unfiltered, display",
                       "edges down to a slope of 1 in 8 are smooth; corners and letters stay; what is thinner than a "
                       "pixel still breaks up"},
              TierCard{kShaders, "scene_color_samples, scene_color",
                       "four samples a pixel, averaged as light; as console where the device has none"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = nullptr,
    .prepare = prepare,
};

}  // namespace halfframe
