// The card of surface: demand, passes, tiers; and which lights reach an object.
#include "engine/effects/surface/surface.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "engine/effects/surface/surface_work.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

namespace {

constexpr std::string_view kDefines =
    "BASE_COLOR_MAP METALLIC_ROUGHNESS_MAP NORMAL_MAP PACKED_MAPS EMISSIVE_MAP VERTEX_COLOR ALPHA_MASK ALPHA_BLEND "
    "DOUBLE_SIDED SUN LOCAL_LIGHTS ONE_LIGHT TWO_LIGHTS THREE_LIGHTS FOUR_LIGHTS SPOT_LIGHTS AREA_LIGHTS UNLIT POINTS "
    "SCENE_COLOR_PACKED SCENE_COLOR_DISPLAY DISPLAY_COLOR OWN_SPECULAR SPECULAR_MAP SPECULAR_COLOR_MAP "
    "SPECULAR_GLOSSINESS SPECULAR_GLOSSINESS_MAP OCCLUSION_MAP OCCLUSION_PACKED OCCLUSION_IN_BASE EMISSION_IN_BASE "
    "UV_MAPPED UV_FROM_1 UV_B UV_B_FROM_1 BASE_COLOR_UV_B ROUGHNESS_UV_B NORMAL_UV_B EMISSIVE_UV_B OCCLUSION_UV_B "
    "SPECULAR_UV_B "
    "SPECULAR_COLOR_UV_B "
    "SKIN_SMALL WATER WATER_VERTEX PUDDLES CONSTANT_SMOOTHNESS LIT_BY_VERTEX MIRROR_BY_VERTEX";
constexpr std::string_view kDefinesAboveLow =
    "BASE_COLOR_MAP METALLIC_ROUGHNESS_MAP NORMAL_MAP PACKED_MAPS EMISSIVE_MAP VERTEX_COLOR ALPHA_MASK ALPHA_BLEND "
    "DOUBLE_SIDED SUN LOCAL_LIGHTS ONE_LIGHT TWO_LIGHTS THREE_LIGHTS FOUR_LIGHTS SPOT_LIGHTS AREA_LIGHTS UNLIT POINTS "
    "SCENE_COLOR_PACKED SCENE_COLOR_DISPLAY DISPLAY_COLOR OWN_SPECULAR SPECULAR_MAP SPECULAR_COLOR_MAP "
    "SPECULAR_GLOSSINESS SPECULAR_GLOSSINESS_MAP OCCLUSION_MAP OCCLUSION_PACKED OCCLUSION_IN_BASE EMISSION_IN_BASE "
    "UV_MAPPED UV_FROM_1 UV_B UV_B_FROM_1 BASE_COLOR_UV_B ROUGHNESS_UV_B NORMAL_UV_B EMISSIVE_UV_B OCCLUSION_UV_B "
    "SPECULAR_UV_B "
    "SPECULAR_COLOR_UV_B "
    "SKIN_SMALL SKIN_LARGE SKIN_TEXTURE WATER WATER_VERTEX WATER_MAP WATER_UV_B PUDDLES CONSTANT_SMOOTHNESS";
/// The first two are not lit, the others light vertices.
constexpr std::string_view kSimpler = "UNLIT DISPLAY_COLOR LIT_BY_VERTEX MIRROR_BY_VERTEX";
constexpr std::array kShadersAtLow = {
    ShaderVariant{"surface/surface.vert", "surface/surface.frag", kDefines, kSimpler}};
constexpr std::array kShaders = {
    ShaderVariant{"surface/surface.vert", "surface/surface.frag", kDefinesAboveLow, kSimpler}};

Demand called_for(const PlanContext& context) {
    const std::size_t count = context.scene.surfaces.size();
    if (count == 0) return {false, "the scene has no surfaces"};
    const std::size_t opaque = count - static_cast<std::size_t>(count_blended(context.scene));
    if (opaque == 0) return {false, "every surface is translucent: they are drawn by transparent"};
    return {true, fmt::format("the scene has {} opaque surface{}", opaque, opaque == 1 ? "" : "s")};
}

void add_passes(const PlanContext&, FramePlan& plan) {
    Pass pass;
    pass.name = "surface";
    pass.effect = "surface";
    pass.order = PassOrder::opaque;
    pass.color = plan.add_scene_color();
    pass.depth = plan.add_scene_depth();
    pass.writes_depth = true;
    plan.passes.push_back(pass);
}

std::unique_ptr<EffectWork> prepare(Renderer& renderer) {
    return std::make_unique<SurfaceWork>(renderer, kSurface, SurfacePart::opaque);
}

float strongest_channel(const glm::vec3& color) { return std::max({color.r, color.g, color.b}); }

/// At the place of `box` that is nearest to the light; 0: it does not reach, or is a sun.
float strength_in(const Box& box, const Light& light) {
    if (light.kind == LightKind::sun) return 0.0f;
    const float distance_m = glm::distance(glm::clamp(light.position, box.low, box.high), light.position);
    if (distance_m >= light.range_m) return 0.0f;
    const float nearest_m2 = std::max({distance_m * distance_m, light.radius_m * light.radius_m, 0.01f});
    return std::max(strongest_channel(light.color) / nearest_m2, 1e-30f);  // a dark lamp counts, and loses to all
}

/// The stronger first; of equal ones the choice is that of their places, and not of their order in a file.
bool goes_before(const Box& box, const Scene& scene, int a, int b) {
    const Light& one = scene.lights[static_cast<std::size_t>(a)];
    const Light& other = scene.lights[static_cast<std::size_t>(b)];
    const float strength = strength_in(box, one), other_strength = strength_in(box, other);
    if (strength != other_strength) return strength > other_strength;
    return std::tuple(order_of(one), a) < std::tuple(order_of(other), b);
}

}  // namespace

std::array<float, 7> order_of(const Light& light) {
    return {-(light.color.r + light.color.g + light.color.b),
            light.position.x,
            light.position.y,
            light.position.z,
            light.direction.x,
            light.direction.y,
            light.direction.z};
}

std::span<const ShaderVariant> surface_shaders(Tier tier) {
    if (tier == Tier::low) return kShadersAtLow;
    return kShaders;
}

int count_blended(const Scene& scene) {
    return static_cast<int>(std::ranges::count_if(scene.surfaces, [&](const Surface& surface) {
        return scene.materials[static_cast<std::size_t>(surface.material)].alpha_mode == AlphaMode::blend;
    }));
}

void lights_reaching(const Scene& scene, const Box& box, std::size_t limit, std::vector<int>& lights, int& left_out) {
    lights.clear();
    left_out = 0;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (!(strength_in(box, scene.lights[i]) > 0.0f)) continue;
        const int light = static_cast<int>(i);
        auto at = lights.end();
        while (at != lights.begin() && goes_before(box, scene, light, *(at - 1))) --at;
        lights.insert(at, light);
        if (lights.size() <= limit) continue;
        lights.pop_back();
        ++left_out;
    }
}

const EffectCard kSurface{
    .name = "surface",
    .purpose =
        "Shades every mesh: Blinn microfacet direct light from a sun, points and spots, constant ambient, emission.",
    .sources =
        "N. Hoffman, SIGGRAPH 2010 course, Crafting Physically Motivated Shading Models; S. Lagarde and L. Harduin, "
        "GDC Europe 2013",
    .kind = EffectKind::pass,
    .called_for_by = "surfaces that hide what is behind them",
    .budget_row = "surface",
    .tiers = {TierCard{kShadersAtLow, "scene_color, depth",
                       "the sun by pixel with its highlight; local lights by vertex and diffuse only; from afar all "
                       "diffuse light of untextured surfaces by vertex; mediump where the device has no highp"},
              TierCard{kShaders, "scene_color, depth", "every light by pixel with highlights to a power of 2048"},
              TierCard{kShaders, "scene_color, depth", "as console, with the lobe as written, in highp"}},
    .called_for = called_for,
    .add_passes = add_passes,
    .insertions = nullptr,
    .prepare = prepare,
};

}  // namespace halfframe
