// Draws the surfaces of a scene: one list of draws made while preparing, walked twice a frame.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/effects/surface/surface_textures.h"
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
        bool maps_roughness = false;
        int uv_mapping = -1, uv_b_mapping = -1, specular_factors = -1;
        int clip_from_local = -1, eye_from_local = -1, normal_from_local = -1, toward_eye = -1;
        int base_color = -1, emissive = -1, factors = -1, ambient = -1, parallel_eye = -1;
        int sun_direction = -1, sun_color = -1;
        int light_position = -1, light_color = -1, light_direction = -1, light_size = -1, light_count = -1;
    };
    struct TextureBinding {
        int unit;
        std::uint32_t texture;
    };
    struct Draw {
        int variant = 0;
        int surface = 0;
        int material = 0;
        bool double_sided = false;
        UvRows uv_mapping{}, uv_b_mapping{};
        std::vector<TextureBinding> textures;
        std::vector<int> lights;
    };

    [[nodiscard]] std::vector<std::string_view> defines_of(const Renderer& renderer, const Surface& surface,
                                                           std::span<const int> lights,
                                                           const SurfaceTextures& textures) const;
    int variant_of(Renderer& renderer, const std::vector<std::string_view>& defines,
                   std::span<const SurfaceTexture> textures);
    void add_draw(Renderer& renderer, int surface);
    void sort_by_distance(const Renderer& renderer, const View& view);
    void set_variant(Renderer& renderer, const View& view, const Variant& variant);
    void set_material(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw);
    [[nodiscard]] glm::vec4 base_color_of(const Renderer& renderer, const View& view, const Material& material,
                                          bool unlit) const;
    void set_matrices(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw,
                      const glm::mat4& clip);
    [[nodiscard]] float fragment_length_scale(const Renderer& renderer, const View& view, const Draw& draw) const;
    void set_lights(Renderer& renderer, const View& view, const Variant& variant, const Draw& draw);
    void draw_one(Renderer& renderer, const View& view, const Draw& draw);

    const EffectCard& card_;
    SurfacePart part_;
    const Light* sun_ = nullptr;
    std::vector<Variant> variants_;
    std::vector<Draw> draws_;
    struct Order {
        double distance;
        int draw;
    };
    std::vector<Order> order_;  ///< of draws_ in this frame; sized while preparing
    int current_variant_ = -1;
    int current_material_ = -1;
};

}  // namespace halfframe
