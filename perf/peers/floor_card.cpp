// Cards and drawing of the two floors. They have passes and targets like surface's and belong to no list of the engine:
// perf/peers hands them to a renderer in its place.
#include "perf/peers/floor_card.h"

#include <array>
#include <vector>

#include "engine/frame/camera_space.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"

namespace halfframe::peers {
namespace {

constexpr std::array kShaders = {ShaderVariant{"floor/floor.vert", "floor/floor.frag",
                                               "BASE_COLOR_MAP METALLIC_ROUGHNESS_MAP NORMAL_MAP EMISSIVE_MAP "
                                               "SKIN_SMALL SKIN_LARGE SKIN_TEXTURE"}};
constexpr std::array kTiers = {TierCard{kShaders, "scene_color, depth", "one colour"},
                               TierCard{kShaders, "scene_color, depth", "one colour"},
                               TierCard{kShaders, "scene_color, depth", "one colour"}};

Demand called_for(const PlanContext&) { return {true, "the floor is asked for"}; }

void add_passes(const PlanContext&, FramePlan& plan) {
    Pass pass;
    pass.name = "floor";
    pass.effect = "floor";
    pass.order = PassOrder::opaque;
    pass.color = plan.add_scene_color();
    pass.depth = plan.add_scene_depth();
    pass.writes_depth = true;
    plan.passes.push_back(pass);
}

class FloorWork final : public EffectWork {
public:
    FloorWork(Renderer& renderer, const EffectCard& card, bool fetches);
    void draw(Renderer& renderer, const View& view, int phase) override;

private:
    struct Draw {
        gl::Program* program;
        int clip_from_local;
        int base_color;
        int skin;
        int uv_range;
        int surface;
        std::vector<std::pair<int, std::uint32_t>> textures;  ///< unit, name
    };
    void add_draw(Renderer& renderer, const EffectCard& card, int surface, bool fetches);
    std::vector<Draw> draws_;
};

FloorWork::FloorWork(Renderer& renderer, const EffectCard& card, bool fetches) {
    for (std::size_t i = 0; i < renderer.scene().surfaces.size(); ++i) {
        add_draw(renderer, card, static_cast<int>(i), fetches);
    }
}

void FloorWork::add_draw(Renderer& renderer, const EffectCard& card, int index, bool fetches) {
    struct Map {
        const Texture& texture;
        std::string_view define;
        const char* sampler;
        bool color;
    };
    const Scene& scene = renderer.scene();
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(index)];
    const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
    const bool decoded = renderer.tier_of("floor") != Tier::low && renderer.caps().srgb_textures;
    std::vector<std::string_view> defines;
    std::vector<const char*> samplers;
    Draw draw{.program = nullptr,
              .clip_from_local = -1,
              .base_color = -1,
              .skin = -1,
              .uv_range = -1,
              .surface = index,
              .textures = {}};
    for (const Map& map :
         {Map{material.base_color_texture, "BASE_COLOR_MAP", "base_color_map", true},
          Map{material.metallic_roughness_texture, "METALLIC_ROUGHNESS_MAP", "metallic_roughness_map", false},
          Map{material.normal_texture, "NORMAL_MAP", "normal_map", false},
          Map{material.emissive_texture, "EMISSIVE_MAP", "emissive_map", true}}) {
        if (!fetches || !map.texture) continue;
        defines.push_back(map.define);
        draw.textures.emplace_back(
            static_cast<int>(samplers.size()),
            renderer.texture(map.texture, {.decoded = map.color && decoded,
                                           .kind = map.color ? TexelKind::color : TexelKind::data}));
        samplers.push_back(map.sampler);
    }
    if (const std::string_view skin = renderer.skin_define(index); !skin.empty()) defines.push_back(skin);
    draw.program = &renderer.program(card, 0, defines);
    draw.clip_from_local = draw.program->uniform("clip_from_local");
    draw.base_color = draw.program->uniform("base_color");
    draw.uv_range = draw.program->uniform_if_used("uv_range");
    draw.skin = renderer.claim_skin(*draw.program);
    for (std::size_t unit = 0; unit < samplers.size(); ++unit) {
        renderer.gl().Uniform1i(draw.program->uniform(samplers[unit]), static_cast<int>(unit));
    }
    draws_.push_back(std::move(draw));
}

void FloorWork::draw(Renderer& renderer, const View& view, int) {
    renderer.set_color_mask(true);
    renderer.set_blend(Blend::none);
    renderer.set_depth(true, true, GL_LEQUAL);
    for (const Draw& draw : draws_) {
        const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draw.surface)];
        const Material& material = renderer.scene().materials[static_cast<std::size_t>(surface.material)];
        const glm::mat4 clip = clip_from_local(view, surface.world_from_local);
        if (outside_view(renderer.box(draw.surface), clip)) continue;
        renderer.use(*draw.program);
        renderer.set_cull(!material.double_sided);
        for (const auto& [unit, texture] : draw.textures) renderer.bind_texture(unit, texture);
        renderer.gl().Uniform4fv(draw.base_color, 1, &material.base_color.x);
        const DrawMesh& mesh = renderer.mesh(surface.mesh);
        const glm::mat4 stored = from_stored(clip, mesh.storage);
        renderer.gl().UniformMatrix4fv(draw.clip_from_local, 1, GL_FALSE, &stored[0][0]);
        if (draw.uv_range >= 0) renderer.gl().Uniform4fv(draw.uv_range, 1, &mesh.storage.uv_range.x);
        renderer.draw_surface(draw.surface, draw.skin, &stored);
    }
}

std::unique_ptr<EffectWork> prepare_constant(Renderer& renderer) {
    return std::make_unique<FloorWork>(renderer, kConstantFloor, false);
}

std::unique_ptr<EffectWork> prepare_fetches(Renderer& renderer) {
    return std::make_unique<FloorWork>(renderer, kFetchFloor, true);
}

EffectCard floor_card(const char* purpose, decltype(EffectCard::prepare) prepare) {
    return {.name = "floor",
            .purpose = purpose,
            .sources = "none: a measuring device",
            .kind = EffectKind::pass,
            .called_for_by = "perf/peers",
            .budget_row = "surface",
            .tiers = kTiers,
            .indispensable = "there would be nothing to time",
            .called_for = called_for,
            .add_passes = add_passes,
            .insertions = nullptr,
            .prepare = prepare};
}

}  // namespace

const EffectCard kConstantFloor =
    floor_card("Draws every surface in one colour, to time what no shading can go below.", prepare_constant);

const EffectCard kFetchFloor =
    floor_card("Samples every texture of a material and adds them up, to time the fetches alone.", prepare_fetches);

}  // namespace halfframe::peers
