// Draws the sun's map and feeds its readers.
#include "engine/effects/shadow/shadow_map.h"

#include <algorithm>

#include "engine/effects/shadow/shadow.h"
#include "engine/frame/camera_space.h"
#include "shaders_es/shadow/shadow_limits.h"

namespace halfframe {

namespace {

// The lift along the normal (shadow.glsl) covers the filter on every plane. What is left is that a texel holds the
// depth of its centre, half a texel away, hence 1 times the slope; and two steps of the depth buffer for its rounding.
constexpr float kSlopeOffset = 1.0f;
constexpr float kStepOffset = 2.0f;

const Surface& surface_of(const Renderer& renderer, const ShadowBody& body) {
    return renderer.scene().surfaces[static_cast<std::size_t>(body.surface)];
}

}  // namespace

ShadowMap::ShadowMap(Renderer& renderer) {
    const bool reference = renderer.tier_of(kShadow.name) == Tier::reference;
    map_texels_ = reference ? SHADOW_MAP_SIZE_REFERENCE : SHADOW_MAP_SIZE_CONSOLE;
    reach_texels_ = static_cast<float>(reference ? SHADOW_REACH_REFERENCE : SHADOW_REACH_CONSOLE);
    target_ = renderer.plan().target_index("shadow_map");
    const Scene& scene = renderer.scene();
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const ShadowBody body = shadow_body(scene, static_cast<int>(i), renderer.box(static_cast<int>(i)));
        if (!body.casts && !body.receives) continue;
        bodies_.push_back(body);
        if (body.casts) add_caster(renderer, static_cast<int>(bodies_.size()) - 1);
    }
    drawn_shapes_.resize(bodies_.size());
    std::ranges::stable_sort(casters_, {}, &Caster::variant);  // fewest changes of program
}

int ShadowMap::variant_of(Renderer& renderer, const std::vector<std::string_view>& defines) {
    gl::Program& program = renderer.program(kShadow, 0, defines);
    const auto known = std::ranges::find(variants_, &program, &Variant::program);
    if (known != variants_.end()) return static_cast<int>(known - variants_.begin());
    const int skin = renderer.claim_skin(program);
    if (const int map = program.uniform_if_used("base_color_map"); map >= 0)
        renderer.gl().Uniform1i(map, kBaseColorUnit);
    variants_.push_back({&program, program.uniform("clip_from_local"), program.uniform_if_used("mask"),
                         program.uniform_if_used("uv_range"), program.uniform_if_used("uv1_range"),
                         program.uniform_if_used("uv_mapping"), skin});
    program.expect_all_uniforms_claimed();
    return static_cast<int>(variants_.size()) - 1;
}

void ShadowMap::add_caster(Renderer& renderer, int body) {
    const Surface& surface = surface_of(renderer, bodies_[static_cast<std::size_t>(body)]);
    const Material& material = renderer.material(surface.material);
    Caster caster;
    caster.body = body;
    std::vector<std::string_view> defines;
    if (material.alpha_mode == AlphaMode::mask) {
        defines.push_back("ALPHA_MASK");
        caster.mask = {material.base_color.a, material.alpha_cutoff, 0.0f, 0.0f};
        if (renderer.mesh(surface.mesh).has_colors) defines.push_back("VERTEX_COLOR");
        const UvMapping& uv = material.base_color_uv;
        if (material.base_color_texture && (uv.set == 0 || renderer.mesh(surface.mesh).has_uv1)) {
            defines.push_back("BASE_COLOR_MAP");
            if (uv.set == 1) defines.push_back("UV_FROM_1");
            if (!is_plain(uv)) defines.push_back("UV_MAPPED");
            caster.uv_mapping = rows_of(uv);
            // Decoded as surface has it, so that the device holds it once.
            caster.texture =
                renderer.texture(material.base_color_texture, base_color_use(material, renderer.caps().srgb_textures));
        }
    }
    if (const std::string_view skin = renderer.skin_define(bodies_[static_cast<std::size_t>(body)].surface);
        !skin.empty())
        defines.push_back(skin);
    caster.variant = variant_of(renderer, defines);
    casters_.push_back(caster);
}

std::optional<ShadowFit> ShadowMap::fit(const Renderer& renderer, const View& view) const {
    const Light* sun = shining_sun(renderer.scene());
    if (sun == nullptr) return std::nullopt;  // put out since the plan was made, or switched on by hand
    return fit_shadow(renderer.scene(), bodies_, sun->direction, view);
}

bool ShadowMap::still_holds(const Renderer& renderer, const View& view, int) const {
    if (!drawn_) return false;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (renderer.shape(bodies_[i].surface) != drawn_shapes_[i]) return false;
    }
    if (fit(renderer, view) != drawn_fit_) return false;
    return std::ranges::all_of(casters_, [&](const Caster& caster) {
        return surface_of(renderer, bodies_[static_cast<std::size_t>(caster.body)]).world_from_local == caster.drawn_at;
    });
}

void ShadowMap::draw(Renderer& renderer, const View& view, int) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        bodies_[i].local = renderer.box(bodies_[i].surface);
        drawn_shapes_[i] = renderer.shape(bodies_[i].surface);
    }
    drawn_fit_ = fit(renderer, view);
    drawn_ = true;
    for (Caster& caster : casters_) {
        const ShadowBody& body = bodies_[static_cast<std::size_t>(caster.body)];
        caster.drawn_at = surface_of(renderer, body).world_from_local;
    }
    if (drawn_fit_) draw_casters(renderer);
}

void ShadowMap::draw_casters(Renderer& renderer) {
    gl::EntryPoints& gl = renderer.gl();
    const int drawn_texels = map_texels_ - 2 * SHADOW_MAP_RIM;
    gl.Viewport(SHADOW_MAP_RIM, SHADOW_MAP_RIM, drawn_texels, drawn_texels);
    renderer.set_depth(true, true, GL_LEQUAL);
    renderer.set_blend(Blend::none);
    // A wall seen from outside stops the sun too, though its front looks into the room.
    renderer.set_cull(false);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(kSlopeOffset, kStepOffset);
    for (const Caster& caster : casters_) {
        const ShadowBody& body = bodies_[static_cast<std::size_t>(caster.body)];
        const glm::mat4 matrix = shadow_clip_from_local(*drawn_fit_, caster.drawn_at);
        if (outside_view(body.local, matrix)) continue;
        const Variant& variant = variants_[static_cast<std::size_t>(caster.variant)];
        renderer.use(*variant.program);
        const DrawMesh& mesh = renderer.mesh(surface_of(renderer, body).mesh);
        const glm::mat4 stored = from_stored(matrix, mesh.storage);
        gl.UniformMatrix4fv(variant.clip_from_local, 1, GL_FALSE, &stored[0][0]);
        if (variant.uv_range >= 0) gl.Uniform4fv(variant.uv_range, 1, &mesh.storage.uv_range.x);
        if (variant.uv1_range >= 0) gl.Uniform4fv(variant.uv1_range, 1, &mesh.storage.uv1_range.x);
        if (variant.mask >= 0) gl.Uniform4fv(variant.mask, 1, &caster.mask.x);
        if (variant.uv_mapping >= 0) gl.Uniform4fv(variant.uv_mapping, 2, &caster.uv_mapping[0].x);
        if (caster.texture != 0) renderer.bind_texture(kBaseColorUnit, caster.texture);
        renderer.draw_surface(body.surface, variant.skin);
    }
    gl.PolygonOffset(0.0f, 0.0f);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
}

int ShadowMap::adopt(Renderer& renderer, gl::Program& program) {
    const Receiver receiver{program.uniform_if_used("shadow_from_eye"), program.uniform_if_used("shadow_toward")};
    const int map = program.uniform_if_used("shadow_map");
    if (map < 0) return -1;  // a variant that no sun lights
    renderer.gl().Uniform1i(map, kShadowUnit);
    receivers_.push_back(receiver);
    return static_cast<int>(receivers_.size()) - 1;
}

void ShadowMap::feed(Renderer& renderer, const View& view, int adopted) {
    const Receiver& receiver = receivers_[static_cast<std::size_t>(adopted)];
    glm::mat4 from_eye(0.0f);  // without a map everything is nearest to the sun: lit
    glm::vec4 toward(0.0f);
    if (drawn_fit_) {
        from_eye = shadow_from_eye(*drawn_fit_, view.eye, map_texels_);
        const glm::dvec3 along = glm::transpose(drawn_fit_->light_from_world)[2];
        toward =
            glm::vec4(glm::vec3(-along), reach_texels_ * static_cast<float>(shadow_texel_m(*drawn_fit_, map_texels_)));
    }
    if (receiver.from_eye >= 0) renderer.gl().UniformMatrix4fv(receiver.from_eye, 1, GL_FALSE, &from_eye[0][0]);
    if (receiver.toward >= 0) renderer.gl().Uniform4fv(receiver.toward, 1, &toward.x);
    renderer.bind_texture(kShadowUnit, renderer.target_texture(target_));
}

}  // namespace halfframe
