// Card and drawing of the tone map: a pass where scene_color holds light, code inside the surface shader where it holds
// display values.
#include "engine/effects/tone_map/tone_map.h"

#include <fmt/format.h>

#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

namespace {

constexpr std::array kShaders = {
    ShaderVariant{"tone_map/tone_map.vert", "tone_map/tone_map.frag", "SCENE_COLOR_PACKED"}};
constexpr std::array kInsertions = {
    gl::Insertion{"surface.color", "tone_map/tone_map.glsl", "color = tone_map(color);"}};

Demand called_for(const PlanContext& context) {
    const bool draws = !context.scene.surfaces.empty() || context.scene.sky.has_value() || !context.plan.passes.empty();
    if (!draws) return {false, "nothing is lit: the scene has no surfaces and no sky"};
    const std::string& why = context.plan.why_storage;
    const std::string because = why.empty() ? "" : ": " + why;
    if (!holds_display_values(context.storage))
        return {true, fmt::format("a pass maps the light of scene_color ({}){}", name(context.storage), because)};
    if (context.scene.surfaces.empty())
        return {false, "the sky is stored as display values, so there is nothing to map" + because};
    return {true, "no pass: the surface shader maps its own light into 8 bits" + because};
}

void add_passes(const PlanContext& context, FramePlan& plan) {
    if (holds_display_values(context.storage) || plan.passes.empty()) return;
    Pass pass;
    pass.name = "tone_map";
    pass.effect = "tone_map";
    pass.order = PassOrder::display;
    pass.reads = {plan.add_scene_color()};
    plan.display = plan.add_target("display", gl::PixelFormat::rgba8);
    pass.color = plan.display;
    pass.full_screen = true;
    plan.passes.push_back(pass);
}

std::span<const gl::Insertion> insertions(const PlanContext& context) {
    if (holds_display_values(context.storage)) return kInsertions;
    return {};
}

class ToneMap final : public EffectWork {
public:
    explicit ToneMap(Renderer& renderer) {
        std::vector<std::string_view> defines;
        if (renderer.plan().storage == gl::PixelFormat::rgb10_a2) defines.push_back("SCENE_COLOR_PACKED");
        program_ = &renderer.program(kToneMap, 0, defines);
        scene_color_ = program_->uniform("scene_color");
        program_->expect_all_uniforms_claimed();
        renderer.use(*program_);
        renderer.gl().Uniform1i(scene_color_, 0);
        source_ = renderer.plan().target_index("scene_color");
    }

    void draw(Renderer& renderer, const View&, int) override {
        renderer.set_depth(false, false, GL_ALWAYS);
        renderer.set_cull(false);
        renderer.set_blend(Blend::none);
        renderer.set_color_mask(true);
        renderer.use(*program_);
        renderer.bind_texture(0, renderer.target_texture(source_));
        renderer.draw_full_screen();
    }

private:
    gl::Program* program_ = nullptr;
    int scene_color_ = -1;
    int source_ = -1;
};

std::unique_ptr<EffectWork> prepare(Renderer& renderer) { return std::make_unique<ToneMap>(renderer); }

}  // namespace

const EffectCard kToneMap{
    .name = "tone_map",
    .purpose = "Turns linear light into display values with the talk's curve, 1.0275 x / (x + 0.22).",
    .sources =
        "S. Lagarde and L. Harduin, The Art and Rendering of Remember Me, GDC Europe 2013, tone mapping and LDR sky",
    .kind = EffectKind::pass,
    .called_for_by = "anything lit",
    .budget_row = "tone_map",
    .tiers = {TierCard{
                  kShaders, "display",
                  "no pass: surfaces map their own light, so translucents blend display values (a little too dark)"},
              TierCard{kShaders, "display",
                       "one pass over the picture where something reads light, else none; whites from a light of 8"},
              TierCard{kShaders, "display", "as console, in highp from float targets"}},
    .indispensable = "without it, light would be shown as if it were a display's values",
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = insertions,
    .prepare = prepare,
};

}  // namespace halfframe
