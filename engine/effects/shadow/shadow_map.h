// The sun's map: draws casters into it, and feeds the surfaces that look themselves up in it. Console and reference.
#pragma once

#include <optional>
#include <vector>

#include "engine/effects/shadow/shadow_fit.h"
#include "engine/frame/renderer.h"

namespace halfframe {

class ShadowMap final : public EffectWork {
public:
    explicit ShadowMap(Renderer& renderer);
    void draw(Renderer& renderer, const View& view, int phase) override;
    /// The map is drawn anew when the fit has moved, or a surface that casts, or the sun.
    [[nodiscard]] bool still_holds(const Renderer& renderer, const View& view, int phase) const override;
    int adopt(Renderer& renderer, gl::Program& program) override;
    void feed(Renderer& renderer, const View& view, int adopted) override;

private:
    /// A program of casters and where its uniforms are.
    struct Variant {
        gl::Program* program = nullptr;
        int clip_from_local = -1, mask = -1, uv_range = -1;
    };
    struct Caster {
        int body = 0;
        int variant = 0;
        glm::vec4 mask{0.0f};
        std::uint32_t texture = 0;
        glm::mat4 drawn_at{0.0f};  ///< where it stood when the map was drawn
    };
    /// An adopted program and where what we inserted is.
    struct Receiver {
        int from_eye = -1, toward = -1;
    };

    int variant_of(Renderer& renderer, const std::vector<std::string_view>& defines);
    void add_caster(Renderer& renderer, int body);
    [[nodiscard]] std::optional<ShadowFit> fit(const Renderer& renderer, const View& view) const;
    void draw_casters(Renderer& renderer);

    int map_texels_ = 0;
    float reach_texels_ = 0.0f;
    int target_ = -1;
    std::vector<ShadowBody> bodies_;
    std::vector<Variant> variants_;
    std::vector<Caster> casters_;
    std::vector<Receiver> receivers_;
    bool drawn_ = false;
    std::optional<ShadowFit> drawn_fit_;  ///< nothing: no receiver was in view, the map is empty
};

}  // namespace halfframe
