// Textures with water in them, texel by texel through the formula of the shader.
#include "engine/effects/wet_surface/wet_bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "engine/effects/wet_surface/wet_material.h"
#include "engine/effects/wet_surface/wet_surface.h"
#include "shaders_es/surface/surface_limits.h"

namespace halfframe {

namespace {

float linear_of(std::uint8_t code) {
    const float value = static_cast<float>(code) / 255.0f;
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

const std::array<float, 256>& linear_codes() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) made[i] = linear_of(static_cast<std::uint8_t>(i));
        return made;
    }();
    return table;
}

std::uint8_t srgb_code(float linear) {
    const float value = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

std::uint8_t code(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

const Image* image_of(const Scene& scene, const Texture& texture) {
    return texture ? &scene.images[static_cast<std::size_t>(texture.image)] : nullptr;
}

glm::vec4 stored_texel(const Image& image, int column, int row) {
    // Past an edge the picture begins again, as most textures do.
    const auto x = static_cast<std::size_t>((column + image.width) % image.width);
    const auto y = static_cast<std::size_t>((row + image.height) % image.height);
    const std::uint8_t* texel = &image.rgba[4 * (y * static_cast<std::size_t>(image.width) + x)];
    glm::vec4 value;
    for (int i = 0; i < 4; ++i)
        value[i] = i < 3 && image.srgb ? linear_codes()[texel[i]] : static_cast<float>(texel[i]) / 255.0f;
    return value;
}

/// `image` at the middle of texel (x, y) of a picture of `width` x `height`, filtered where it is smaller; white without
/// an image.
glm::vec4 texel_at(const Image* image, int x, int y, int width, int height) {
    if (image == nullptr) return glm::vec4(1.0f);
    const float u = (static_cast<float>(x) + 0.5f) * static_cast<float>(image->width) / static_cast<float>(width) - 0.5f;
    const float v =
        (static_cast<float>(y) + 0.5f) * static_cast<float>(image->height) / static_cast<float>(height) - 0.5f;
    const auto column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(v));
    const float right = u - static_cast<float>(column), down = v - static_cast<float>(row);
    const auto texel = [&](int dx, int dy) { return stored_texel(*image, column + dx, row + dy); };
    if (right == 0.0f && down == 0.0f) return texel(0, 0);
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), right), glm::mix(texel(0, 1), texel(1, 1), right), down);
}

/// The images that decide a material's water, as they are sampled alike: see obstacle_to_writing().
struct WaterImages {
    const Image* color;      ///< base colour, or diffuse
    const Image* roughness;  ///< metallic-roughness, or specular-glossiness
    const Image* mask;
    bool glossy;
    int width = 1, height = 1;  ///< the largest of each
};

WaterImages images_of(const Scene& scene, const Material& material) {
    WaterImages images{.color = image_of(scene, material.base_color_texture),
                       .roughness = nullptr,
                       .mask = nullptr,
                       .glossy = material.model == MaterialModel::specular_glossiness};
    images.roughness = image_of(
        scene, images.glossy ? material.specular_smoothness_texture : material.metallic_roughness_texture);
    if (material.water == WaterMask::texture) images.mask = image_of(scene, material.water_texture);
    for (const Image* image : {images.color, images.roughness, images.mask}) {
        if (image == nullptr) continue;
        images.width = std::max(images.width, image->width);
        images.height = std::max(images.height, image->height);
    }
    return images;
}

/// What the formula needs of one texel.
struct Texel {
    float pores = 0.0f;
    float smoothness = 0.0f;
    float open = 1.0f;  ///< share of the water that it takes up
};

Texel texel_of(const Material& material, const WaterImages& images, int x, int y) {
    const auto color = texel_at(images.color, x, y, images.width, images.height);
    const auto rough = texel_at(images.roughness, x, y, images.width, images.height);
    const glm::vec3 base = glm::vec3(material.base_color) * glm::vec3(color[0], color[1], color[2]);
    Texel texel;
    glm::vec3 specular;
    if (images.glossy) {
        specular = material.specular * glm::vec3(rough[0], rough[1], rough[2]);
        texel.smoothness = smoothness_of(1.0f - material.smoothness * rough[3]);
    } else {
        const float metallic = material.metallic * rough[2];
        specular = glm::mix(glm::vec3(static_cast<float>(SURFACE_DIELECTRIC_SPECULAR)), base, metallic);
        texel.smoothness = smoothness_of(material.roughness * rough[1]);
    }
    texel.pores = porosity(specular, texel.smoothness);
    texel.open = texel_at(images.mask, x, y, images.width, images.height)[0];
    return texel;
}

class Writer {
public:
    Writer(const Scene& scene, MaterialChanges& changes)
        : scene_(scene), changes_(changes), levels_(wet_levels(scene)) {}

    void write(Material& material) {
        const WaterImages images = images_of(scene_, material);
        const Texel first = texel_of(material, images, 0, 0);
        const bool alike = images.roughness == nullptr && images.mask == nullptr &&
                           (images.color == nullptr || images.glossy || material.metallic == 0.0f);
        if (alike) {
            write_factors(material, first);
        } else {
            write_textures(material, images);
        }
        material.water = WaterMask::none;
        material.water_texture = {};
    }

private:
    [[nodiscard]] float darker(const Texel& texel) const { return wet_factor(texel.pores, levels_.diffuse * texel.open); }
    [[nodiscard]] float smoother(const Texel& texel) const {
        return wet_smoothness(texel.smoothness, texel.pores, levels_.specular * texel.open);
    }

    void write_factors(Material& material, const Texel& texel) const {
        const float factor = darker(texel);
        material.base_color = glm::vec4(glm::vec3(material.base_color) * factor, material.base_color.a);
        if (texel.pores == 0.0f) return;  // as it was, to the bit
        material.roughness = roughness_of(smoother(texel));
        material.smoothness = 1.0f - material.roughness;
    }

    void write_textures(Material& material, const WaterImages& images) {
        // One pair of pictures for all materials of the same textures and numbers.
        const std::tuple key{images.color,       images.roughness,    images.mask,      images.glossy,
                             material.metallic,  material.roughness,  material.smoothness,
                             material.base_color.r, material.base_color.g, material.base_color.b};
        auto known = written_.find(key);
        if (known == written_.end()) known = written_.emplace(key, make(material, images)).first;
        Texture& roughness =
            images.glossy ? material.specular_smoothness_texture : material.metallic_roughness_texture;
        const Texture sampled = images.color     ? material.base_color_texture
                                : images.roughness ? roughness
                                                   : material.water_texture;
        const UvMapping uv = images.color       ? material.base_color_uv
                             : images.roughness ? (images.glossy ? material.specular_smoothness_uv
                                                                 : material.metallic_roughness_uv)
                                                : material.water_uv;
        const auto [color, rough] = known->second;
        if (!material.base_color_texture) {
            material.base_color_texture = sampled;
            material.base_color_uv = uv;
        }
        material.base_color_texture.image = color;
        if (!roughness) {
            roughness = sampled;
            (images.glossy ? material.specular_smoothness_uv : material.metallic_roughness_uv) = uv;
        }
        roughness.image = rough;
    }

    std::pair<int, int> make(const Material& material, const WaterImages& images) {
        const auto blank = [&](const Image* like, const char* what, bool srgb) {
            Image image;
            image.name = fmt::format("{}, wet", like != nullptr ? like->name : material.name + what);
            image.width = images.width;
            image.height = images.height;
            image.srgb = srgb;
            image.rgba.resize(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
            return image;
        };
        Image color = blank(images.color, " colour", true);
        Image rough = blank(images.roughness, " roughness", images.glossy);
        std::size_t at = 0;
        for (int y = 0; y < images.height; ++y) {
            for (int x = 0; x < images.width; ++x, at += 4) {
                const Texel texel = texel_of(material, images, x, y);
                const auto dry_color = texel_at(images.color, x, y, images.width, images.height);
                const auto dry_rough = texel_at(images.roughness, x, y, images.width, images.height);
                const float factor = darker(texel);
                for (int i = 0; i < 3; ++i) color.rgba[at + static_cast<std::size_t>(i)] = srgb_code(dry_color[i] * factor);
                color.rgba[at + 3] = code(dry_color[3]);
                write_roughness(material, texel, dry_rough, images.glossy, &rough.rgba[at]);
            }
        }
        return {add(std::move(color), material.base_color_texture.image),
                add(std::move(rough), images.glossy ? material.specular_smoothness_texture.image
                                                    : material.metallic_roughness_texture.image)};
    }

    void write_roughness(const Material& material, const Texel& texel, const glm::vec4& dry, bool glossy,
                         std::uint8_t* into) const {
        const float roughness = roughness_of(smoother(texel));
        const bool stays = texel.pores == 0.0f || texel.open == 0.0f;
        for (int i = 0; i < 4; ++i) into[i] = glossy && i < 3 ? srgb_code(dry[i]) : code(dry[i]);
        if (stays) return;
        if (glossy) into[3] = code((1.0f - roughness) / std::max(material.smoothness, 1e-6f));
        else into[1] = code(roughness / std::max(material.roughness, 1e-6f));
    }

    int add(Image image, int instead_of) {
        changes_.images.push_back(std::move(image));
        changes_.instead_of.push_back(instead_of);
        return static_cast<int>(scene_.images.size() + changes_.images.size()) - 1;
    }

    using Key = std::tuple<const Image*, const Image*, const Image*, bool, float, float, float, float, float, float>;
    const Scene& scene_;
    MaterialChanges& changes_;
    WetLevels levels_;
    std::map<Key, std::pair<int, int>> written_;
};

bool sampled_alike(const Texture& a, const UvMapping& a_uv, const Texture& b, const UvMapping& b_uv) {
    Texture other = b;
    other.image = a.image;
    return a == other && a_uv == b_uv;
}

}  // namespace

float roughness_of(float smoothness) {
    return std::pow(2.0f / (std::exp2(10.0f * smoothness + 1.0f) + 2.0f), 0.25f);
}

std::string obstacle_to_writing(const Scene& scene, const Material& material) {
    const bool glossy = material.model == MaterialModel::specular_glossiness;
    const Texture& rough = glossy ? material.specular_smoothness_texture : material.metallic_roughness_texture;
    const UvMapping& rough_uv = glossy ? material.specular_smoothness_uv : material.metallic_roughness_uv;
    struct Sampled {
        const Texture* texture;
        const UvMapping* uv;
    };
    std::vector<Sampled> sampled;
    if (material.base_color_texture) sampled.push_back({&material.base_color_texture, &material.base_color_uv});
    if (rough) sampled.push_back({&rough, &rough_uv});
    if (material.water == WaterMask::texture) sampled.push_back({&material.water_texture, &material.water_uv});
    for (const Sampled& one : sampled) {
        if (!sampled_alike(*sampled.front().texture, *sampled.front().uv, *one.texture, *one.uv))
            return "its textures are mapped in different ways";
    }
    const bool occlusion_shares = material.occlusion_texture && material.occlusion_texture.image == rough.image;
    const Image* roughness = image_of(scene, rough);
    const Image* color = image_of(scene, material.base_color_texture);
    if (occlusion_shares && roughness != nullptr && color != nullptr &&
        (roughness->width < color->width || roughness->height < color->height))
        return "its occlusion shares the roughness texture, which would grow";
    return {};
}

float mean_porosity(const Scene& scene, const Material& material) {
    const WaterImages images = images_of(scene, material);
    const int columns = std::min(images.width, 64), rows = std::min(images.height, 64);
    double sum = 0.0;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            sum += static_cast<double>(
                texel_of(material, images, x * images.width / columns, y * images.height / rows).pores);
        }
    }
    return static_cast<float>(sum / (columns * rows));
}

void write_wetness(const Scene& scene, MaterialChanges& changes) {
    Writer writer(scene, changes);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (water_decision(scene, scene.materials[i]).path == WaterPath::written) writer.write(changes.materials[i]);
    }
}

Scene with_written_wetness(const Scene& scene) {
    Scene result = scene;
    MaterialChanges changes{.materials = scene.materials, .images = {}, .instead_of = {}};
    write_wetness(scene, changes);
    bool live = false;
    for (const Material& material : scene.materials)
        live = live || water_decision(scene, material).path == WaterPath::live;
    result.materials = std::move(changes.materials);
    for (Image& image : changes.images) result.images.push_back(std::move(image));
    if (!live) result.wetness.reset();
    return result;
}

}  // namespace halfframe
