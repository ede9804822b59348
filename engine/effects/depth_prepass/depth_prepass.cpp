// Card, demand and drawing of the depth prepass.
#include "engine/effects/depth_prepass/depth_prepass.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "engine/frame/camera_space.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"
#include "engine/frame/skinning.h"

namespace halfframe {

double opaque_cover(const Scene& scene, const View& view) {
    std::vector<std::optional<Box>> boxes(scene.meshes.size());  // surfaces share meshes: each is walked once
    double cover = 0.0;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& surface = scene.surfaces[i];
        if (scene.materials[static_cast<std::size_t>(surface.material)].alpha_mode != AlphaMode::opaque) continue;
        if (changes_shape(scene, surface)) {
            cover +=
                screen_fraction(posed_box(scene, static_cast<int>(i)), clip_from_local(view, surface.world_from_local));
            continue;
        }
        std::optional<Box>& box = boxes[static_cast<std::size_t>(surface.mesh)];
        if (!box) box = local_box(scene.meshes[static_cast<std::size_t>(surface.mesh)]);
        cover += screen_fraction(*box, clip_from_local(view, surface.world_from_local));
    }
    return cover;
}

namespace {

constexpr std::array kShadersAtLow = {
    ShaderVariant{"depth_prepass/depth_prepass.vert", "depth_prepass/depth_prepass.frag", "SKIN_SMALL"}};
constexpr std::array kShaders = {ShaderVariant{"depth_prepass/depth_prepass.vert", "depth_prepass/depth_prepass.frag",
                                               "SKIN_SMALL SKIN_LARGE SKIN_TEXTURE"}};

Demand called_for(const PlanContext& context) {
    const EffectDecision* surface = context.plan.find("surface");
    if (surface == nullptr || !surface->in) return {false, "nothing is shaded, so there is nothing to save"};
    const double cover = opaque_cover(context.scene, context.view);
    if (cover >= kPrepassCover) {
        return {true, fmt::format("opaque surfaces cover the picture {:.1f} times (called for from {:.1f} on)", cover,
                                  kPrepassCover)};
    }
    return {false, fmt::format("opaque surfaces cover the picture only {:.1f} times (called for from {:.1f} on)", cover,
                               kPrepassCover)};
}

void add_passes(const PlanContext&, FramePlan& plan) {
    Pass pass;
    pass.name = "depth_prepass";
    pass.effect = "depth_prepass";
    pass.order = PassOrder::depth;
    pass.color = plan.add_scene_color();
    pass.depth = plan.add_scene_depth();
    pass.writes_color = false;  // bound, because depth alone is not complete on every ES 2.0 device
    pass.writes_depth = true;
    plan.passes.push_back(pass);
}

class DepthPrepass final : public EffectWork {
public:
    explicit DepthPrepass(Renderer& renderer) {
        const Scene& scene = renderer.scene();
        for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
            const Surface& surface = scene.surfaces[i];
            const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
            const Primitive primitive = scene.meshes[static_cast<std::size_t>(surface.mesh)].primitive;
            const bool is_area = primitive >= Primitive::triangles;  // points and lines hide next to nothing
            if (material.alpha_mode != AlphaMode::opaque || !is_area) continue;
            draws_.push_back({static_cast<int>(i), variant_of(renderer, static_cast<int>(i))});
        }
        std::ranges::stable_sort(draws_, {}, &Draw::variant);  // fewest changes of program
    }

    void draw(Renderer& renderer, const View& view, int) override {
        renderer.set_color_mask(false);
        renderer.set_blend(Blend::none);
        renderer.set_depth(true, true, GL_LESS);
        const ViewSpace space = view_space(view);
        for (const Draw& draw : draws_) {
            const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draw.surface)];
            const DrawMesh& mesh = renderer.mesh(surface.mesh);
            const glm::mat4 matrix =
                clip_from_stored(space, eye_from_stored(space, surface.world_from_local, mesh.stored));
            // What changes its shape is stored as it is, so that its box needs no other measure.
            const bool moves = changes_shape(renderer.scene(), surface);
            if (outside_view(moves ? renderer.box(draw.surface) : mesh.stored_box, matrix)) continue;
            const Variant& variant = variants_[draw.variant];
            renderer.use(*variant.program);
            renderer.set_cull(!renderer.scene().materials[static_cast<std::size_t>(surface.material)].double_sided);
            renderer.gl().UniformMatrix4fv(variant.clip_from_local, 1, GL_FALSE, &matrix[0][0]);
            renderer.draw_surface(draw.surface, variant.skin, &matrix);
        }
        renderer.set_color_mask(true);
    }

private:
    struct Variant {
        gl::Program* program = nullptr;
        int clip_from_local = -1, skin = -1;
    };
    struct Draw {
        int surface = 0;
        std::size_t variant = 0;
    };

    std::size_t variant_of(Renderer& renderer, int surface) {
        const std::string_view skin = renderer.skin_define(surface);
        gl::Program& program = renderer.program(kDepthPrepass, 0, {&skin, skin.empty() ? 0u : 1u});
        const auto known = std::ranges::find(variants_, &program, &Variant::program);
        if (known != variants_.end()) return static_cast<std::size_t>(known - variants_.begin());
        variants_.push_back({&program, program.uniform("clip_from_local"), renderer.claim_skin(program)});
        program.expect_all_uniforms_claimed();
        return variants_.size() - 1;
    }

    std::vector<Variant> variants_;
    std::vector<Draw> draws_;
};

std::unique_ptr<EffectWork> prepare(Renderer& renderer) { return std::make_unique<DepthPrepass>(renderer); }

}  // namespace

const EffectCard kDepthPrepass{
    .name = "depth_prepass",
    .purpose = "Writes the depth of opaque surfaces first, so that hidden pixels are never shaded.",
    .sources = "common practice on RSX and Xenos, whose ROPs write depth alone at twice the rate",
    .kind = EffectKind::pass,
    .called_for_by = "opaque surfaces whose screen boxes cover the picture three times or more",
    .budget_row = "depth_prepass",
    .tiers = {TierCard{kShadersAtLow, "depth", "nothing: the picture is the same with it and without"},
              TierCard{kShaders, "depth", "nothing: the picture is the same with it and without"},
              TierCard{kShaders, "depth", "nothing: the picture is the same with it and without"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = nullptr,
    .prepare = prepare,
};

}  // namespace halfframe
