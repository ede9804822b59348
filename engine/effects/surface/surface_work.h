// Draws the surfaces of a scene: one list of draws made while preparing, walked twice a frame.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/effects/surface/draw_order.h"
#include "engine/effects/surface/surface_textures.h"
#include "engine/frame/camera_space.h"
#include "engine/frame/effect_card.h"
#include "engine/frame/renderer.h"
#include "engine/frame/uv_rows.h"
#include "shaders_es/surface/surface_limits.h"

namespace halfframe {

/// Which of a scene's surfaces are drawn: those that hide what is behind them, or those that blend, far to near.
enum class SurfacePart : std::uint8_t { opaque, transparent };

class SurfaceWork final : public EffectWork {
public:
    /// `card` gives tier and shaders: surface's own, or that of another effect with the same shaders.
    SurfaceWork(Renderer& renderer, const EffectCard& card, SurfacePart part);
    void draw(Renderer& renderer, const View& view, int phase) override;

private:
    /// A program and where its uniforms are; -1: this variant does not use it.
    struct Variant {
        gl::Program* program = nullptr;
        std::vector<std::string_view> defines;
        bool maps_roughness = false;
        bool has_insertions = false;  ///< of effects that may want to know the material
        int by_vertex = -1;           ///< in variants_: the same, lit by vertex; -1: there is none
        int mirror_by_vertex = -1;    ///< and with what is mirrored, for rough materials
        int uv_mapping = -1, uv_b_mapping = -1, specular_factors = -1;
        int clip_from_local = -1, eye_from_local = -1, normal_from_local = -1, toward_eye = -1;
        int uv_range = -1, uv1_range = -1, direction_scale = -1;
        int base_color = -1, emissive = -1, factors = -1, ambient = -1, parallel_eye = -1;
        int sun_direction = -1, sun_color = -1;
        int lit_albedo = -1, lit_specular = -1, lit_metal = -1, lit_emission = -1, lit_ambient = -1;
        int lit_sun_direction = -1, lit_sun_color = -1;
        // What the program was last told, in this frame.
        bool told_frame = false;  ///< what is the same for all that it draws
        glm::vec4 told_uv_range{0.0f}, told_uv1_range{0.0f}, told_direction_scale{0.0f}, told_toward_eye{0.0f};
        int told_light_set = -1;
        float told_light_scale = 0.0f;
        int light_position = -1, light_color = -1, light_direction = -1, light_size = -1, light_count = -1;
        int skin = -1;
    };
    struct TextureBinding {
        int unit;
        std::uint32_t texture;
    };
    /// Two cache lines: all that a frame reads of a draw that changes no state. In a large scene waiting for memory is
    /// most of what a draw costs us.
    struct alignas(64) Draw {
        int variant = 0;
        int surface = 0;
        int mesh = 0;
        int material = 0;
        int light_set = 0;
        int look = 0;  ///< in looks_
        bool double_sided = false;
        bool changes_shape = false;
        bool chooses_lights = false;  ///< anew in every frame: it moves, or a lamp does
        bool lights_vertices = false;  ///< from afar, with the variant of its variant
        // What follows from the place of the surface, until it moves.
        glm::mat3 normal_from_local{1.0f};
        glm::mat4 placed_at{0.0f};
    };
    /// What is read of a draw whose material is not that of the draw before.
    struct Look {
        UvRows uv_mapping{}, uv_b_mapping{};
        glm::vec3 emission{1.0f};  ///< SurfaceTextures::emission
        std::vector<TextureBinding> textures;
    };
    /// The lights of one object or many, and what their lengths are multiplied with in this frame.
    struct LightSet {
        bool own = false;  ///< of one object that chooses anew in every frame
        std::vector<int> lights;
        float scale = 1.0f;
    };

    [[nodiscard]] std::vector<std::string_view> defines_of(const Renderer& renderer, const Surface& surface,
                                                           std::span<const int> lights, bool chooses_lights,
                                                           const SurfaceTextures& textures) const;
    [[nodiscard]] bool chooses_lights(const Scene& scene, const Surface& surface) const;
    int variant_of(Renderer& renderer, const std::vector<std::string_view>& defines,
                   std::span<const SurfaceTexture> textures);
    void add_draw(Renderer& renderer, int surface);
    void add_by_vertex(Renderer& renderer, Draw& draw, const SurfaceTextures& textures,
                       std::vector<std::string_view> defines);
    void rank_states();
    void place_all(const Renderer& renderer);
    void place(const Renderer& renderer, Draw& draw, DrawPlace& place);
    void set_variant(Renderer& renderer, const View& view, Variant& variant);
    void set_material(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw);
    [[nodiscard]] glm::vec4 base_color_of(const Renderer& renderer, const View& view, const Material& material,
                                          bool unlit) const;
    void set_matrices(Renderer& renderer, const View& view, Variant& variant, const Draw& draw, const DrawMesh& mesh,
                      const glm::dmat4& eye, const glm::mat4& clip, float scale);
    [[nodiscard]] float fragment_length_scale(const Renderer& renderer, const View& view, const Draw& draw) const;
    [[nodiscard]] float length_scale_of(const Renderer& renderer, const View& view, const LightSet& set) const;
    int light_set_of(std::vector<int> lights);
    void choose_lights(const Renderer& renderer, const View& view, Variant& variant, const Draw& draw);
    void set_lights(Renderer& renderer, const View& view, Variant& variant, const Draw& draw, float scale);
    [[nodiscard]] static bool is_outside(const Renderer& renderer, const Draw& draw, const glm::mat4& clip);
    [[nodiscard]] bool as_much_to_come(const Renderer& renderer, std::size_t from) const;
    [[nodiscard]] int chosen_variant(const Renderer& renderer, const Draw& draw, bool far) const;
    void draw_one(Renderer& renderer, const View& view, Draw& draw, bool far);

    const EffectCard& card_;
    int crowded_ = 0;  ///< surfaces that more lights reach than are drawn, and the worst of them
    int most_left_out_ = 0;
    std::string most_crowded_;
    SurfacePart part_;
    const Light* sun_ = nullptr;
    std::vector<Variant> variants_;
    std::vector<LightSet> light_sets_;
    std::vector<Draw> draws_;
    std::vector<DrawPlace> places_;  ///< one for each of draws_
    std::vector<Look> looks_;
    std::vector<DrawOrder> order_;    ///< of draws_ in this frame; sized while preparing
    std::vector<DrawOrder> sorting_;  ///< as large: what sorting needs
    OrderBy order_by_ = OrderBy::large_first;
    ViewSpace space_;              ///< of the frame being drawn
    int current_variant_ = -1;
    int current_material_ = -1;
};

}  // namespace halfframe
