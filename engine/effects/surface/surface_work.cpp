// Prepares and draws surfaces. The CPU multiplies lights by the exposure, subtracts the eye in double, and sorts.
#include "engine/effects/surface/surface_work.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/color_space.hpp>

#include "engine/effects/surface/surface.h"
#include "engine/frame/camera_space.h"
#include "engine/frame/frame_plan.h"

namespace halfframe {

namespace {

void set(gl::EntryPoints& gl, int location, const glm::vec4& value) {
    if (location >= 0) gl.Uniform4fv(location, 1, &value.x);
}

constexpr glm::vec4 kNotParallel{0.0f, 0.0f, 0.0f, 1.0f};

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
    const float roughness = glossy ? 1.0f - material.smoothness : material.roughness;
    const float alpha_squared = std::pow(roughness, 4.0f);
    const auto least = static_cast<float>(2.0 / (SURFACE_POWER_MAX + 2.0));
    const float power = std::max(2.0f / std::max(alpha_squared, least) - 2.0f, static_cast<float>(SURFACE_POWER_MIN));
    const float smoothness = std::clamp((std::log2(power) - 1.0f) * 0.1f, 0.0f, 1.0f);
    return {metallic, smoothness, material.normal_scale, power};
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
    return renderer.scene().materials[static_cast<std::size_t>(surface.material)];
}

}  // namespace

std::vector<std::string_view> SurfaceWork::defines_of(const Renderer& renderer, const Surface& surface,
                                                      std::span<const int> lights,
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
        if (lights.size() <= kCounts.size()) defines.push_back(kCounts[lights.size() - 1]);
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
    return defines;
}

int SurfaceWork::variant_of(Renderer& renderer, const std::vector<std::string_view>& defines,
                            std::span<const SurfaceTexture> textures) {
    gl::Program& program = renderer.program(card_, 0, defines);
    for (std::size_t i = 0; i < variants_.size(); ++i) {
        if (variants_[i].program == &program) return static_cast<int>(i);
    }
    Variant variant;
    variant.program = &program;
    variant.maps_roughness = std::ranges::any_of(defines, [](std::string_view define) {
        return define == "METALLIC_ROUGHNESS_MAP" || define == "SPECULAR_GLOSSINESS_MAP";
    });
    variant.uv_mapping = program.uniform_if_used("uv_mapping");
    variant.uv_b_mapping = program.uniform_if_used("uv_b_mapping");
    variant.specular_factors = program.uniform_if_used("specular_factors");
    variant.clip_from_local = program.uniform("clip_from_local");
    variant.eye_from_local = program.uniform_if_used("eye_from_local");
    variant.normal_from_local = program.uniform_if_used("normal_from_local");
    variant.toward_eye = program.uniform_if_used("toward_eye");
    variant.base_color = program.uniform_if_used("base_color");
    variant.emissive = program.uniform_if_used("emissive");
    variant.factors = program.uniform_if_used("factors");
    variant.ambient = program.uniform_if_used("ambient");
    variant.parallel_eye = program.uniform_if_used("parallel_eye");
    variant.sun_direction = program.uniform_if_used("sun_direction");
    variant.sun_color = program.uniform_if_used("sun_color");
    variant.light_position = program.uniform_if_used("light_position");
    variant.light_color = program.uniform_if_used("light_color");
    variant.light_direction = program.uniform_if_used("light_direction");
    variant.light_size = program.uniform_if_used("light_size");
    variant.light_count = program.uniform_if_used("light_count");
    renderer.use(program);
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
    Draw draw{.variant = 0,
              .surface = index,
              .material = surface.material,
              .double_sided = material.double_sided,
              .textures = {},
              .lights = {}};
    int left_out = 0;
    draw.lights =
        lights_reaching(renderer.scene(), world_box(renderer.mesh(surface.mesh).box, surface.world_from_local),
                        SURFACE_LIGHT_LIMIT, left_out);
    if (left_out > 0) {
        renderer.add_notice(fmt::format("{} lights reach {} and {} are drawn: the {} weakest are left out",
                                        left_out + SURFACE_LIGHT_LIMIT, surface.name, SURFACE_LIGHT_LIMIT, left_out));
    }
    const bool low = renderer.tier_of(card_.name) == Tier::low;
    const SurfaceTextures textures =
        surface_textures(material, renderer.mesh(surface.mesh), spare_units(renderer), low);
    for (const std::string& sentence : textures.left_out) renderer.add_notice(sentence);
    draw.variant = variant_of(renderer, defines_of(renderer, surface, draw.lights, textures), textures.used);
    draw.uv_mapping = rows_of(textures.first);
    draw.uv_b_mapping = rows_of(textures.second);
    const bool decoded = !low && renderer.caps().srgb_textures;
    for (const SurfaceTexture& texture : textures.used)
        draw.textures.push_back({texture.unit, renderer.texture(texture.texture, texture.srgb && decoded)});
    draws_.push_back(std::move(draw));
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
    order_.resize(draws_.size());
    if (part == SurfacePart::transparent) return;
    // Fewest changes of program, then of material; the scene's order decides the rest, so that every run is the same.
    std::ranges::stable_sort(draws_, [](const Draw& a, const Draw& b) {
        return std::tie(a.variant, a.material) < std::tie(b.variant, b.material);
    });
}

void SurfaceWork::set_variant(Renderer& renderer, const View& view, const Variant& variant) {
    gl::EntryPoints& gl = renderer.gl();
    renderer.use(*variant.program);
    set(gl, variant.ambient, glm::vec4(renderer.scene().ambient * view.exposure, 0.0f));
    set(gl, variant.parallel_eye, view.orthographic ? glm::vec4(direction_to_eye(view), 0.0f) : kNotParallel);
    if (sun_) {
        set(gl, variant.sun_direction, glm::vec4(-glm::normalize(sun_->direction), 0.0f));
        set(gl, variant.sun_color, glm::vec4(sun_->color * view.exposure, 0.0f));
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
        color *= view.exposure;
    }
    return {color, material.base_color.a};
}

void SurfaceWork::set_material(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw) {
    gl::EntryPoints& gl = renderer.gl();
    const Material& material = renderer.scene().materials[static_cast<std::size_t>(draw.material)];
    set(gl, variant.base_color, base_color_of(renderer, view, material, variant.factors < 0));
    const glm::vec3 emissive = is_unlit(material) ? glm::vec3(0.0f) : material.emissive * view.exposure;
    set(gl, variant.emissive, glm::vec4(emissive, material.alpha_cutoff));
    set(gl, variant.factors, factors_of(material, variant.maps_roughness));
    set(gl, variant.specular_factors, specular_factors_of(material));
    if (variant.uv_mapping >= 0) gl.Uniform4fv(variant.uv_mapping, 2, &draw.uv_mapping[0].x);
    if (variant.uv_b_mapping >= 0) gl.Uniform4fv(variant.uv_b_mapping, 2, &draw.uv_b_mapping[0].x);
    for (const TextureBinding& binding : draw.textures) renderer.bind_texture(binding.unit, binding.texture);
    renderer.set_cull(!draw.double_sided);
}

void SurfaceWork::set_matrices(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw,
                               const glm::mat4& clip) {
    gl::EntryPoints& gl = renderer.gl();
    const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draw.surface)];
    const glm::mat4 eye = eye_from_local(view, surface.world_from_local);
    const auto set_matrix = [&](int location, const glm::mat4& matrix) {
        if (location >= 0) gl.UniformMatrix4fv(location, 1, GL_FALSE, &matrix[0][0]);
    };
    set_matrix(variant.clip_from_local, clip);
    set_matrix(variant.eye_from_local, eye);
    if (variant.normal_from_local >= 0)
        set_matrix(variant.normal_from_local, normal_from_local(surface.world_from_local));
    if (variant.toward_eye < 0) return;
    const float scale = fragment_length_scale(renderer, view, draw);
    const glm::vec3 toward = view.orthographic ? direction_to_eye(view) : glm::vec3(0.0f);
    set(gl, variant.toward_eye, glm::vec4(toward, scale));
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
    if (!renderer.caps().fragment_highp) {
        const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draw.surface)];
        const Box box = world_box(renderer.mesh(surface.mesh).box, eye_from_local(view, surface.world_from_local));
        const float farthest = glm::length(glm::max(glm::abs(box.low), glm::abs(box.high)));
        return 64.0f / std::max(farthest, 1e-3f);
    }
    float strongest = 0.0f;
    for (const int light : draw.lights) {
        const glm::vec3& color = renderer.scene().lights[static_cast<std::size_t>(light)].color;
        strongest = std::max({strongest, color.r, color.g, color.b});
    }
    strongest *= view.exposure;
    if (!(strongest > 1e-12f && strongest < 1e12f)) return 1.0f;  // dark, or past any meaning
    return std::exp2(-std::round(0.5f * std::log2(strongest)));
}

void SurfaceWork::set_lights(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw) {
    if (variant.light_position < 0) return;
    std::array<glm::vec4, SURFACE_LIGHT_LIMIT> position{}, color{}, direction{}, size{};
    // The low tier lights its vertices, which are in highp and not scaled.
    const bool by_vertex = renderer.tier_of(card_.name) == Tier::low;
    const float scale = by_vertex ? 1.0f : fragment_length_scale(renderer, view, draw);
    for (std::size_t i = 0; i < draw.lights.size(); ++i) {
        const Light& light = renderer.scene().lights[static_cast<std::size_t>(draw.lights[i])];
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
    const auto count = static_cast<GLsizei>(draw.lights.size());
    gl::EntryPoints& gl = renderer.gl();
    gl.Uniform4fv(variant.light_position, count, &position[0].x);
    gl.Uniform4fv(variant.light_color, count, &color[0].x);
    if (variant.light_direction >= 0) gl.Uniform4fv(variant.light_direction, count, &direction[0].x);
    if (variant.light_size >= 0) gl.Uniform4fv(variant.light_size, count, &size[0].x);
    set(gl, variant.light_count, glm::vec4(static_cast<float>(count), 0.0f, 0.0f, 0.0f));
}

void SurfaceWork::draw_one(Renderer& renderer, const View& view, const Draw& draw) {
    const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draw.surface)];
    const DrawMesh& mesh = renderer.mesh(surface.mesh);
    const glm::mat4 clip = clip_from_local(view, surface.world_from_local);
    if (outside_view(mesh.box, clip)) return;
    const Variant& variant = variants_[static_cast<std::size_t>(draw.variant)];
    if (current_variant_ != draw.variant) {
        set_variant(renderer, view, variant);
        current_variant_ = draw.variant;
        current_material_ = -1;
    }
    if (current_material_ != draw.material) {
        set_material(renderer, view, variant, draw);
        current_material_ = draw.material;
    }
    set_matrices(renderer, view, variant, draw, clip);
    set_lights(renderer, view, variant, draw);
    renderer.draw_mesh(mesh);
}

void SurfaceWork::sort_by_distance(const Renderer& renderer, const View& view) {
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(draws_[i].surface)];
        const Box box = world_box(renderer.mesh(surface.mesh).box, surface.world_from_local);
        const glm::vec3 from_eye = (box.low + box.high) * 0.5f - view.eye;
        order_[i] = {static_cast<double>(glm::dot(from_eye, from_eye)), static_cast<int>(i)};
    }
    if (part_ == SurfacePart::transparent) {
        std::ranges::sort(order_, [](const Order& a, const Order& b) {
            return a.distance != b.distance ? a.distance > b.distance : a.draw < b.draw;  // equal distances never swap
        });
        return;
    }
    // draws_ stands by state already; inside one state the nearer hide the farther before these are shaded.
    std::ranges::sort(order_, [this](const Order& a, const Order& b) {
        const Draw& first = draws_[static_cast<std::size_t>(a.draw)];
        const Draw& second = draws_[static_cast<std::size_t>(b.draw)];
        return std::tie(first.variant, first.material, a.distance, a.draw) <
               std::tie(second.variant, second.material, b.distance, b.draw);
    });
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
    sort_by_distance(renderer, view);
    for (const Order& order : order_) draw_one(renderer, view, draws_[static_cast<std::size_t>(order.draw)]);
}

}  // namespace halfframe
