// Card, demand and drawing of the depth prepass.
#include "engine/effects/depth_prepass/depth_prepass.h"

#include <optional>
#include <vector>

#include <fmt/format.h>

#include "engine/frame/camera_space.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

double opaque_cover(const Scene& scene, const View& view) {
    std::vector<std::optional<Box>> boxes(scene.meshes.size());  // surfaces share meshes: each is walked once
    double cover = 0.0;
    for (const Surface& surface : scene.surfaces) {
        if (scene.materials[static_cast<std::size_t>(surface.material)].alpha_mode != AlphaMode::opaque) continue;
        std::optional<Box>& box = boxes[static_cast<std::size_t>(surface.mesh)];
        if (!box) box = local_box(scene.meshes[static_cast<std::size_t>(surface.mesh)]);
        cover += screen_fraction(*box, clip_from_local(view, surface.world_from_local));
    }
    return cover;
}

namespace {

constexpr std::array kShaders = {
    ShaderVariant{"depth_prepass/depth_prepass.vert", "depth_prepass/depth_prepass.frag", ""}};

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
    explicit DepthPrepass(Renderer& renderer) : program_(renderer.program(kDepthPrepass, 0, {})) {
        clip_from_local_ = program_.uniform("clip_from_local");
        program_.expect_all_uniforms_claimed();
        const Scene& scene = renderer.scene();
        for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
            const Surface& surface = scene.surfaces[i];
            const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
            const Primitive primitive = scene.meshes[static_cast<std::size_t>(surface.mesh)].primitive;
            const bool is_area = primitive >= Primitive::triangles;  // points and lines hide next to nothing
            if (material.alpha_mode == AlphaMode::opaque && is_area) surfaces_.push_back(static_cast<int>(i));
        }
    }

    void draw(Renderer& renderer, const View& view, int) override {
        renderer.set_color_mask(false);
        renderer.set_blend(Blend::none);
        renderer.set_depth(true, true, GL_LESS);
        renderer.use(program_);
        const ViewSpace space = view_space(view);
        for (const int index : surfaces_) {
            const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(index)];
            const DrawMesh& mesh = renderer.mesh(surface.mesh);
            const glm::mat4 matrix =
                clip_from_stored(space, eye_from_stored(space, surface.world_from_local, mesh.stored));
            if (outside_view(mesh.stored_box, matrix)) continue;
            renderer.set_cull(!renderer.scene().materials[static_cast<std::size_t>(surface.material)].double_sided);
            renderer.gl().UniformMatrix4fv(clip_from_local_, 1, GL_FALSE, &matrix[0][0]);
            renderer.draw_mesh(mesh);
        }
        renderer.set_color_mask(true);
    }

private:
    gl::Program& program_;
    int clip_from_local_ = -1;
    std::vector<int> surfaces_;
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
    .tiers = {TierCard{kShaders, "depth", "nothing: the picture is the same with it and without"},
              TierCard{kShaders, "depth", "nothing: the picture is the same with it and without"},
              TierCard{kShaders, "depth", "nothing: the picture is the same with it and without"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = nullptr,
    .prepare = prepare,
};

}  // namespace halfframe
