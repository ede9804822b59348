// Card of the sorted pass. It shades with surface's programs; what is its own is the order, the blending, and that it
// leaves depth as it finds it.
#include "engine/effects/transparent/transparent.h"

#include <fmt/format.h>

#include "engine/effects/surface/surface.h"
#include "engine/effects/surface/surface_work.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

namespace {

Demand called_for(const PlanContext& context) {
    const int blended = count_blended(context.scene);
    if (blended == 0) return {false, "no surface is translucent"};
    return {true, fmt::format("the scene has {} translucent surface{}", blended, blended == 1 ? "" : "s")};
}

void add_passes(const PlanContext&, FramePlan& plan) {
    Pass pass;
    pass.name = "transparent";
    pass.effect = "transparent";
    pass.order = PassOrder::transparent;
    pass.color = plan.add_scene_color();
    pass.depth = plan.add_scene_depth();
    pass.blends = true;
    plan.passes.push_back(pass);
}

std::unique_ptr<EffectWork> prepare(Renderer& renderer) {
    return std::make_unique<SurfaceWork>(renderer, kTransparent, SurfacePart::transparent);
}

}  // namespace

const EffectCard kTransparent{
    .name = "transparent",
    .purpose = "Draws translucent surfaces over the opaque ones, sorted by the distance of their boxes, far to near.",
    .sources = "T. Porter and T. Duff, Compositing Digital Images, SIGGRAPH 1984: the over operator",
    .kind = EffectKind::pass,
    .called_for_by = "surfaces whose material blends",
    .budget_row = "transparent",
    .tiers = {TierCard{surface_shaders(Tier::low), "scene_color",
                       "blends display values, so overlaps come out a little too dark; lights as surface at low"},
              TierCard{surface_shaders(Tier::console), "scene_color",
                       "blends linear light; lights as surface at console"},
              TierCard{surface_shaders(Tier::reference), "scene_color", "as console, in highp into float targets"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = nullptr,
    .prepare = prepare,
};

}  // namespace halfframe
