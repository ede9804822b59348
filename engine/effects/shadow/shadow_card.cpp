// The card of the shadow: demand, map or blobs, and what it inserts into surfaces.
#include <optional>

#include <fmt/format.h>

#include "engine/effects/shadow/shadow.h"
#include "engine/effects/shadow/shadow_blob.h"
#include "engine/effects/shadow/shadow_fit.h"
#include "engine/effects/shadow/shadow_map.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/skinning.h"
#include "shaders_es/shadow/shadow_limits.h"

namespace halfframe {

namespace {

constexpr std::array kBlobShaders = {
    ShaderVariant{"shadow/shadow_blob.vert", "shadow/shadow_blob.frag", "SCENE_COLOR_LINEAR"}};
constexpr std::array kMapShaders = {
    ShaderVariant{"shadow/shadow_map.vert", "shadow/shadow_map.frag",
                  "ALPHA_MASK BASE_COLOR_MAP VERTEX_COLOR UV_MAPPED UV_FROM_1 SKIN_SMALL SKIN_LARGE SKIN_TEXTURE"}};
constexpr gl::Insertion kPlace{"surface.vertex", "shadow/shadow_place.glsl", "shadow_at = placed_in_shadow(at, n);"};
constexpr std::array kInsertions = {
    kPlace, gl::Insertion{"surface.sun", "shadow/shadow_receive.glsl", "sun_light *= sun_share();"}};
constexpr std::array kReferenceInsertions = {
    kPlace, gl::Insertion{"surface.sun", "shadow/shadow_receive.glsl", "sun_light *= sun_share_of_square();"}};

Demand called_for_map(const Scene& scene) {
    int casters = 0, receivers = 0, both = 0;
    std::vector<std::optional<Box>> boxes(scene.meshes.size());  // surfaces share meshes: each is walked once
    bool has_depth = false;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        std::optional<Box>& box = boxes[static_cast<std::size_t>(scene.surfaces[i].mesh)];
        if (changes_shape(scene, scene.surfaces[i])) box = posed_box(scene, static_cast<int>(i));
        else if (!box) box = local_box(scene.meshes[static_cast<std::size_t>(scene.surfaces[i].mesh)]);
        const ShadowBody body = shadow_body(scene, static_cast<int>(i), *box);
        casters += body.casts;
        receivers += body.receives;
        both += body.casts && body.receives;
        has_depth = has_depth || (body.casts && body.receives && !is_flat(*box));
    }
    if (casters == 0) return {false, "no surface can stop the sun"};
    if (receivers == 0) return {false, "no surface is lit, so none can be in shadow"};
    const bool one_alone = casters == 1 && receivers == 1 && both == 1;
    if (one_alone && !has_depth) return {false, "the only surface is flat: it cannot shadow itself"};
    return {true, fmt::format("the scene has a sun, {} surface{} to stop it and {} to be in shadow", casters,
                              casters == 1 ? "" : "s", receivers)};
}

Demand called_for_blobs(const Scene& scene) {
    const std::vector<Box> grounds = grounds_of(scene);
    int objects = 0, blobs = 0;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& surface = scene.surfaces[i];
        if (!surface.dynamic) continue;
        ++objects;
        const Box box = world_box(posed_box(scene, static_cast<int>(i)), surface.world_from_local);
        blobs += blob_under(box, grounds).has_value();
    }
    if (objects == 0) return {false, "no surface is dynamic, and this tier shadows nothing else"};
    if (grounds.empty() || blobs == 0) return {false, "no dynamic surface is close above a static one"};
    return {true, fmt::format("the scene has a sun and {} dynamic surface{} close above a static one", blobs,
                              blobs == 1 ? "" : "s")};
}

Demand called_for(const PlanContext& context) {
    const EffectDecision* surface = context.plan.find("surface");
    if (surface != nullptr && !surface->in) return {false, "nothing is shaded"};
    if (shining_sun(context.scene) == nullptr) return {false, "no sun shines"};
    return context.tier == Tier::low ? called_for_blobs(context.scene) : called_for_map(context.scene);
}

void add_map(const PlanContext& context, FramePlan& plan) {
    const bool reference = context.tier == Tier::reference;
    const int side = reference ? SHADOW_MAP_SIZE_REFERENCE : SHADOW_MAP_SIZE_CONSOLE;
    const int map = plan.add_target(
        {.name = "shadow_map",
         .format = gl::PixelFormat::depth16,  // a step: a 32nd of a texel, or less, in a fit as deep as wide
         .width = side,
         .height = side,
         .fixed_size = true,
         .filtered = true,
         .compared = true});
    for (Pass& pass : plan.passes) {
        if (pass.effect == "surface" || pass.effect == "transparent") pass.reads.push_back(map);
    }
    Pass pass;
    pass.name = "shadow";
    pass.effect = "shadow";
    pass.order = PassOrder::shadow;
    pass.depth = map;
    pass.writes_color = false;
    pass.writes_depth = true;
    plan.passes.push_back(pass);
}

void add_blobs(FramePlan& plan) {
    Pass pass;
    pass.name = "shadow";
    pass.effect = "shadow";
    pass.order = PassOrder::ground;
    pass.color = plan.add_scene_color();
    pass.depth = plan.add_scene_depth();
    pass.blends = true;
    plan.passes.push_back(pass);
}

void add_passes(const PlanContext& context, FramePlan& plan) {
    context.tier == Tier::low ? add_blobs(plan) : add_map(context, plan);
}

std::span<const gl::Insertion> insertions(const PlanContext& context) {
    if (context.tier == Tier::low) return {};
    if (context.tier == Tier::reference) return kReferenceInsertions;
    return kInsertions;
}

std::unique_ptr<EffectWork> prepare(Renderer& renderer) {
    if (renderer.tier_of(kShadow.name) == Tier::low) return std::make_unique<ShadowBlobs>(renderer);
    return std::make_unique<ShadowMap>(renderer);
}

}  // namespace

const Light* shining_sun(const Scene& scene) {
    for (const Light& light : scene.lights) {
        if (light.kind != LightKind::sun) continue;
        const bool shines = light.color.r > 0.0f || light.color.g > 0.0f || light.color.b > 0.0f;
        return shines && glm::length(light.direction) > 1e-6f ? &light : nullptr;
    }
    return nullptr;
}

const EffectCard kShadow{
    .name = "shadow",
    .purpose = "Darkens the sun where a surface stands in its way; at low, the ground under what moves.",
    .sources =
        "L. Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978; W. Reeves, D. Salesin and R. Cook, "
        "Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987; offset along the normal: D. Holbert, GDC 2011",
    .kind = EffectKind::pass,
    .called_for_by = "a sun, surfaces that stop it and lit surfaces; at low, dynamic surfaces close above static ones",
    .budget_row = "shadow",
    .tiers = {TierCard{kBlobShaders, "scene_color",
                       "a soft dark blob on level ground under each dynamic surface; static ones cast nothing"},
              TierCard{kMapShaders, "shadow_map of 1024 texels, 16 bits",
                       "one map, edges 3 texels soft; translucents cast nothing"},
              TierCard{kMapShaders, "shadow_map of 2048 texels, 16 bits",
                       "as soft as console in half the texels, without its steps"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = insertions,
    .prepare = prepare,
};

}  // namespace halfframe
