// Card of puddles: what calls for them, and what they insert.
#include "engine/effects/puddles/puddles.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/effects/wet_surface/wet_surface.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe {

namespace {

constexpr std::array kInsertions = {
    gl::Insertion{"surface.water", "puddles/puddles_receive.glsl",
                  "puddle = water.x * puddle_share(water.y, water.z, puddle_level.x, normalize(vertex_normal).y); "
                  "wetness = min(wetness + puddle, 1.0);",
                  "PUDDLES"},
    gl::Insertion{"surface.water_material", "puddles/puddles_receive.glsl",
                  "specular = water_specular(specular, puddle); "
                  "float still = water_smoothness(smoothness, puddle); "
                  "power = smoother_power(power, still - smoothness); smoothness = still; "
                  "n = over_water(n, water_normal, puddle);",
                  "PUDDLES"}};

bool holds_water(const Scene& scene, const Surface& surface) {
    return takes_water(scene, surface) && has_hollows(scene, surface);
}

Demand called_for(const PlanContext& context) {
    const Scene& scene = context.scene;
    if (!scene.puddles) return {false, "no water stands in the scene"};
    if (!(scene.puddles->level > 0.0f)) return {false, "the level of the puddles is 0"};
    int hollow = 0, seen = 0;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        if (!holds_water(scene, scene.surfaces[i])) continue;
        ++hollow;
        seen += may_be_seen(context, static_cast<int>(i));
    }
    if (hollow == 0) return {false, "no surface that takes up water has hollows"};
    if (seen == 0)
        return {false, fmt::format("none of the {} surface{} with hollows is in view", hollow, hollow == 1 ? "" : "s")};
    return {true, fmt::format("hollows of {} surface{} are filled to {:.2f}", seen, seen == 1 ? "" : "s",
                              scene.puddles->level)};
}

std::span<const gl::Insertion> insertions(const PlanContext&) { return kInsertions; }

void add_defines(const Renderer& renderer, int index, std::vector<std::string_view>& defines) {
    const Scene& scene = renderer.scene();
    if (!holds_water(scene, scene.surfaces[static_cast<std::size_t>(index)])) return;
    add_water_defines(renderer, index, defines);
    defines.emplace_back("PUDDLES");
}

class PuddlesWork final : public EffectWork {
public:
    int adopt(Renderer&, gl::Program& program) override {
        const int level = program.uniform_if_used("puddle_level");
        if (level < 0) return -1;
        levels_.push_back(level);
        return static_cast<int>(levels_.size()) - 1;
    }

    void feed(Renderer& renderer, const View&, int index) override {
        const auto& puddles = renderer.scene().puddles;
        const glm::vec4 value(puddles ? std::clamp(puddles->level, 0.0f, 1.0f) : 0.0f, 0.0f, 0.0f, 0.0f);
        renderer.gl().Uniform4fv(levels_[static_cast<std::size_t>(index)], 1, &value.x);
    }

private:
    std::vector<int> levels_;
};

std::unique_ptr<EffectWork> prepare(Renderer&) { return std::make_unique<PuddlesWork>(); }

}  // namespace

const EffectCard kPuddles{
    .name = "puddles",
    .purpose = "Lets water stand in hollows of the ground: smooth as a mirror, level, and wet around.",
    .sources = "S. Lagarde and L. Harduin, GDC Europe 2013, puddles; S. Lagarde, Water drop 3b, 2013",
    .kind = EffectKind::material,
    .called_for_by = "Scene::puddles above 0, and surfaces in view that take up water and have hollows",
    .budget_row = "puddles",
    .tiers = {TierCard{{}, "none of its own", "hollows by vertex; cracks of a texture do not fill"},
              TierCard{{}, "none of its own", "hollows by vertex, cracks by the height in a texture"},
              TierCard{{}, "none of its own", "as console, in highp"}},
    .called_for = called_for,
    .add_passes = nullptr,
    .insertions = insertions,
    .add_defines = add_defines,
    .prepare = prepare,
};

}  // namespace halfframe
