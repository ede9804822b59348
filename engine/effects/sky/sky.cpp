// Card and drawing of the sky.
#include "engine/effects/sky/sky.h"

#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

namespace {

constexpr std::array kShaders = {
    ShaderVariant{"sky/sky.vert", "sky/sky.frag", "SCENE_COLOR_DISPLAY SCENE_COLOR_PACKED"}};

Demand called_for(const PlanContext& context) {
    if (context.scene.sky) return {true, "the scene has a sky"};
    return {false, "the scene has no sky: the background is one colour"};
}

void add_passes(const PlanContext&, FramePlan& plan) {
    Pass pass;
    pass.name = "sky";
    pass.effect = "sky";
    pass.order = PassOrder::sky;
    pass.color = plan.add_scene_color();
    pass.depth = plan.add_scene_depth();
    pass.full_screen = true;
    plan.passes.push_back(pass);
}

class SkyWork final : public EffectWork {
public:
    explicit SkyWork(Renderer& renderer) {
        std::vector<std::string_view> defines;
        if (holds_display_values(renderer.plan().storage)) defines.push_back("SCENE_COLOR_DISPLAY");
        if (renderer.plan().storage == gl::PixelFormat::rgb10_a2) defines.push_back("SCENE_COLOR_PACKED");
        program_ = &renderer.program(kSky, 0, defines);
        ray_right_ = program_->uniform("ray_right");
        ray_up_ = program_->uniform("ray_up");
        ray_forward_ = program_->uniform("ray_forward");
        zenith_ = program_->uniform("zenith");
        horizon_ = program_->uniform("horizon");
        ground_ = program_->uniform("ground");
        program_->expect_all_uniforms_claimed();
    }

    void draw(Renderer& renderer, const View& view, int) override {
        renderer.set_depth(true, false, GL_LEQUAL);
        renderer.set_cull(false);
        renderer.set_blend(Blend::none);
        renderer.set_color_mask(true);
        renderer.use(*program_);
        // An orthographic eye looks one way: every pixel sees the same sky.
        const glm::mat3 world_from_view = glm::transpose(glm::mat3(view.view_from_world));
        const float spread = view.orthographic ? 0.0f : 1.0f;
        set(renderer, ray_right_, world_from_view[0] * (spread / view.clip_from_view[0][0]));
        set(renderer, ray_up_, world_from_view[1] * (spread / view.clip_from_view[1][1]));
        set(renderer, ray_forward_, -world_from_view[2]);
        const Sky sky = renderer.scene().sky.value_or(Sky{});  // none: switched on by hand
        set(renderer, zenith_, sky.zenith);
        set(renderer, horizon_, sky.horizon);
        set(renderer, ground_, sky.ground);
        renderer.draw_full_screen();
    }

private:
    static void set(Renderer& renderer, int location, const glm::vec3& value) {
        const glm::vec4 padded(value, 0.0f);
        renderer.gl().Uniform4fv(location, 1, &padded.x);
    }

    gl::Program* program_ = nullptr;
    int ray_right_ = -1, ray_up_ = -1, ray_forward_ = -1, zenith_ = -1, horizon_ = -1, ground_ = -1;
};

std::unique_ptr<EffectWork> prepare(Renderer& renderer) { return std::make_unique<SkyWork>(renderer); }

}  // namespace

const EffectCard kSky{
    .name = "sky",
    .purpose =
        "Draws a vertical gradient of display colours behind everything, as linear light where the frame is HDR.",
    .sources =
        "S. Lagarde and L. Harduin, The Art and Rendering of Remember Me, GDC Europe 2013, LDR sky through the inverse "
        "tone map",
    .kind = EffectKind::pass,
    .called_for_by = "Scene::sky",
    .budget_row = "sky",
    .tiers = {TierCard{kShaders, "scene_color",
                       "the gradient's display colours, stored as they are; no inverse tone map"},
              TierCard{kShaders, "scene_color",
                       "the same gradient; as linear light, mapped back by tone_map, where light is stored"},
              TierCard{kShaders, "scene_color", "as console, in highp from float targets"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = nullptr,
    .prepare = prepare,
};

}  // namespace halfframe
