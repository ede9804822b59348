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

const std::array<double, 256>& share_of_byte() {
    static const std::array<double, 256> kTable = [] {
        std::array<double, 256> table{};
        for (std::size_t byte = 0; byte < table.size(); ++byte) table[byte] = static_cast<double>(byte) / 255.0;
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
    base_ = source_of(material.base_color_texture);
    metallic_roughness_ = source_of(material.metallic_roughness_texture);
    specular_smoothness_ = source_of(material.specular_smoothness_texture);
    specular_color_ = source_of(material.specular_color_texture);
    specular_ = source_of(material.specular_texture);
    emissive_ = source_of(material.emissive_texture);
    darkest_light_ = light_of_code(thresholds.albedo.lowest);
    if (emissive_.image == nullptr) shines_ = shines(0, 0);
    if (specular_color_.image == nullptr && specular_.image == nullptr) dielectric_code_ = dielectric_code(0, 0);
    for (std::size_t byte = 0; byte < smoothness_.size(); ++byte) {
        const double share = static_cast<double>(byte) / 255.0;  // of an alpha; a roughness may be stored otherwise
        smoothness_[byte] =
            material.model == MaterialModel::specular_glossiness
                ? smoothness_of_roughness(1.0 - material.smoothness * share)
                : smoothness_of_roughness(material.roughness * (*metallic_roughness_.value_of_byte)[byte]);
    }
    constexpr std::size_t kKnown = 1u << 16;
    if (static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) > kKnown) {
        base_codes_.resize(kKnown);
        if (specular_smoothness_.image != nullptr) specular_codes_.resize(kKnown);
    }
}

MaterialTexels::Source MaterialTexels::source_of(const Texture& texture) const {
    if (!texture) return {.value_of_byte = &share_of_byte()};
    const Image& image = scene_.images[static_cast<std::size_t>(texture.image)];
    return {.image = &image,
            .fills_grid = image.width == width_ && image.height == height_,
            .value_of_byte = image.srgb ? &light_of_byte() : &share_of_byte()};
}

const std::uint8_t* MaterialTexels::bytes(const Source& source, int x, int y) const {
    static constexpr std::array<std::uint8_t, 4> kOne{255, 255, 255, 255};
    if (source.image == nullptr) return kOne.data();
    const Image& image = *source.image;
    const auto nearest = [&](int at, int of, int size) {
        return static_cast<std::size_t>(source.fills_grid ? at : (2ll * at + 1) * size / (2ll * of));
    };
    const std::size_t texel =
        nearest(y, height_, image.height) * static_cast<std::size_t>(image.width) + nearest(x, width_, image.width);
    return &image.rgba[4 * texel];
}

glm::dvec4 MaterialTexels::value(const Source& source, const std::uint8_t* bytes) {
    const std::array<double, 256>& of_byte = *source.value_of_byte;
    return {of_byte[bytes[0]], of_byte[bytes[1]], of_byte[bytes[2]], share_of_byte()[bytes[3]]};
}

glm::dvec4 MaterialTexels::value(const Source& source, int x, int y) const {
    return value(source, bytes(source, x, y));
}

double MaterialTexels::code_of(const Source& source, const std::uint8_t* bytes, const glm::dvec3& factor,
                               std::vector<KnownCode>& known) const {
    const auto computed = [&] { return code_of_light(luminance(factor * glm::dvec3(value(source, bytes)))); };
    if (known.empty()) return computed();
    const std::uint32_t color = bytes[0] | bytes[1] << 8 | bytes[2] << 16;
    KnownCode& entry = known[(color * 2654435761u) >> 16];  // Knuth's multiplier: neighbours fall far apart
    if (!entry.is_known || entry.color != color) entry = {color, true, computed()};
    return entry.code;
}

bool MaterialTexels::shines(int x, int y) const {
    const glm::dvec3 emission = glm::dvec3(material_.emissive) * glm::dvec3(value(emissive_, x, y));
    return luminance(emission) > darkest_light_;
}

double MaterialTexels::dielectric_code(int x, int y) const {
    const double amplitude = (material_.ior - 1.0) / (material_.ior + 1.0);
    const glm::dvec3 dielectric = amplitude * amplitude * glm::dvec3(material_.specular) *
                                  glm::dvec3(value(specular_color_, x, y)) * value(specular_, x, y).a;
    return code_of_light(luminance(dielectric));
}

double MaterialTexels::alpha_at(int x, int y) const { return material_.base_color.a * value(base_, x, y).a; }

Texel MaterialTexels::at(int x, int y) const {
    Texel texel;
    const std::uint8_t* base = bytes(base_, x, y);
    texel.alpha = material_.base_color.a * value(base_, base).a;
    texel.albedo_code = code_of(base_, base, glm::dvec3(material_.base_color), base_codes_);
    texel.shines = shines_ ? *shines_ : shines(x, y);
    if (material_.model == MaterialModel::specular_glossiness) {
        const std::uint8_t* map = bytes(specular_smoothness_, x, y);
        texel.specular_code = code_of(specular_smoothness_, map, glm::dvec3(material_.specular), specular_codes_);
        texel.smoothness = smoothness_[map[3]];
        texel.metal = texel.specular_code >= thresholds_.metal_specular.lowest;
        texel.between = !texel.metal && texel.specular_code > thresholds_.dielectric_specular.highest;
        texel.metallic = texel.metal ? 1.0 : 0.0;
        return texel;
    }
    const std::uint8_t* map = bytes(metallic_roughness_, x, y);
    texel.metallic = material_.metallic * (*metallic_roughness_.value_of_byte)[map[2]];
    texel.smoothness = smoothness_[map[1]];
    texel.metal = texel.metallic >= thresholds_.metallic_between.highest;
    texel.between = !texel.metal && texel.metallic > thresholds_.metallic_between.lowest;
    if (texel.metal) {
        texel.specular_code = texel.albedo_code;
        texel.albedo_code = 0.0;  // the model itself takes it away
    } else {
        texel.specular_code = dielectric_code_ ? *dielectric_code_ : dielectric_code(x, y);
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
        std::array<glm::dvec2, 3> edge;
        std::array<double, 3> half{};
        for (std::size_t k = 0; k < 3; ++k) {
            edge[k] = at[(k + 1) % 3] - at[k];
            // Half a texel's square along the edge's normal; it must be overlapped by more than rounding.
            half[k] = 0.5 * (std::abs(edge[k].x) + std::abs(edge[k].y)) - 1e-3 * glm::length(edge[k]);
        }
        const auto overlaps = [&](const glm::dvec2& centre) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (turn * cross(edge[k], centre - at[k]) < -half[k]) return false;
            }
            return true;
        };
        for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
            std::uint8_t* row = mask.data() + wrapped(y, height_) * static_cast<std::size_t>(width_);
            for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x) {
                std::uint8_t& texel = row[x >= 0 && x < width_ ? static_cast<std::size_t>(x) : wrapped(x, width_)];
                if (texel == 0 && overlaps({x + 0.5, y + 0.5})) texel = 1;
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
                if (texel != 0 && alpha_at(x, y) < least) texel = 0;
            }
        }
    }
    return mask;
}

}  // namespace halfframe::check
