// Card of wet surfaces: what calls for them, what is live and what is written, what it inserts.
#include "engine/effects/wet_surface/wet_surface.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/effects/wet_surface/wet_bake.h"
#include "engine/frame/camera_space.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

namespace {

constexpr const char* kSoak =
    "albedo = wet_albedo(albedo, pores, wetness.x); "
    "float soaked = wet_smoothness(smoothness, pores, wetness.y); "
    "power = smoother_power(power, soaked - smoothness); smoothness = soaked;";
constexpr std::array kInsertions = {
    gl::Insertion{"surface.water", "wet_surface/wet_surface_receive.glsl", "wetness = wet_level.xy * water.x;", "WATER"},
    gl::Insertion{"surface.water_material", "wet_surface/wet_surface_receive.glsl",
                  "float pores = porosity(specular, smoothness);", "WATER"},
    gl::Insertion{"surface.water_material", "wet_surface/wet_surface_receive.glsl", kSoak, "WATER"}};
constexpr std::array kLowInsertions = {
    gl::Insertion{"surface.water", "wet_surface/wet_surface_low.glsl", "wetness = wet_level.xy * water.x;", "WATER"},
    gl::Insertion{"surface.water_material", "wet_surface/wet_surface_low.glsl", "float pores = wet_material.x;",
                  "WATER"},
    gl::Insertion{"surface.water_material", "wet_surface/wet_surface_low.glsl", kSoak, "WATER"}};

bool stands(const Scene& scene) { return scene.puddles && scene.puddles->level > 0.0f; }

const Material& material_of(const Scene& scene, const Surface& surface) {
    return scene.materials[static_cast<std::size_t>(surface.material)];
}

const Mesh& mesh_of(const Scene& scene, const Surface& surface) {
    return scene.meshes[static_cast<std::size_t>(surface.mesh)];
}

bool is_wet(const Scene& scene) {
    const WetLevels levels = wet_levels(scene);
    return levels.diffuse > 0.0f || levels.specular > 0.0f;
}

/// Has its water texture cracks that fill?
bool has_cracks(const Scene& scene, const Material& material) {
    if (!material.water_texture) return false;
    const std::vector<std::uint8_t>& rgba = scene.images[static_cast<std::size_t>(material.water_texture.image)].rgba;
    for (std::size_t i = 1; i < rgba.size(); i += 4) {
        if (rgba[i] < 255) return true;
    }
    return false;
}

/// Would the surface look the same without its water?
bool water_shows(const Scene& scene, const Surface& surface) {
    return takes_water(scene, surface) && (is_wet(scene) || has_hollows(scene, surface));
}

/// A logistic curve from 1 at x = 0 to 0 at x = 1, about `middle`.
float falling(float x, float middle) {
    constexpr float kSteepness = 10.0f;
    const auto logistic = [&](float at) { return 1.0f / (1.0f + std::exp(kSteepness * (at - middle))); };
    if (x <= 0.0f) return 1.0f;
    if (x >= 1.0f) return 0.0f;
    return (logistic(x) - logistic(1.0f)) / (logistic(0.0f) - logistic(1.0f));
}

/// The materials that take up water and are seen, by path.
struct WaterCensus {
    int surfaces = 0;  ///< that take up water, seen or not
    int seen = 0;
    std::vector<int> written, live;  ///< materials, each once
    std::string why_live;            ///< of the first
};

WaterCensus census(const PlanContext& context) {
    const Scene& scene = context.scene;
    WaterCensus result;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        if (!takes_water(scene, scene.surfaces[i])) continue;
        ++result.surfaces;
        if (!may_be_seen(context, static_cast<int>(i))) continue;
        ++result.seen;
        if (!water_shows(scene, scene.surfaces[i])) continue;
        const int material = scene.surfaces[i].material;
        const WaterDecision decision = water_decision(scene, material_of(scene, scene.surfaces[i]));
        if (decision.path == WaterPath::dry) continue;
        std::vector<int>& list = decision.path == WaterPath::written ? result.written : result.live;
        if (std::ranges::find(list, material) != list.end()) continue;
        if (decision.path == WaterPath::live && list.empty()) {
            result.why_live = fmt::format("{} because {}", scene.materials[static_cast<std::size_t>(material)].name,
                                          decision.why);
        }
        list.push_back(material);
    }
    return result;
}

std::string plural(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

Demand called_for(const PlanContext& context) {
    const Scene& scene = context.scene;
    if (!is_wet(scene) && !stands(scene)) {
        return {false, !scene.wetness                 ? "the scene says nothing of water"
                       : scene.wetness->level == 0.0f ? "the wetness of the scene is 0"
                                                      : "the scene has dried"};
    }
    const WaterCensus found = census(context);
    if (found.surfaces == 0) return {false, "no surface takes up water"};
    if (found.seen == 0) {
        return {false, fmt::format("none of the {} that take up water {} in view", plural(static_cast<std::size_t>(found.surfaces), "surface"),
                                   found.surfaces == 1 ? "is" : "are")};
    }
    if (found.live.empty() && found.written.empty()) return {false, "no puddle stands on what takes up water"};
    std::string why;
    if (!found.written.empty()) {
        why = fmt::format("wetness {:.2f} never changes and is written into the textures of {}", scene.wetness->level,
                          plural(found.written.size(), "material"));
    }
    if (!found.live.empty()) {
        why += fmt::format("{}{} wetted in every frame, {}", why.empty() ? "" : "; ",
                           plural(found.live.size(), "material") + (found.live.size() == 1 ? " is" : " are"),
                           found.why_live);
    }
    return {true, why};
}

std::span<const gl::Insertion> insertions(const PlanContext& context) {
    if (census(context).live.empty()) return {};
    if (context.tier == Tier::low) return kLowInsertions;
    return kInsertions;
}

void change_materials(const Scene& scene, const FramePlan&, MaterialChanges& changes) {
    write_wetness(scene, changes);
}

class WetSurfaceWork final : public EffectWork {
public:
    explicit WetSurfaceWork(Renderer& renderer) {
        if (renderer.tier_of(kWetSurface.name) != Tier::low) return;
        const Scene& scene = renderer.scene();
        for (const Material& material : scene.materials) {
            const bool live = water_decision(scene, material).path == WaterPath::live;
            pores_.push_back(live ? mean_porosity(scene, material) : 0.0f);
        }
    }

    int adopt(Renderer&, gl::Program& program) override {
        const Adopted adopted{program.uniform_if_used("wet_level"), program.uniform_if_used("wet_material")};
        if (adopted.level < 0 && adopted.material < 0) return -1;  // not lit
        adopted_.push_back(adopted);
        return static_cast<int>(adopted_.size()) - 1;
    }

    void feed(Renderer& renderer, const View&, int index) override {
        const WetLevels levels = wet_levels(renderer.scene());
        const glm::vec4 value(levels.diffuse, levels.specular, 0.0f, 0.0f);
        const int location = adopted_[static_cast<std::size_t>(index)].level;
        if (location >= 0) renderer.gl().Uniform4fv(location, 1, &value.x);
    }

    void feed_material(Renderer& renderer, int index, int material) override {
        const int location = adopted_[static_cast<std::size_t>(index)].material;
        if (location < 0) return;
        const glm::vec4 value(pores_[static_cast<std::size_t>(material)], 0.0f, 0.0f, 0.0f);
        renderer.gl().Uniform4fv(location, 1, &value.x);
    }

private:
    struct Adopted {
        int level = -1;
        int material = -1;
    };
    std::vector<Adopted> adopted_;
    std::vector<float> pores_;  ///< by material; low only
};

std::unique_ptr<EffectWork> prepare(Renderer& renderer) { return std::make_unique<WetSurfaceWork>(renderer); }

}  // namespace

VertexWater vertex_water(float alpha) {
    return {std::clamp(alpha * 2.01f, 0.0f, 1.0f), std::clamp((alpha - 0.4982f) * 1.9935f, 0.0f, 1.0f)};
}

float vertex_alpha(const VertexWater& water) {
    constexpr float kOpen = 127.0f / 255.0f;
    return water.open < 1.0f ? kOpen * std::max(water.open, 0.0f)
                             : kOpen + (1.0f - kOpen) * std::clamp(water.hollow, 0.0f, 1.0f);
}

WetLevels wet_levels(const Scene& scene) {
    if (!scene.wetness) return {};
    const Wetness& wetness = *scene.wetness;
    const float level = std::clamp(wetness.level, 0.0f, 1.0f);
    if (!wetness.since_s) return {level, level};
    const float x = *wetness.since_s / std::max(wetness.dry_s, 1e-3f);
    return {level * falling(x, 0.5f), level * falling(x, 0.25f)};
}

WaterDecision water_decision(const Scene& scene, const Material& material) {
    if (material.water == WaterMask::none || material.model == MaterialModel::unlit) return {};
    const bool fills = stands(scene) && (material.water == WaterMask::vertex_color || has_cracks(scene, material));
    if (!is_wet(scene) && !fills) return {};
    if (fills) return {WaterPath::live, "puddles stand on it"};
    if (!scene.wetness->is_static || scene.wetness->since_s) return {WaterPath::live, "the wetness may change"};
    if (material.water == WaterMask::vertex_color)
        return {WaterPath::live, "its mask is in vertex colours"};
    if (std::string obstacle = obstacle_to_writing(scene, material); !obstacle.empty())
        return {WaterPath::live, std::move(obstacle)};
    return {WaterPath::written, {}};
}

bool takes_water(const Scene& scene, const Surface& surface) {
    const Material& material = material_of(scene, surface);
    const Mesh& mesh = mesh_of(scene, surface);
    return material.water != WaterMask::none && material.model != MaterialModel::unlit && !mesh.normals.empty() &&
           mesh.primitive >= Primitive::triangles;
}

bool has_hollows(const Scene& scene, const Surface& surface) {
    const Material& material = material_of(scene, surface);
    if (has_cracks(scene, material)) return true;
    return material.water == WaterMask::vertex_color &&
           std::ranges::any_of(mesh_of(scene, surface).colors,
                               [](const glm::vec4& color) { return vertex_water(color.a).hollow > 0.0f; });
}

bool may_be_seen(const PlanContext& context, int index) {
    if (!context.plan.fixed_view) return true;
    const Surface& surface = context.scene.surfaces[static_cast<std::size_t>(index)];
    if (surface.node >= 0 || surface.skin >= 0) return true;  // it moves
    return !outside_view(local_box(mesh_of(context.scene, surface)),
                         clip_from_local(context.view, surface.world_from_local));
}

void add_water_defines(const Renderer& renderer, int index, std::vector<std::string_view>& defines) {
    const Scene& scene = renderer.scene();
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(index)];
    const Material& material = material_of(scene, surface);
    const auto has = [&](std::string_view define) {
        return std::ranges::find(defines, define) != defines.end();
    };
    if (has("WATER") || !water_shows(scene, surface) || water_decision(scene, material).path != WaterPath::live) return;
    defines.emplace_back("WATER");
    const bool by_vertex = material.water == WaterMask::vertex_color && !mesh_of(scene, surface).colors.empty() &&
                           material.alpha_mode == AlphaMode::opaque;
    if (by_vertex) defines.emplace_back("WATER_VERTEX");
    if (material.water_texture) defines.emplace_back("WATER_MAP");
}

const EffectCard kWetSurface{
    .name = "wet_surface",
    .purpose = "Darkens and smooths what takes up water: rough dielectrics, not metals nor smooth ones.",
    .sources =
        "S. Lagarde and L. Harduin, GDC Europe 2013, physically based wet surfaces; S. Lagarde, Water drop 3b, 2013",
    .kind = EffectKind::material,
    .called_for_by = "Scene::wetness above 0, or Scene::puddles, and surfaces in view whose Material::water is not none",
    .budget_row = "wet_surface",
    .tiers = {TierCard{{},
                       "none of its own",
                       "one porosity for a whole material, masks by vertex; a mask in a texture is left out unless "
                       "it is written"},
              TierCard{{}, "none of its own", "porosity and masks by pixel"},
              TierCard{{}, "none of its own", "as console, in highp"}},
    .called_for = called_for,
    .add_passes = nullptr,
    .insertions = insertions,
    .add_defines = add_water_defines,
    .change_materials = change_materials,
    .prepare = prepare,
};

}  // namespace halfframe
