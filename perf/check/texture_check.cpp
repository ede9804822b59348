// Textures: sizes, mipmaps, wrapping, duplicates, alpha, normal maps.
#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "content/mesh_tools.h"
#include "perf/check/check.h"
#include "perf/check/texels.h"

namespace halfframe::check {
namespace {

/// One texture of one material, and how its coordinates are made.
struct Use {
    const char* slot;
    const Texture* texture;
    const UvMapping* mapping;
    int material;
};

std::vector<Use> uses_of(const Scene& scene) {
    std::set<int> used;
    for (const Surface& surface : scene.surfaces) used.insert(surface.material);
    std::vector<Use> uses;
    for (const int index : used) {
        const Material& material = scene.materials[static_cast<std::size_t>(index)];
        const std::initializer_list<Use> all{
            {"base colour", &material.base_color_texture, &material.base_color_uv, index},
            {"metallic-roughness", &material.metallic_roughness_texture, &material.metallic_roughness_uv, index},
            {"normal", &material.normal_texture, &material.normal_uv, index},
            {"emissive", &material.emissive_texture, &material.emissive_uv, index},
            {"occlusion", &material.occlusion_texture, &material.occlusion_uv, index},
            {"water", &material.water_texture, &material.water_uv, index},
            {"specular", &material.specular_texture, &material.specular_uv, index},
            {"specular colour", &material.specular_color_texture, &material.specular_color_uv, index},
            {"specular-glossiness", &material.specular_smoothness_texture, &material.specular_smoothness_uv, index}};
        std::copy_if(all.begin(), all.end(), std::back_inserter(uses),
                     [](const Use& use) { return bool(*use.texture); });
    }
    return uses;
}

class TextureCheck {
public:
    TextureCheck(const Scene& scene, const Request& request, const Places& places, Report& report)
        : scene_(scene), limits_(request.thresholds), request_(request), places_(places), report_(report) {}

    void run() {
        const std::vector<Use> uses = uses_of(scene_);
        std::set<int> images;
        for (const Use& use : uses) {
            images.insert(use.texture->image);
            check_sampler(use);
            if (std::string_view(use.slot) == "normal") check_normal_map(use);
            if (std::string_view(use.slot) == "base colour") check_alpha(use);
        }
        for (const int image : images) check_size(image);
        check_duplicates(images);
    }

private:
    [[nodiscard]] const Image& image(int index) const { return scene_.images[static_cast<std::size_t>(index)]; }
    [[nodiscard]] const Material& material(const Use& use) const {
        return scene_.materials[static_cast<std::size_t>(use.material)];
    }

    void add(RuleId rule, Level level, std::string place, std::string thing, std::string words) {
        // Two materials that share a texture break a rule about it once.
        if (!told_.insert(fmt::format("{} {} {}", static_cast<int>(rule), place, thing)).second) return;
        report_.findings.push_back({rule, level, std::move(place), std::move(thing), std::move(words)});
    }
    void add_image(RuleId rule, Level level, int index, std::string words) {
        add(rule, level, places_.image(index), fmt::format("image '{}'", image(index).name), std::move(words));
    }
    void add_use(RuleId rule, Level level, const Use& use, std::string words) {
        add(rule, level, places_.material(use.material),
            fmt::format("{} texture of material '{}'", use.slot, material(use).name), std::move(words));
    }

    void check_size(int index) {
        const Image& picture = image(index);
        const auto is_power = [](int side) { return std::has_single_bit(static_cast<unsigned>(side)); };
        if (!is_power(picture.width) || !is_power(picture.height)) {
            add_image(RuleId::texture_power_of_two, Level::warning, index,
                      fmt::format("it has {}x{} texels", picture.width, picture.height));
        }
        const int side = std::max(picture.width, picture.height);
        if (request_.largest_texture && side > *request_.largest_texture) {
            add_image(RuleId::texture_size, Level::error, index,
                      fmt::format("it has {}x{} texels; the device {} takes {} a side", picture.width, picture.height,
                                  request_.device, *request_.largest_texture));
        } else if (side > limits_.largest_texture_side) {
            add_image(RuleId::texture_size, Level::warning, index,
                      fmt::format("it has {}x{} texels; the thresholds allow {} a side", picture.width, picture.height,
                                  limits_.largest_texture_side));
        }
    }

    void check_sampler(const Use& use) {
        const Image& picture = image(use.texture->image);
        if (!use.texture->mipmaps && std::max(picture.width, picture.height) >= limits_.least_side_with_mipmaps) {
            add_use(RuleId::texture_mipmaps, Level::warning, use,
                    fmt::format("its sampler asks for no mipmaps of {}x{} texels", picture.width, picture.height));
        }
        const bool clamps_u = use.texture->wrap_u == Wrap::clamp;
        const bool clamps_v = use.texture->wrap_v == Wrap::clamp;
        if (!clamps_u && !clamps_v) return;
        glm::vec2 beyond(0.0f);
        for (const Surface& surface : scene_.surfaces) {
            if (surface.material != use.material) continue;
            const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(surface.mesh)];
            for (const glm::vec2& raw : use.mapping->set == 1 ? mesh.uv1 : mesh.uv) {
                const glm::vec2 uv = mapped(raw, *use.mapping);
                beyond = glm::max(beyond, glm::max(-uv, uv - 1.0f));
            }
        }
        const float worst = std::max(clamps_u ? beyond.x : 0.0f, clamps_v ? beyond.y : 0.0f);
        if (worst > static_cast<float>(limits_.clamped_uv)) {
            add_use(RuleId::texture_wrap, Level::warning, use,
                    fmt::format("it is clamped, and coordinates leave it by {:.3g} of its side", worst));
        }
    }

    void check_normal_map(const Use& use) {
        const Image& picture = image(use.texture->image);
        std::array<double, 256> of_byte{};
        for (std::size_t byte = 0; byte < of_byte.size(); ++byte)
            of_byte[byte] = static_cast<double>(byte) / 127.5 - 1.0;
        double length = 0.0;
        std::size_t inward = 0;
        const std::size_t count = picture.rgba.size() / 4;
        for (std::size_t texel = 0; texel < count; ++texel) {
            const auto component = [&](std::size_t channel) { return of_byte[picture.rgba[4 * texel + channel]]; };
            length += glm::length(glm::dvec3(component(0), component(1), component(2)));
            inward += picture.rgba[4 * texel + 2] < 128 ? 1u : 0u;
        }
        length /= static_cast<double>(std::max<std::size_t>(count, 1));
        if (!limits_.normal_length.holds(length)) {
            add_image(RuleId::normal_map_length, Level::warning, use.texture->image,
                      fmt::format("its vectors have a mean length of {:.3f}, wished is {} to {}", length,
                                  limits_.normal_length.lowest, limits_.normal_length.highest));
        }
        const double share = static_cast<double>(inward) / static_cast<double>(std::max<std::size_t>(count, 1));
        if (share > limits_.normal_inward_share) {
            add_image(RuleId::normal_map_inward, Level::error, use.texture->image,
                      fmt::format("{:.3g} % of {} texels have a blue below 128", 100.0 * share, count));
        }
    }

    void check_alpha(const Use& use) {
        const Image& picture = image(use.texture->image);
        std::uint8_t least = 255;
        for (std::size_t at = 3; at < picture.rgba.size(); at += 4) least = std::min(least, picture.rgba[at]);
        const AlphaMode mode = material(use).alpha_mode;
        if (mode == AlphaMode::opaque && least < 255) {
            add_use(RuleId::alpha_unused, Level::note, use,
                    fmt::format("its alpha goes down to {}, and the material is opaque", least));
        }
        const bool faded = material(use).base_color.a < 1.0f || has_colors(use.material);
        if (mode != AlphaMode::opaque && least == 255 && !faded) {
            add_use(RuleId::alpha_unused, Level::warning, use,
                    fmt::format("the material {}, and no texel is translucent",
                                mode == AlphaMode::mask ? "cuts out" : "blends and is sorted"));
        }
    }

    [[nodiscard]] bool has_colors(int material_index) const {
        return std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(), [&](const Surface& surface) {
            return surface.material == material_index &&
                   !scene_.meshes[static_cast<std::size_t>(surface.mesh)].colors.empty();
        });
    }

    void check_duplicates(const std::set<int>& images) {
        // By their pixels: the view is of bytes that outlive the map.
        std::map<std::tuple<int, int, std::string_view>, int> seen;
        for (const int index : images) {
            const Image& picture = image(index);
            const std::string_view bytes(reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size());
            const auto [first, is_new] = seen.try_emplace({picture.width, picture.height, bytes}, index);
            // One image of the file that is read both as colour and as data is two here, of one name.
            if (!is_new && image(first->second).name != picture.name) {
                add_image(RuleId::images_duplicate, Level::warning, index,
                          fmt::format("its {}x{} texels are those of image '{}'", picture.width, picture.height,
                                      image(first->second).name));
            }
        }
    }

    const Scene& scene_;
    const Thresholds& limits_;
    const Request& request_;
    const Places& places_;
    Report& report_;
    std::set<std::string> told_;
};

}  // namespace

void check_textures(const Scene& scene, const Request& request, const Places& places, Report& report) {
    TextureCheck(scene, request, places, report).run();
}

}  // namespace halfframe::check
