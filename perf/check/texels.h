// What a material is at each of its texels, and which rules it breaks there.
#pragma once

#include <cstdint>
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
    /// Bit i: rule i of the texel rules is broken.
    [[nodiscard]] std::uint32_t broken(const Texel& texel) const;
    /// The texels that count: some triangle with this material reaches them, and they are not cut out or invisible.
    /// One byte each, in rows. All where a mesh has no coordinates or faces.
    [[nodiscard]] std::vector<std::uint8_t> reached() const;

private:
    [[nodiscard]] glm::dvec4 value(const Texture& texture, int x, int y) const;
    void cover(const Mesh& mesh, const UvMapping& mapping, std::vector<std::uint8_t>& mask) const;

    const Scene& scene_;
    const Material& material_;
    const Thresholds& thresholds_;
    int width_ = 1;
    int height_ = 1;
};

/// `uv` as a texture with this mapping sees it.
[[nodiscard]] glm::vec2 mapped(const glm::vec2& uv, const UvMapping& mapping);

}  // namespace halfframe::check
