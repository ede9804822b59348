// Prepares and draws surfaces. The CPU multiplies lights by the exposure, subtracts the eye in double, and sorts.
#include "engine/effects/surface/surface_work.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/color_space.hpp>

#include "engine/effects/surface/surface.h"
#include "engine/effects/surface/surface_by_vertex.h"
#include "engine/frame/camera_space.h"
#include "engine/frame/frame_plan.h"

namespace halfframe {

namespace {

void set(gl::EntryPoints& gl, int location, const glm::vec4& value) {
    if (location >= 0) gl.Uniform4fv(location, 1, &value.x);
}

constexpr glm::vec4 kNotParallel{0.0f, 0.0f, 0.0f, 1.0f};

/// How many draws ahead memory is asked for: one draw hides about one access to main memory, four are on the safe side.
constexpr std::size_t kAhead = 4;

/// Asks for memory before it is read. Says nothing where the compiler has no word for it.
void will_read([[maybe_unused]] const void* at, [[maybe_unused]] std::size_t bytes) {
#if defined(__GNUC__)
    for (std::size_t i = 0; i < bytes; i += 64) __builtin_prefetch(static_cast<const char*>(at) + i);
#endif
}

/// Of an orthographic view: the same for every place.
glm::vec3 direction_to_eye(const View& view) {
    return {view.view_from_world[0].z, view.view_from_world[1].z, view.view_from_world[2].z};
}

/// What the fragment stage makes of a material's numbers; without a map it is spared their powers and logarithms, which
/// are those of shaders_es/surface/surface.glsl.
glm::vec4 factors_of(const Material& material, bool maps_roughness) {
    const bool glossy = material.model == MaterialModel::specular_glossiness;
    const float metallic = glossy ? 0.0f : material.metallic;
    if (maps_roughness)
        return {metallic, glossy ? material.smoothness : material.roughness, material.normal_scale, 0.0f};
    const float power = power_of(unmapped_roughness(material));
    return {metallic, smoothness_of_power(power), material.normal_scale, power};
}

/// Units that no insertion of another effect reads: the glow is added by other programs, the shadow map exists above
/// low only, the rough cube at low only.
std::vector<int> spare_units(const Renderer& renderer) {
    const auto reads = [&](std::string_view effect, bool at_low) {
        const EffectDecision* decision = renderer.plan().find(effect);
        return decision != nullptr && decision->in && (decision->tier == Tier::low) == at_low;
    };
    std::vector<int> units{kBloomUnit};
    if (!reads("shadow", false)) units.push_back(kShadowUnit);
    if (!reads("environment", true)) units.push_back(kRoughReflectionUnit);
    return units;
}

const Material& material_of(const Renderer& renderer, const Surface& surface) {
    return renderer.material(surface.material);
}

/// Light as shaders get it, exposed. Half ends at 65504, and inf times a 0 (in shadow, out of reach) would be NaN;
/// 60000 is white 7500 times over.
glm::vec3 exposed(const glm::vec3& light, float exposure) { return glm::min(light * exposure, glm::vec3(60000.0f)); }

}  // namespace

std::vector<std::string_view> SurfaceWork::defines_of(const Renderer& renderer, const Surface& surface,
                                                      std::span<const int> lights, bool chooses_lights,
                                                      const SurfaceTextures& textures) const {
    const Material& material = material_of(renderer, surface);
    const DrawMesh& mesh = renderer.mesh(surface.mesh);
    const bool lit = mesh.has_normals && !is_unlit(material);
    std::vector<std::string_view> defines = textures.defines;
    if (lit || is_unlit(material)) {
        const auto of_model = model_defines(material);
        defines.insert(defines.end(), of_model.begin(), of_model.end());
    }
    if (is_unlit(material) && holds_display_values(renderer.plan().storage)) defines.push_back("SCENE_COLOR_DISPLAY");
    if (mesh.has_colors) defines.push_back("VERTEX_COLOR");
    if (material.alpha_mode == AlphaMode::mask) defines.push_back("ALPHA_MASK");
    if (material.alpha_mode == AlphaMode::blend) defines.push_back("ALPHA_BLEND");
    if (lit && material.double_sided) defines.push_back("DOUBLE_SIDED");
    if (lit && sun_) defines.push_back("SUN");
    if (lit && !lights.empty()) {
        // Up to four have a loop of their own length.
        constexpr std::array<std::string_view, 4> kCounts{"ONE_LIGHT", "TWO_LIGHTS", "THREE_LIGHTS", "FOUR_LIGHTS"};
        defines.push_back("LOCAL_LIGHTS");
        if (!chooses_lights && lights.size() <= kCounts.size()) defines.push_back(kCounts[lights.size() - 1]);
        const auto is_spot = [&](int light) {
            return renderer.scene().lights[static_cast<std::size_t>(light)].kind == LightKind::spot;
        };
        if (std::ranges::any_of(lights, is_spot)) defines.push_back("SPOT_LIGHTS");
    }
    const auto has_radius = [&](int light) {
        return renderer.scene().lights[static_cast<std::size_t>(light)].radius_m > 0.0f;
    };
    // At low every light is a point: it has no highlight that a sphere could widen.
    if (lit && std::ranges::any_of(lights, has_radius) && renderer.tier_of(card_.name) != Tier::low)
        defines.push_back("AREA_LIGHTS");
    if (!lit && !is_unlit(material))
        defines.push_back("UNLIT");  // glTF 2.0, 3.7.2.1: points and lines without normals are not lit
    if (mesh.mode == GL_POINTS) defines.push_back("POINTS");
    if (renderer.plan().storage == gl::PixelFormat::rgb10_a2) defines.push_back("SCENE_COLOR_PACKED");
    if (const std::string_view skin =
            renderer.skin_define(static_cast<int>(&surface - renderer.scene().surfaces.data()));
        !skin.empty())
        defines.push_back(skin);
    return defines;
}

bool SurfaceWork::chooses_lights(const Scene& scene, const Surface& surface) const {
    return surface.node >= 0 || surface.skin >= 0 ||
           std::ranges::any_of(scene.lights, [](const Light& light) { return light.node >= 0; });
}

int SurfaceWork::variant_of(Renderer& renderer, const std::vector<std::string_view>& defines,
                            std::span<const SurfaceTexture> textures) {
    // Asked for by its defines, because to ask for a program is to put its whole text together.
    const auto known = std::ranges::find(variants_, defines, &Variant::defines);
    if (known != variants_.end()) return static_cast<int>(known - variants_.begin());
    gl::Program& program = renderer.program(card_, 0, defines);
    Variant variant;
    variant.program = &program;
    variant.has_insertions = !program.description().insertions.empty();
    variant.defines = defines;
    variant.maps_roughness = std::ranges::any_of(defines, [](std::string_view define) {
        return define == "METALLIC_ROUGHNESS_MAP" || define == "PACKED_MAPS" || define == "SPECULAR_GLOSSINESS_MAP";
    });
    variant.clip_from_local = program.uniform("clip_from_local");
    for (const auto& [name, location] : std::initializer_list<std::pair<const char*, int*>>{
             {"uv_mapping", &variant.uv_mapping}, {"uv_b_mapping", &variant.uv_b_mapping},
             {"specular_factors", &variant.specular_factors}, {"uv1_range", &variant.uv1_range},
             {"eye_from_local", &variant.eye_from_local}, {"normal_from_local", &variant.normal_from_local},
             {"toward_eye", &variant.toward_eye}, {"uv_range", &variant.uv_range},
             {"direction_scale", &variant.direction_scale}, {"base_color", &variant.base_color},
             {"emissive", &variant.emissive}, {"factors", &variant.factors}, {"ambient", &variant.ambient},
             {"parallel_eye", &variant.parallel_eye}, {"sun_direction", &variant.sun_direction},
             {"sun_color", &variant.sun_color}, {"lit_albedo", &variant.lit_albedo},
             {"lit_specular", &variant.lit_specular}, {"lit_metal", &variant.lit_metal},
             {"lit_emission", &variant.lit_emission}, {"lit_ambient", &variant.lit_ambient},
             {"lit_sun_direction", &variant.lit_sun_direction}, {"lit_sun_color", &variant.lit_sun_color},
             {"light_position", &variant.light_position}, {"light_color", &variant.light_color},
             {"light_direction", &variant.light_direction}, {"light_size", &variant.light_size},
             {"light_count", &variant.light_count}}) {
        *location = program.uniform_if_used(name);
    }
    variant.skin = renderer.claim_skin(program);
    for (const SurfaceTexture& texture : textures) {
        if (const int location = program.uniform_if_used(texture.sampler); location >= 0)
            renderer.gl().Uniform1i(location, texture.unit);
    }
    program.expect_all_uniforms_claimed();
    variants_.push_back(variant);
    return static_cast<int>(variants_.size()) - 1;
}

void SurfaceWork::add_draw(Renderer& renderer, int index) {
    const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(index)];
    const Material& material = material_of(renderer, surface);
    Draw draw{.surface = index,
              .mesh = surface.mesh,
              .material = surface.material,
              .look = static_cast<int>(looks_.size()),
              .double_sided = material.double_sided};
    int left_out = 0;
    std::vector<int> lights;
    lights.reserve(SURFACE_LIGHT_LIMIT + 1);
    lights_reaching(renderer.scene(), world_box(renderer.box(index), surface.world_from_local), SURFACE_LIGHT_LIMIT,
                    lights, left_out);
    draw.changes_shape = changes_shape(renderer.scene(), surface);
    draw.chooses_lights = chooses_lights(renderer.scene(), surface);
    std::vector<int> possible = lights;
    if (draw.chooses_lights) {
        // Its program must be ready for every lamp that may come near.
        possible.clear();
        for (std::size_t i = 0; i < renderer.scene().lights.size(); ++i) {
            if (renderer.scene().lights[i].kind != LightKind::sun) possible.push_back(static_cast<int>(i));
        }
    }
    if (left_out > 0) {
        ++crowded_;
        if (left_out > most_left_out_) {
            most_left_out_ = left_out;
            most_crowded_ = surface.name;
        }
    }
    // Objects that the same lights reach share them, whichever is nearer; and the order in the file moves no rounding.
    std::ranges::sort(lights, [&](int a, int b) {
        const std::vector<Light>& all = renderer.scene().lights;
        return std::tuple(order_of(all[static_cast<std::size_t>(a)]), a) <
               std::tuple(order_of(all[static_cast<std::size_t>(b)]), b);
    });
    const bool low = renderer.tier_of(card_.name) == Tier::low;
    std::vector<std::string_view> inserted;  // defines of what other effects insert
    renderer.add_defines(index, inserted);
    const bool water_map = std::erase(inserted, "WATER_MAP") > 0 && !low;
    const SurfaceTextures textures =
        surface_textures(material, renderer.mesh(surface.mesh), spare_units(renderer), low, water_map,
                         [&](const Texture& emission) { return renderer.mask_of(emission); });
    for (const std::string& sentence : textures.left_out) renderer.add_notice(sentence);
    std::vector<std::string_view> defines = defines_of(renderer, surface, possible, draw.chooses_lights, textures);
    defines.insert(defines.end(), inserted.begin(), inserted.end());
    draw.variant = variant_of(renderer, defines, textures.used);
    renderer.note_use(*variants_[static_cast<std::size_t>(draw.variant)].program, material.name);
    if (low) add_by_vertex(renderer, draw, textures, std::move(defines));
    if (draw.chooses_lights) {
        draw.light_set = static_cast<int>(light_sets_.size());
        lights.reserve(SURFACE_LIGHT_LIMIT + 1);
        light_sets_.push_back({.own = true, .lights = std::move(lights)});
    } else {
        draw.light_set = light_set_of(std::move(lights));
    }
    Look look{.uv_mapping = rows_of(textures.first),
              .uv_b_mapping = rows_of(textures.second),
              .emission = textures.emission,
              .textures = {}};
    const bool decoded = !low && renderer.caps().srgb_textures;
    for (const SurfaceTexture& texture : textures.used) {
        const TextureUse use = use_of(material, texture, decoded);
        look.textures.push_back({texture.unit, texture.packed
                                                   ? renderer.packed_texture(texture.texture, texture.packed, use)
                                                   : renderer.texture(texture.texture, use)});
    }
    looks_.push_back(std::move(look));
    draws_.push_back(draw);
}

// Beside the program of `defines`, which the draw has, the one for afar: where no texture and no other effect makes a fragment
// differ from what lies between its vertices.
void SurfaceWork::add_by_vertex(Renderer& renderer, Draw& draw, const SurfaceTextures& textures,
                                std::vector<std::string_view> defines) {
    const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draw.surface)];
    const Material& material = material_of(renderer, surface);
    const bool plain = textures.used.empty() && !is_unlit(material) && !material.double_sided &&
                       material.alpha_mode == AlphaMode::opaque && !draw.changes_shape;
    const bool rough = mirrors_by_vertex(material);
    defines.push_back("LIT_BY_VERTEX");
    if (rough) defines.push_back("MIRROR_BY_VERTEX");
    if (!plain || !vertices_carry_insertions(renderer.plan(), defines)) return;
    if (!turns_gently(renderer.scene().meshes[static_cast<std::size_t>(surface.mesh)])) return;
    const int by_vertex = variant_of(renderer, defines, textures.used);
    Variant& own = variants_[static_cast<std::size_t>(draw.variant)];
    (rough ? own.mirror_by_vertex : own.by_vertex) = by_vertex;
    renderer.note_use(*variants_[static_cast<std::size_t>(by_vertex)].program, material.name);
    draw.lights_vertices = true;
}

SurfaceWork::SurfaceWork(Renderer& renderer, const EffectCard& card, SurfacePart part) : card_(card), part_(part) {
    const Scene& scene = renderer.scene();
    int suns = 0;
    for (const Light& light : scene.lights) {
        if (light.kind != LightKind::sun) continue;
        if (suns++ == 0) sun_ = &light;
    }
    if (suns > 1) renderer.add_notice(fmt::format("the scene has {} suns and one is drawn: {}", suns, sun_->name));
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const bool blends = material_of(renderer, scene.surfaces[i]).alpha_mode == AlphaMode::blend;
        if (blends == (part == SurfacePart::transparent)) add_draw(renderer, static_cast<int>(i));
    }
    if (crowded_ > 0) {
        const std::string others =
            crowded_ < 2 ? "" : fmt::format("; {} more of {} surfaces lose some", crowded_ - 1, crowded_);
        renderer.add_notice(fmt::format("{} lights reach {} and {} are drawn: the {} weakest are left out{}",
                                        most_left_out_ + SURFACE_LIGHT_LIMIT, most_crowded_, SURFACE_LIGHT_LIMIT,
                                        most_left_out_, others));
    }
    const bool depth_is_there = std::ranges::any_of(renderer.plan().passes, [](const Pass& pass) {
        return pass.effect != "surface" && pass.writes_depth && pass.order == PassOrder::depth;
    });
    places_.resize(draws_.size());
    if (part == SurfacePart::transparent) order_by_ = OrderBy::far_first;
    else if (depth_is_there) order_by_ = OrderBy::state;
    if (part == SurfacePart::opaque) rank_states();
    order_.resize(draws_.size());
    sorting_.resize(draws_.size());
}

// Fewest changes of program, then of material, then (where depth is there already) of mesh.
void SurfaceWork::rank_states() {
    const auto mesh = [&](const Draw& draw) { return order_by_ == OrderBy::state ? draw.mesh : 0; };
    const auto before = [&](const Draw& a, const Draw& b) {
        return std::tuple(a.variant, a.material, mesh(a)) < std::tuple(b.variant, b.material, mesh(b));
    };
    // The scene's order decides the rest, so that every run is the same. A list is sorted in the place of the draws:
    // std::stable_sort's buffer forgets alignments above 16.
    std::vector<const Draw*> order;
    for (const Draw& draw : draws_) order.push_back(&draw);
    std::ranges::stable_sort(order, [&](const Draw* a, const Draw* b) { return before(*a, *b); });
    std::vector<Draw> sorted;
    sorted.reserve(draws_.size());
    for (const Draw* draw : order) sorted.push_back(*draw);
    draws_ = std::move(sorted);
    for (std::size_t i = 1; i < draws_.size(); ++i)
        places_[i].state = places_[i - 1].state + (before(draws_[i - 1], draws_[i]) ? 1 : 0);
}

void SurfaceWork::set_variant(Renderer& renderer, const View& view, Variant& variant) {
    gl::EntryPoints& gl = renderer.gl();
    const float unknown = std::numeric_limits<float>::quiet_NaN();  // equals nothing: all is told anew
    variant.told_light_set = -1;
    variant.told_uv_range = variant.told_uv1_range = variant.told_direction_scale = variant.told_toward_eye =
        glm::vec4(unknown);
    set(gl, variant.ambient, glm::vec4(exposed(renderer.scene().ambient, view.exposure), 0.0f));
    set(gl, variant.lit_ambient, glm::vec4(exposed(renderer.scene().ambient, view.exposure), 0.0f));
    set(gl, variant.parallel_eye, view.orthographic ? glm::vec4(direction_to_eye(view), 0.0f) : kNotParallel);
    if (sun_) {
        const glm::vec4 direction(-glm::normalize(sun_->direction), 0.0f);
        const glm::vec4 color(exposed(sun_->color, view.exposure), 0.0f);
        for (const int location : {variant.sun_direction, variant.lit_sun_direction}) set(gl, location, direction);
        for (const int location : {variant.sun_color, variant.lit_sun_color}) set(gl, location, color);
    }
}

/// A lit colour is a reflectance; one that nothing lights is a radiance; an unlit material's is what the display shows,
/// which the low tier takes encoded.
glm::vec4 SurfaceWork::base_color_of(const Renderer& renderer, const View& view, const Material& material,
                                     bool unlit) const {
    glm::vec3 color(material.base_color);
    if (is_unlit(material)) {
        if (renderer.tier_of(card_.name) == Tier::low) color = glm::convertLinearToSRGB(color);
    } else if (unlit) {
        color = exposed(color, view.exposure);
    }
    return {color, material.base_color.a};
}

void SurfaceWork::set_material(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw) {
    gl::EntryPoints& gl = renderer.gl();
    const Material& material = renderer.material(draw.material);
    set(gl, variant.base_color, base_color_of(renderer, view, material, variant.factors < 0));
    const Look& look = looks_[static_cast<std::size_t>(draw.look)];
    const glm::vec3 emissive =
        is_unlit(material) ? glm::vec3(0.0f) : exposed(material.emissive, view.exposure) * look.emission;
    set(gl, variant.emissive, glm::vec4(emissive, material.alpha_cutoff));
    set(gl, variant.factors, factors_of(material, variant.maps_roughness));
    set(gl, variant.specular_factors, specular_factors_of(material));
    if (variant.lit_albedo >= 0) {
        const VertexLitMaterial lit = vertex_lit(material);
        set(gl, variant.lit_albedo, lit.albedo);
        set(gl, variant.lit_specular, lit.specular);
        set(gl, variant.lit_metal, lit.metal);
        set(gl, variant.lit_emission, glm::vec4(emissive, 0.0f));
    }
    if (variant.uv_mapping >= 0) gl.Uniform4fv(variant.uv_mapping, 2, &look.uv_mapping[0].x);
    if (variant.uv_b_mapping >= 0) gl.Uniform4fv(variant.uv_b_mapping, 2, &look.uv_b_mapping[0].x);
    for (const TextureBinding& binding : look.textures) renderer.bind_texture(binding.unit, binding.texture);
    renderer.set_cull(!draw.double_sided);
    if (variant.has_insertions) renderer.feed_material(*variant.program, draw.material);
}

void SurfaceWork::set_matrices(Renderer& renderer, const View& view, Variant& variant, const Draw& draw,
                               const DrawMesh& mesh, const glm::dmat4& eye, const glm::mat4& clip, float scale) {
    gl::EntryPoints& gl = renderer.gl();
    const auto set_matrix = [&](int location, const glm::mat4& matrix) {
        if (location >= 0) gl.UniformMatrix4fv(location, 1, GL_FALSE, &matrix[0][0]);
    };
    const auto tell = [&](int location, glm::vec4& told, const glm::vec4& value) {
        if (location < 0 || told == value) return;
        told = value;
        set(gl, location, value);
    };
    set_matrix(variant.clip_from_local, clip);
    if (variant.eye_from_local >= 0) set_matrix(variant.eye_from_local, glm::mat4(eye));
    if (variant.normal_from_local >= 0) set_matrix(variant.normal_from_local, glm::mat4(draw.normal_from_local));
    tell(variant.uv_range, variant.told_uv_range, mesh.storage.uv_range);
    tell(variant.uv1_range, variant.told_uv1_range, mesh.storage.uv1_range);
    tell(variant.direction_scale, variant.told_direction_scale, mesh.direction_scale);
    if (variant.toward_eye < 0) return;
    const glm::vec3 toward = view.orthographic ? direction_to_eye(view) : glm::vec3(0.0f);
    tell(variant.toward_eye, variant.told_toward_eye, glm::vec4(toward, scale));
}

// What fragments multiply lengths by. Directions do not change.
//
// Without fragment highp, vertex_to_eye is scaled so that the farthest corner is 64 long: squares stay under 16384 (the
// least mediump must reach) and above half's smallest normal down to 1/8000 of that distance.
//
// With it, lengths are counted in the distance at which the strongest lamp shows 1, so that half holds every lamp in
// any unit: in millimetres a lamp of 3 is 3e6, past half's range, and its falloff 1e-6, below it. To the next power of
// two, so that no other rounding moves.
float SurfaceWork::fragment_length_scale(const Renderer& renderer, const View& view, const Draw& draw) const {
    if (renderer.caps().fragment_highp) return light_sets_[static_cast<std::size_t>(draw.light_set)].scale;
    const Box box = world_box(renderer.box(draw.surface), eye_from_local(view, draw.placed_at));
    const float farthest = glm::length(glm::max(glm::abs(box.low), glm::abs(box.high)));
    return 64.0f / std::max(farthest, 1e-3f);
}

float SurfaceWork::length_scale_of(const Renderer& renderer, const View& view, const LightSet& set) const {
    float strongest = 0.0f;
    for (const int light : set.lights) {
        const glm::vec3& color = renderer.scene().lights[static_cast<std::size_t>(light)].color;
        strongest = std::max({strongest, color.r, color.g, color.b});
    }
    strongest *= view.exposure;
    if (!(strongest > 1e-12f && strongest < 1e12f)) return 1.0f;  // dark, or past any meaning
    return std::exp2(-std::round(0.5f * std::log2(strongest)));
}

int SurfaceWork::light_set_of(std::vector<int> lights) {
    const auto known =
        std::ranges::find_if(light_sets_, [&](const LightSet& set) { return !set.own && set.lights == lights; });
    if (known != light_sets_.end()) return static_cast<int>(known - light_sets_.begin());
    light_sets_.push_back({.lights = std::move(lights)});
    return static_cast<int>(light_sets_.size()) - 1;
}

void SurfaceWork::set_lights(Renderer& renderer, const View& view, Variant& variant, const Draw& draw, float scale) {
    if (variant.light_position < 0) return;
    // The low tier lights its vertices, which are in highp and not scaled.
    if (renderer.tier_of(card_.name) == Tier::low) scale = 1.0f;
    if (variant.told_light_set == draw.light_set && variant.told_light_scale == scale) return;
    variant.told_light_set = draw.light_set;
    variant.told_light_scale = scale;
    const std::vector<int>& lights = light_sets_[static_cast<std::size_t>(draw.light_set)].lights;
    std::array<glm::vec4, SURFACE_LIGHT_LIMIT> position{}, color{}, direction{}, size{};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = renderer.scene().lights[static_cast<std::size_t>(lights[i])];
        const glm::dvec3 from_eye = glm::dvec3(light.position) - glm::dvec3(view.eye);
        const float range = light.range_m * scale;
        position[i] = glm::vec4(glm::vec3(from_eye) * scale, 1.0f / (range * range));
        float cone_scale = 0.0f;  // 0 says point
        if (light.kind == LightKind::spot) {
            const float cos_outer = std::cos(light.outer_cone_rad);
            cone_scale = 1.0f / std::max(std::cos(light.inner_cone_rad) - cos_outer, 1e-3f);
            direction[i] = glm::vec4(glm::normalize(light.direction), cos_outer);
        }
        color[i] = glm::vec4(light.color * (view.exposure * scale * scale), cone_scale);
        const float radius = std::max(light.radius_m, 0.0f) * scale;
        size[i] = glm::vec4(radius, radius * radius, 0.0f, 0.0f);
    }
    const auto count = static_cast<GLsizei>(lights.size());
    gl::EntryPoints& gl = renderer.gl();
    gl.Uniform4fv(variant.light_position, count, &position[0].x);
    gl.Uniform4fv(variant.light_color, count, &color[0].x);
    if (variant.light_direction >= 0) gl.Uniform4fv(variant.light_direction, count, &direction[0].x);
    if (variant.light_size >= 0) gl.Uniform4fv(variant.light_size, count, &size[0].x);
    set(gl, variant.light_count, glm::vec4(static_cast<float>(count), 0.0f, 0.0f, 0.0f));
}

// What changes its shape is stored as it is, so that its box needs no other measure.
bool SurfaceWork::is_outside(const Renderer& renderer, const Draw& draw, const glm::mat4& clip) {
    return outside_view(draw.changes_shape ? renderer.box(draw.surface) : renderer.mesh(draw.mesh).stored_box, clip);
}

// By what the material is now: one that was changed since it was prepared, and has no such program, is lit by fragment.
int SurfaceWork::chosen_variant(const Renderer& renderer, const Draw& draw, bool far) const {
    if (!far) return draw.variant;
    const Variant& own = variants_[static_cast<std::size_t>(draw.variant)];
    const int by_vertex = mirrors_by_vertex(renderer.material(draw.material)) ? own.mirror_by_vertex : own.by_vertex;
    return by_vertex >= 0 ? by_vertex : draw.variant;
}

void SurfaceWork::draw_one(Renderer& renderer, const View& view, Draw& draw, bool far) {
    const DrawMesh& mesh = renderer.mesh(draw.mesh);
    const glm::dmat4 eye = eye_from_stored(space_, draw.placed_at, mesh.stored);
    const glm::mat4 clip = clip_from_stored(space_, eye);
    if (is_outside(renderer, draw, clip)) return;
    const int chosen = chosen_variant(renderer, draw, far);
    Variant& variant = variants_[static_cast<std::size_t>(chosen)];
    if (current_variant_ != chosen) {
        renderer.use(*variant.program);
        if (!std::exchange(variant.told_frame, true)) set_variant(renderer, view, variant);
        current_variant_ = chosen;
        current_material_ = -1;
    }
    if (current_material_ != draw.material) {
        set_material(renderer, view, variant, draw);
        current_material_ = draw.material;
    }
    if (draw.chooses_lights) choose_lights(renderer, view, variant, draw);
    const bool scales = variant.toward_eye >= 0 || variant.light_position >= 0;
    const float scale = scales ? fragment_length_scale(renderer, view, draw) : 1.0f;
    set_matrices(renderer, view, variant, draw, mesh, eye, clip, scale);
    set_lights(renderer, view, variant, draw, scale);
    if (draw.changes_shape) renderer.draw_surface(draw.surface, variant.skin);
    else renderer.draw_mesh(mesh, &clip);
}

// The set is the draw's own: another choice is told to the program even where it was told this set before.
void SurfaceWork::choose_lights(const Renderer& renderer, const View& view, Variant& variant, const Draw& draw) {
    LightSet& set = light_sets_[static_cast<std::size_t>(draw.light_set)];
    int left_out = 0;
    lights_reaching(renderer.scene(), world_box(renderer.box(draw.surface), draw.placed_at), SURFACE_LIGHT_LIMIT,
                    set.lights, left_out);
    set.scale = length_scale_of(renderer, view, set);
    variant.told_light_set = -1;
}

void SurfaceWork::place_all(const Renderer& renderer) {
    const std::vector<Surface>& surfaces = renderer.scene().surfaces;
    const std::size_t last = draws_.size() - 1;
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        const auto soon = static_cast<std::size_t>(draws_[std::min(i + kAhead, last)].surface);
        will_read(&surfaces[soon].world_from_local, sizeof(glm::mat4));
        place(renderer, draws_[i], places_[i]);
    }
}

void SurfaceWork::place(const Renderer& renderer, Draw& draw, DrawPlace& place) {
    const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draw.surface)];
    const auto same = [](const glm::mat4& a,
                         const glm::mat4& b) {  // by bits: a zero that turned negative costs nothing
        using Bits = std::array<std::uint64_t, 8>;
        return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
    };
    if (!draw.changes_shape && same(draw.placed_at, surface.world_from_local)) return;
    draw.placed_at = surface.world_from_local;
    draw.normal_from_local = glm::mat3(normal_from_local(surface.world_from_local));
    const Box box = world_box(renderer.box(draw.surface), surface.world_from_local);
    place.centre = (box.low + box.high) * 0.5f;
    place.half = (box.high - box.low) * 0.5f;
    if (!draw.lights_vertices) return;
    const glm::vec3 diagonal = (box.high - box.low) * kFarInDiagonals;
    place.far_squared = glm::dot(diagonal, diagonal);
}

// Looks no further than it must: all looks of a frame together pass each draw at most once.
bool SurfaceWork::as_much_to_come(const Renderer& renderer, std::size_t from) const {
    std::int64_t triangles = 0;
    for (std::size_t i = from; i < order_.size() && triangles < kFlushTriangles; ++i) {
        const Draw& draw = draws_[order_[i].draw];
        const DrawMesh& mesh = renderer.mesh(draw.mesh);
        const glm::dmat4 eye = eye_from_stored(space_, draw.placed_at, mesh.stored);
        if (!is_outside(renderer, draw, clip_from_stored(space_, eye))) triangles += mesh.triangles();
    }
    return triangles >= kFlushTriangles;
}

void SurfaceWork::draw(Renderer& renderer, const View& view, int) {
    current_variant_ = -1;
    current_material_ = -1;
    renderer.set_color_mask(true);
    if (part_ == SurfacePart::opaque) {
        renderer.set_blend(Blend::none);
        renderer.set_depth(true, true, GL_LEQUAL);
    } else {
        renderer.set_blend(Blend::alpha);
        renderer.set_depth(true, false, GL_LEQUAL);
    }
    space_ = view_space(view);
    for (Variant& variant : variants_) variant.told_frame = false;
    for (LightSet& set : light_sets_) set.scale = length_scale_of(renderer, view, set);
    place_all(renderer);
    order_draws(places_, view, order_by_, order_, sorting_);
    bool may_flush = true;
    for (std::size_t i = 0; i < order_.size(); ++i) {
        will_read(&draws_[order_[std::min(i + kAhead, order_.size() - 1)].draw], sizeof(Draw));
        if (may_flush && renderer.flush_is_due()) {
            may_flush = as_much_to_come(renderer, i);
            if (may_flush) renderer.flush();
        }
        draw_one(renderer, view, draws_[order_[i].draw], order_[i].far);
    }
}

}  // namespace halfframe
