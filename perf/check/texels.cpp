// Materials texel by texel.
#include "perf/check/texels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "content/mesh_tools.h"

namespace halfframe::check {
namespace {

double luminance(const glm::dvec3& color) { return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// The 256 values of an 8-bit channel.
const std::array<double, 256>& light_of_byte() {
    static const std::array<double, 256> kTable = [] {
        std::array<double, 256> table{};
        for (std::size_t code = 0; code < table.size(); ++code) table[code] = light_of_code(static_cast<double>(code));
        return table;
    }();
    return kTable;
}

/// The talk's smoothness of a glTF roughness: power 2 / roughness^4 - 2 within 2..2048, power = 2^(10 smoothness + 1).
double smoothness_of_roughness(double roughness) {
    const double power = 2.0 / std::max(std::pow(roughness, 4.0), 1e-9) - 2.0;
    return (std::log2(std::clamp(power, 2.0, 2048.0)) - 1.0) / 10.0;
}

std::uint32_t bit(RuleId rule) { return 1u << static_cast<unsigned>(rule); }

}  // namespace

double code_of_light(double light) {
    const double clamped = std::clamp(light, 0.0, 1.0);
    return 255.0 * (clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1.0 / 2.4) - 0.055);
}

double light_of_code(double code) {
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

glm::vec2 mapped(const glm::vec2& uv, const UvMapping& mapping) {
    const glm::vec2 scaled = uv * mapping.scale;
    const float sine = std::sin(mapping.rotation_rad);
    const float cosine = std::cos(mapping.rotation_rad);
    // KHR_texture_transform: counter-clockwise in a picture whose v grows downwards.
    return glm::vec2(cosine * scaled.x + sine * scaled.y, -sine * scaled.x + cosine * scaled.y) + mapping.offset;
}

MaterialTexels::MaterialTexels(const Scene& scene, const Material& material, const Thresholds& thresholds)
    : scene_(scene), material_(material), thresholds_(thresholds) {
    for (const Texture& texture :
         {material.base_color_texture, material.metallic_roughness_texture, material.specular_smoothness_texture,
          material.specular_color_texture, material.specular_texture}) {
        if (!texture) continue;
        const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
        width_ = std::max(width_, image.width);
        height_ = std::max(height_, image.height);
    }
}

glm::dvec4 MaterialTexels::value(const Texture& texture, int x, int y) const {
    if (!texture) return glm::dvec4(1.0);
    const Image& image = scene_.images[static_cast<std::size_t>(texture.image)];
    const auto nearest = [](int at, int of, int size) {
        return static_cast<std::size_t>((2ll * at + 1) * size / (2ll * of));
    };
    const std::size_t texel =
        nearest(y, height_, image.height) * static_cast<std::size_t>(image.width) + nearest(x, width_, image.width);
    const std::uint8_t* bytes = &image.rgba[4 * texel];
    glm::dvec4 result(0.0, 0.0, 0.0, bytes[3] / 255.0);
    for (int channel = 0; channel < 3; ++channel) {
        result[channel] = image.srgb ? light_of_byte()[bytes[channel]] : bytes[channel] / 255.0;
    }
    return result;
}

Texel MaterialTexels::at(int x, int y) const {
    const glm::dvec4 base = glm::dvec4(material_.base_color) * value(material_.base_color_texture, x, y);
    Texel texel;
    texel.alpha = base.a;
    texel.albedo_code = code_of_light(luminance(glm::dvec3(base)));
    const glm::dvec3 emission = glm::dvec3(material_.emissive) * glm::dvec3(value(material_.emissive_texture, x, y));
    texel.shines = luminance(emission) > light_of_code(thresholds_.albedo.lowest);
    if (material_.model == MaterialModel::specular_glossiness) {
        const glm::dvec4 map = value(material_.specular_smoothness_texture, x, y);
        texel.specular_code = code_of_light(luminance(glm::dvec3(material_.specular) * glm::dvec3(map)));
        texel.smoothness = smoothness_of_roughness(1.0 - material_.smoothness * map.a);
        texel.metal = texel.specular_code >= thresholds_.metal_specular.lowest;
        texel.between = !texel.metal && texel.specular_code > thresholds_.dielectric_specular.highest;
        texel.metallic = texel.metal ? 1.0 : 0.0;
        return texel;
    }
    const glm::dvec4 map = value(material_.metallic_roughness_texture, x, y);
    texel.metallic = material_.metallic * map.b;
    texel.smoothness = smoothness_of_roughness(material_.roughness * map.g);
    texel.metal = texel.metallic >= thresholds_.metallic_between.highest;
    texel.between = !texel.metal && texel.metallic > thresholds_.metallic_between.lowest;
    const double amplitude = (material_.ior - 1.0) / (material_.ior + 1.0);
    const glm::dvec3 dielectric = amplitude * amplitude * glm::dvec3(material_.specular) *
                                  glm::dvec3(value(material_.specular_color_texture, x, y)) *
                                  value(material_.specular_texture, x, y).a;
    if (texel.metal) {
        texel.specular_code = texel.albedo_code;
        texel.albedo_code = 0.0;  // the model itself takes it away
    } else {
        texel.specular_code = code_of_light(luminance(dielectric));
    }
    return texel;
}

std::uint32_t MaterialTexels::broken(const Texel& texel) const {
    const Thresholds& limits = thresholds_;
    std::uint32_t bits = 0;
    // Half a code: what 8-bit storage itself leaves open.
    constexpr double kHalf = 0.5;
    if (!texel.metal && !texel.between) {
        if (texel.albedo_code < limits.albedo.lowest - kHalf && !texel.shines) bits |= bit(RuleId::albedo_dark);
        if (texel.albedo_code > limits.albedo.highest + kHalf) bits |= bit(RuleId::albedo_bright);
        if (texel.specular_code < limits.dielectric_specular.lowest - kHalf ||
            texel.specular_code > limits.dielectric_specular.highest + kHalf) {
            bits |= bit(RuleId::dielectric_specular);
        }
    }
    if (texel.metal) {
        if (texel.albedo_code > limits.metal_albedo_highest + kHalf) bits |= bit(RuleId::metal_albedo);
        const bool dark = texel.specular_code < limits.metal_specular.lowest - kHalf && !texel.shines;
        if (dark || texel.specular_code > limits.metal_specular.highest + kHalf) {
            bits |= bit(RuleId::metal_specular);
        }
    }
    if (texel.between) {
        const bool by_specular = material_.model == MaterialModel::specular_glossiness;
        bits |= bit(by_specular ? RuleId::specular_gap : RuleId::metallic_between);
    }
    if (!limits.smoothness.holds(texel.smoothness)) bits |= bit(RuleId::smoothness_ends);
    return bits;
}

/// Marks every texel whose square a triangle overlaps; one that is a point or a line marks where it lies.
void MaterialTexels::cover(const Mesh& mesh, const UvMapping& mapping, std::vector<std::uint8_t>& mask) const {
    const std::vector<glm::vec2>& all = mapping.set == 1 ? mesh.uv1 : mesh.uv;
    const glm::dvec2 size(width_, height_);
    const std::vector<std::uint32_t> corners = content::triangle_list(mesh);
    const auto wrapped = [](int at, int of) { return static_cast<std::size_t>((at % of + of) % of); };
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        std::array<glm::dvec2, 3> at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = glm::dvec2(mapped(all[corners[i + k]], mapping)) * size;
        const glm::dvec2 low = glm::floor(glm::min(at[0], glm::min(at[1], at[2])));
        const glm::dvec2 high = glm::max(glm::ceil(glm::max(at[0], glm::max(at[1], at[2]))), low + 1.0);
        if (!glm::all(glm::lessThan(high - low, 2.0 * size + 2.0))) {  // it repeats, or is no number
            std::fill(mask.begin(), mask.end(), std::uint8_t{1});
            return;
        }
        const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
        const double turn = cross(at[1] - at[0], at[2] - at[0]) < 0.0 ? -1.0 : 1.0;
        const auto overlaps = [&](const glm::dvec2& centre) {
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec2 edge = at[(k + 1) % 3] - at[k];
                // Half a texel's square along the edge's normal; it must be overlapped by more than rounding.
                const double half = 0.5 * (std::abs(edge.x) + std::abs(edge.y)) - 1e-3 * glm::length(edge);
                if (turn * cross(edge, centre - at[k]) < -half) return false;
            }
            return true;
        };
        for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
            for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x) {
                if (!overlaps({x + 0.5, y + 0.5})) continue;
                mask[wrapped(y, height_) * static_cast<std::size_t>(width_) + wrapped(x, width_)] = 1;
            }
        }
    }
}

std::vector<std::uint8_t> MaterialTexels::reached() const {
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    const UvMapping& mapping = material_.base_color_texture           ? material_.base_color_uv
                               : material_.metallic_roughness_texture ? material_.metallic_roughness_uv
                                                                      : material_.specular_smoothness_uv;
    for (const Surface& surface : scene_.surfaces) {
        if (&scene_.materials[static_cast<std::size_t>(surface.material)] != &material_) continue;
        const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(surface.mesh)];
        const std::vector<glm::vec2>& uv = mapping.set == 1 ? mesh.uv1 : mesh.uv;
        if (mask.size() == 1 || uv.empty() || !content::has_faces(mesh.primitive)) {
            std::fill(mask.begin(), mask.end(), std::uint8_t{1});
            break;
        }
        cover(mesh, mapping, mask);
    }
    if (material_.alpha_mode != AlphaMode::opaque) {
        const double least = material_.alpha_mode == AlphaMode::mask ? material_.alpha_cutoff : 1.0 / 255.0;
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                std::uint8_t& texel =
                    mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
                if (texel != 0 && at(x, y).alpha < least) texel = 0;
            }
        }
    }
    return mask;
}

}  // namespace halfframe::check
