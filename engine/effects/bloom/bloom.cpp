// Card and drawing of bloom: what is above the threshold, made small, blurred twice, and added where light is mapped.
#include "engine/effects/bloom/bloom.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"
#include "shaders_es/bloom/bloom_limits.h"
#include "shaders_es/tone_map/tone_map_limits.h"

namespace halfframe {

namespace {

enum Variant : int { kBright, kBlur, kDisplay };
enum Phase : int { bright, across, down, display };

constexpr std::string_view kDefines = "SCENE_COLOR_PACKED SCENE_COLOR_DISPLAY";
constexpr std::array kShaders = {ShaderVariant{"bloom/bloom.vert", "bloom/bloom_bright.frag", kDefines},
                                 ShaderVariant{"bloom/bloom.vert", "bloom/bloom_blur.frag", kDefines},
                                 ShaderVariant{"bloom/bloom.vert", "bloom/bloom_display.frag", "SCENE_COLOR_DISPLAY"}};
constexpr std::array kInsertions = {
    gl::Insertion{"tone_map.light", "bloom/bloom_light.glsl", "light += bloom_light(vertex_uv);"}};

float strongest_channel(const glm::vec3& color) { return std::max({color.r, color.g, color.b}); }

/// The drawn material that emits most, or nothing where none emits.
const Material* strongest_emitter(const Scene& scene) {
    const Material* strongest = nullptr;
    for (const Surface& surface : scene.surfaces) {
        const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
        const float least = strongest ? strongest_channel(strongest->emissive) : 0.0f;
        if (material.model == MaterialModel::unlit) continue;  // shows its colour and emits nothing
        if (strongest_channel(material.emissive) > least) strongest = &material;
    }
    return strongest;
}

Demand called_for(const PlanContext& context) {
    const Scene& scene = context.scene;
    if (scene.surfaces.empty() && !scene.sky) return {false, "nothing is lit: the scene has no surfaces and no sky"};
    if (scene.bloom) {
        if (scene.bloom->strength > 0.0f) return {true, "Scene::bloom asks for it"};
        return {false, "Scene::bloom has a strength of 0"};
    }
    const Material* emitter = strongest_emitter(scene);
    const float emitted = emitter ? strongest_channel(emitter->emissive) * context.view.exposure : 0.0f;
    if (emitted > BLOOM_THRESHOLD) {
        return {true, fmt::format("the material {} emits up to {:.3g}, above the light of 1 where blooming starts",
                                  emitter->name.empty() ? "without a name" : emitter->name, emitted)};
    }
    constexpr double kDisplayThreshold = TONE_MAP_B * BLOOM_THRESHOLD / (BLOOM_THRESHOLD + TONE_MAP_A);
    const float sky = scene.sky ? std::max({strongest_channel(scene.sky->zenith), strongest_channel(scene.sky->horizon),
                                            strongest_channel(scene.sky->ground)})
                                : 0.0f;
    if (sky > kDisplayThreshold) {
        return {true, fmt::format("the sky shows up to {:.3g}, above the display value of {:.3f} where blooming starts",
                                  sky, kDisplayThreshold)};
    }
    return {false, fmt::format("Scene::bloom is not set, and neither emission (up to {:.3g}) nor sky is above a light "
                               "of 1",
                               emitted)};
}

int divisor_of(Tier tier) {
    constexpr std::array kDivisors{BLOOM_LOW_DIVISOR, BLOOM_CONSOLE_DIVISOR, BLOOM_REFERENCE_DIVISOR};
    return kDivisors[static_cast<std::size_t>(tier)];
}

/// Storage of the glow: that of scene_color. RGBA32F is filtered by an extension only, and RGBA16F serves then.
gl::PixelFormat format_of(const PlanContext& context) {
    const bool filters_float = context.caps.desktop || context.caps.has_extension("GL_OES_texture_float_linear");
    if (context.storage == gl::PixelFormat::rgba32f && !filters_float &&
        context.caps.renders[static_cast<std::size_t>(gl::PixelFormat::rgba16f)]) {
        return gl::PixelFormat::rgba16f;
    }
    return context.storage;
}

void add_passes(const PlanContext& context, FramePlan& plan) {
    if (plan.passes.empty()) return;
    const int divisor = divisor_of(context.tier);
    const int source = plan.add_scene_color();
    // At the low tier the sampler takes the mean of four pixels.
    if (context.tier == Tier::low) plan.targets[static_cast<std::size_t>(source)].filtered = true;
    Target target{.name = "bloom",
                  .format = format_of(context),
                  .width = (plan.width + divisor - 1) / divisor,
                  .height = (plan.height + divisor - 1) / divisor,
                  // Where a side of the frame is less than a texel, the size follows it no longer.
                  .fixed_size = plan.width < divisor || plan.height < divisor,
                  .filtered = true};
    const int glow = plan.add_target(target);
    target.name = "bloom_across";
    const int half_done = plan.add_target(target);
    Pass pass;
    pass.effect = "bloom";
    pass.order = PassOrder::post;
    pass.full_screen = true;
    const auto add = [&](const char* name, int phase, int from, int to) {
        pass.name = name;
        pass.phase = phase;
        pass.reads = {from};
        pass.color = to;
        pass.blends = phase == Phase::display;
        pass.start_color = phase == Phase::display ? StartAction::keep : StartAction::discard;
        plan.passes.push_back(pass);
    };
    add("bloom_bright", Phase::bright, source, glow);
    add("bloom_across", Phase::across, glow, half_done);
    add("bloom_down", Phase::down, half_done, glow);
    if (holds_display_values(context.storage)) {
        pass.order = PassOrder::display;
        add("bloom_display", Phase::display, glow, source);
        return;
    }
    for (Pass& other : plan.passes) {
        if (other.effect == "tone_map") other.reads.push_back(glow);  // the insertion samples it
    }
}

std::span<const gl::Insertion> insertions(const PlanContext& context) {
    if (holds_display_values(context.storage)) return {};
    return kInsertions;
}

class BloomWork final : public EffectWork {
public:
    explicit BloomWork(Renderer& renderer) : strength_(renderer.scene().bloom.value_or(Bloom{}).strength) {
        const FramePlan& plan = renderer.plan();
        std::vector<std::string_view> defines;
        if (holds_display_values(plan.storage)) defines.push_back("SCENE_COLOR_DISPLAY");
        if (plan.storage == gl::PixelFormat::rgb10_a2) defines.push_back("SCENE_COLOR_PACKED");
        bright_ = make(renderer, kBright, defines);
        blur_ = make(renderer, kBlur, defines);
        for (const Pass& pass : plan.passes) {
            if (pass.effect == "bloom") sources_[static_cast<std::size_t>(pass.phase)] = pass.reads.front();
        }
        glow_ = plan.target_index("bloom");
        const Target& glow = plan.targets[static_cast<std::size_t>(glow_)];
        const int divisor = divisor_of(renderer.tier_of("bloom"));
        const glm::vec2 frame(plan.width, plan.height);
        const glm::vec2 blocks(glow.width * divisor, glow.height * divisor);
        frame_from_blocks_ = blocks / frame;
        blocks_from_frame_ = frame / blocks;
        tap_ = (renderer.tier_of("bloom") == Tier::low ? 2.0f : 1.0f) / frame;
        texel_ = glm::vec2(1.0f) / glm::vec2(glow.width, glow.height);
        if (holds_display_values(plan.storage)) prepare_display(renderer, defines);
    }

    int adopt(Renderer& renderer, gl::Program& program) override {
        renderer.gl().Uniform1i(program.uniform("bloom"), kBloomUnit);
        set(renderer, program.uniform("bloom_scale"), {blocks_from_frame_, strength_, 0.0f});
        return 0;
    }

    void feed(Renderer& renderer, const View&, int) override {
        renderer.bind_texture(kBloomUnit, renderer.target_texture(glow_));
    }

    void draw(Renderer& renderer, const View&, int phase) override {
        renderer.set_depth(false, false, GL_ALWAYS);
        renderer.set_cull(false);
        renderer.set_blend(phase == Phase::display ? Blend::screen : Blend::none);
        renderer.set_color_mask(true);
        if (phase == Phase::display) {
            renderer.use(*display_);
        } else {
            const PassProgram& pass = phase == Phase::bright ? bright_ : blur_;
            renderer.use(*pass.program);
            set(renderer, pass.uv_scale, {phase == Phase::bright ? frame_from_blocks_ : glm::vec2(1.0f), 0.0f, 0.0f});
            const glm::vec2 step = phase == Phase::bright   ? tap_
                                   : phase == Phase::across ? glm::vec2(texel_.x, 0.0f)
                                                            : glm::vec2(0.0f, texel_.y);
            set(renderer, pass.texel, {step, 0.0f, 0.0f});
        }
        renderer.bind_texture(0, renderer.target_texture(sources_[static_cast<std::size_t>(phase)]));
        renderer.draw_full_screen();
    }

private:
    struct PassProgram {
        gl::Program* program = nullptr;
        int uv_scale = -1, texel = -1;
    };

    static PassProgram make(Renderer& renderer, Variant variant, std::span<const std::string_view> defines) {
        PassProgram made{.program = &renderer.program(kBloom, variant, defines)};
        made.uv_scale = made.program->uniform("uv_scale");
        made.texel = made.program->uniform("texel");
        renderer.use(*made.program);
        renderer.gl().Uniform1i(made.program->uniform("image"), 0);
        made.program->expect_all_uniforms_claimed();
        return made;
    }

    void prepare_display(Renderer& renderer, std::span<const std::string_view> defines) {
        display_ = &renderer.program(kBloom, kDisplay, defines);
        renderer.use(*display_);
        renderer.gl().Uniform1i(display_->uniform("image"), 0);
        set(renderer, display_->uniform("uv_scale"), {blocks_from_frame_, 0.0f, 0.0f});
        set(renderer, display_->uniform("strength"), {strength_, 0.0f, 0.0f, 0.0f});
        display_->expect_all_uniforms_claimed();
    }

    static void set(Renderer& renderer, int location, const glm::vec4& value) {
        renderer.gl().Uniform4fv(location, 1, &value.x);
    }

    float strength_;
    PassProgram bright_, blur_;
    gl::Program* display_ = nullptr;
    std::array<int, 4> sources_{};       ///< by phase
    int glow_ = -1;                      ///< the target that holds the finished glow
    glm::vec2 frame_from_blocks_{1.0f};  ///< uv of the frame for a uv of the glow
    glm::vec2 blocks_from_frame_{1.0f};  ///< the inverse
    glm::vec2 tap_{0.0f}, texel_{0.0f};  ///< uv steps: between the taps of a block, between texels of the glow
};

std::unique_ptr<EffectWork> prepare(Renderer& renderer) { return std::make_unique<BloomWork>(renderer); }

}  // namespace

const EffectCard kBloom{
    .name = "bloom",
    .purpose = "Spreads light above 1 (display code 214) over its neighbourhood: a Gaussian of 12 pixels.",
    .sources =
        "S. Lagarde and L. Harduin, The Art and Rendering of Remember Me, GDC Europe 2013: values above 214 bloom; "
        "Gaussian filters separate",
    .kind = EffectKind::pass,
    .called_for_by = "Scene::bloom; without it a material's emission above 1, or a sky above display value 0.842",
    .budget_row = "bloom",
    .tiers = {TierCard{kShaders, "bloom and bloom_across at an eighth of the size, then scene_color",
                       "display values taken back to light; a highlight of one pixel may be missed; over lit surfaces "
                       "the glow is approximate"},
              TierCard{kShaders, "bloom and bloom_across at a quarter of the size",
                       "added to the light before the tone map; 17 taps in 9 fetches each way"},
              TierCard{kShaders, "bloom and bloom_across at half the size",
                       "the same glow from 37 taps each way, in highp from float targets"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = insertions,
    .prepare = prepare,
};

}  // namespace halfframe
