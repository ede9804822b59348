// START HERE: wet_surface darkens and smooths what takes up water; water that never changes is written into textures.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kWetSurface;

/// What the alpha of an opaque surface's vertices says about water.
struct VertexWater {
    float open = 1.0f;    ///< 0 sheltered .. 1 under the sky
    float hollow = 0.0f;  ///< depth of the hollow over Material::deepest_puddle_m, 0..1
};
/// alpha 0 .. 127/255 leads from shelter to open ground, from there to 1 the hollow gets deeper; as vertex_water() in
/// shaders_es/surface/surface_material.glsl.
[[nodiscard]] VertexWater vertex_water(float alpha);
/// The alpha that says this. Sheltered ground has no hollow.
[[nodiscard]] float vertex_alpha(const VertexWater& water);

/// How wet the scene is now, 0..1: its level, less what has dried.
struct WetLevels {
    float diffuse = 0.0f;   ///< of what darkens
    float specular = 0.0f;  ///< of what smooths: it fades first, because the film dries before the pores do
};
[[nodiscard]] WetLevels wet_levels(const Scene& scene);

/// How the water of a material gets into the picture.
enum class WaterPath : std::uint8_t {
    dry,      ///< it takes up none, or there is none
    written,  ///< into its textures and factors, while preparing: costs a frame nothing
    live,     ///< in the fragment stage, every frame
};
/// `why`: for live, what keeps it from being written, to follow "because".
struct WaterDecision {
    WaterPath path = WaterPath::dry;
    std::string why;
};
[[nodiscard]] WaterDecision water_decision(const Scene& scene, const Material& material);

/// Does water change how this surface is drawn: has it normals, and a lit material that takes up water?
[[nodiscard]] bool takes_water(const Scene& scene, const Surface& surface);
/// Does some place of the surface lie in a hollow, by its vertices or its texture?
[[nodiscard]] bool has_hollows(const Scene& scene, const Surface& surface);
/// False where the plan is for one view alone and the surface is outside of it.
[[nodiscard]] bool may_be_seen(const PlanContext& context, int surface);

/// Adds the defines of live water to those of a surface's program; for wet_surface and puddles alike.
void add_water_defines(const Renderer& renderer, int surface, std::vector<std::string_view>& defines);

}  // namespace halfframe
