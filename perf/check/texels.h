// What a material is at each of its texels, and which rules it breaks there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/frame/scene.h"
#include "perf/check/rules.h"
#include "perf/check/thresholds.h"

namespace halfframe::check {

/// sRGB code 0..255, not rounded, of linear light 0..1, and back. IEC 61966-2-1.
[[nodiscard]] double code_of_light(double light);
[[nodiscard]] double light_of_code(double code);

/// Both colours as the sRGB code of their luminance (Rec. 709): the charts bound brightness, not single channels, or
/// gold with its blue of 155 would be no metal.
struct Texel {
    double albedo_code = 0.0;
    double specular_code = 0.0;
    double metallic = 0.0;    ///< 0..1; of specular-glossiness: 1 where the specular is that of a metal
    double smoothness = 0.0;  ///< the talk's, 0..1
    double alpha = 1.0;
    bool shines = false;  ///< gives more light of its own than charcoal reflects: lamps and signs may be black
    bool metal = false;
    bool between = false;  ///< neither metal nor none
};

/// Reads the textures of one material on one grid: that of its largest texture that says what the material is.
/// Textures of other sizes are read at the nearest texel of the same place; their own mappings are taken for equal.
class MaterialTexels {
public:
    MaterialTexels(const Scene& scene, const Material& material, const Thresholds& thresholds);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] Texel at(int x, int y) const;
    [[nodiscard]] double alpha_at(int x, int y) const;
    /// Bit i: rule i of the texel rules is broken.
    [[nodiscard]] std::uint32_t broken(const Texel& texel) const;
    /// The texels that count: some triangle with this material reaches them, and they are not cut out or invisible.
    /// One byte each, in rows. All where a mesh has no coordinates or faces.
    [[nodiscard]] std::vector<std::uint8_t> reached() const;

private:
    /// A texture on the grid.
    struct Source {
        const Image* image = nullptr;  ///< none: 1 everywhere
        bool fills_grid = false;       ///< as large as the grid
        const std::array<double, 256>* value_of_byte = nullptr;
    };
    /// The code of a colour that was met before: a power for each of millions of texels is most of a check.
    struct KnownCode {
        std::uint32_t color = 0;  ///< the texel's bytes
        bool is_known = false;
        double code = 0.0;
    };

    [[nodiscard]] Source source_of(const Texture& texture) const;
    [[nodiscard]] const std::uint8_t* bytes(const Source& source, int x, int y) const;
    [[nodiscard]] static glm::dvec4 value(const Source& source, const std::uint8_t* bytes);
    [[nodiscard]] glm::dvec4 value(const Source& source, int x, int y) const;
    /// The sRGB code of `factor` times the colour in `bytes`.
    [[nodiscard]] double code_of(const Source& source, const std::uint8_t* bytes, const glm::dvec3& factor,
                                 std::vector<KnownCode>& known) const;
    [[nodiscard]] bool shines(int x, int y) const;
    [[nodiscard]] double dielectric_code(int x, int y) const;
    void cover(const Mesh& mesh, const UvMapping& mapping, std::vector<std::uint8_t>& mask) const;

    const Scene& scene_;
    const Material& material_;
    const Thresholds& thresholds_;
    int width_ = 1;
    int height_ = 1;
    Source base_, metallic_roughness_, specular_smoothness_, specular_color_, specular_, emissive_;
    std::array<double, 256> smoothness_{};  ///< by the byte that says it
    double darkest_light_ = 0.0;            ///< of an albedo by the charts
    std::optional<bool> shines_;            ///< where it is the same at all texels, as the next
    std::optional<double> dielectric_code_;
    mutable std::vector<KnownCode> base_codes_, specular_codes_;  ///< by a hash of the colour; empty: few texels
};

/// `uv` as a texture with this mapping sees it.
[[nodiscard]] glm::vec2 mapped(const glm::vec2& uv, const UvMapping& mapping);

}  // namespace halfframe::check
