// False colours through plain materials: no shader knows of them.
#include "perf/check/false_colour.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "content/built_in.h"
#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/error.h"
#include "perf/check/texels.h"

namespace halfframe::check {
namespace {

/// Display codes, none above 204: what shines stays below a light of 1 (code 214), which would not fit into a texture
/// and would glow. Told apart by the colour-blind as well: M. Okabe and K. Ito, "Color Universal Design", 2008,
/// darkened.
constexpr std::array<perf::Rgb, kTexelRuleCount> kColours{{{0, 91, 143},      // albedo dark: blue
                                                           {192, 181, 53},    // albedo bright: yellow
                                                           {170, 76, 0},      // metal albedo: vermillion
                                                           {0, 127, 92},      // dielectric specular: green
                                                           {184, 128, 0},     // metal specular: orange
                                                           {163, 97, 134},    // gap: purple
                                                           {140, 20, 60},     // metallic between: crimson
                                                           {69, 144, 187}}};  // smoothness: sky blue
constexpr perf::Rgb kPaper = {20, 20, 22};
constexpr perf::Rgb kInk = {226, 226, 226};
/// Largest side of a false-colour texture [texels]: pictures are hardly larger.
constexpr int kLargestSide = 1024;
/// Reflectance of the grey, linear: the talk's "neutral 5", sRGB 122.
constexpr float kGrey = 0.195f;

std::uint32_t bits_of(const std::vector<RuleId>& rules) {
    std::uint32_t bits = 0;
    for (const RuleId rule : rules) bits |= 1u << static_cast<unsigned>(rule);
    return bits;
}

/// sRGB bytes of the light that the tone curve shows as `display`, before the exposure.
std::array<std::uint8_t, 3> emission_bytes(const perf::Rgb& display) {
    std::array<std::uint8_t, 3> bytes{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double light = reference::inverse_tone_curve(display[channel] / 255.0);
        bytes[channel] = static_cast<std::uint8_t>(std::lround(code_of_light(light)));
    }
    return bytes;
}

void set(Image& image, std::size_t texel, const std::array<std::uint8_t, 3>& rgb, std::uint8_t alpha) {
    std::copy(rgb.begin(), rgb.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * texel));
    image.rgba[4 * texel + 3] = alpha;
}

/// Images on the material's grid: where it is grey, where it shines, and where it is a black metal, which reflects
/// nothing that would change the colour.
struct FalseImages {
    Image grey;
    Image shine;
    Image metal;
};
FalseImages false_images(const Scene& scene, const Material& material, const Thresholds& limits, std::uint32_t shown) {
    const MaterialTexels texels(scene, material, limits);
    const std::vector<std::uint8_t> reached = texels.reached();
    FalseImages images;
    for (Image* image : {&images.grey, &images.shine, &images.metal}) {
        image->name = "false colours of " + material.name;
        image->width = std::min(texels.width(), kLargestSide);
        image->height = std::min(texels.height(), kLargestSide);
        image->srgb = image != &images.metal;
        image->rgba.resize(4 * static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height));
    }
    for (int y = 0; y < images.grey.height; ++y) {
        for (int x = 0; x < images.grey.width; ++x) {
            const int from_x = (2 * x + 1) * texels.width() / (2 * images.grey.width);
            const int from_y = (2 * y + 1) * texels.height() / (2 * images.grey.height);
            const Texel texel = texels.at(from_x, from_y);
            const std::uint32_t broken = material.model == MaterialModel::unlit ? 0u : texels.broken(texel) & shown;
            const auto at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(images.grey.width) + static_cast<std::size_t>(x);
            const auto alpha = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(texel.alpha, 0.0, 1.0)));
            if (broken == 0) {
                set(images.grey, at, {255, 255, 255}, alpha);
                set(images.shine, at, {0, 0, 0}, 255);
                set(images.metal, at, {255, 255, 0}, 255);
            } else {
                const auto first = static_cast<std::size_t>(std::countr_zero(broken));
                set(images.grey, at, {0, 0, 0}, alpha);
                set(images.shine, at, emission_bytes(kColours[first]), 255);
                set(images.metal, at, {255, 255, 255}, 255);
            }
        }
    }
    return images;
}

/// Where the material's first texture lies.
std::pair<Texture, UvMapping> first_texture(const Material& material) {
    if (material.base_color_texture) return {material.base_color_texture, material.base_color_uv};
    if (material.metallic_roughness_texture) {
        return {material.metallic_roughness_texture, material.metallic_roughness_uv};
    }
    if (material.specular_smoothness_texture) {
        return {material.specular_smoothness_texture, material.specular_smoothness_uv};
    }
    return {Texture{.image = 0}, UvMapping{}};
}

}  // namespace

perf::Rgb colour_of(RuleId texel_rule) {
    const auto index = static_cast<std::size_t>(texel_rule);
    expect(index < kColours.size(), "only rules about texels have a colour");
    return kColours[index];
}

std::vector<RuleId> shown_rules(const Report& report) {
    std::set<RuleId> rules;
    for (const Finding& finding : report.findings) {
        if (static_cast<int>(finding.rule) < kTexelRuleCount && finding.level != Level::note)
            rules.insert(finding.rule);
    }
    return {rules.begin(), rules.end()};
}

void show_broken_rules(Scene& scene, const Report& report, const Thresholds& thresholds, float exposure) {
    const std::uint32_t shown = bits_of(shown_rules(report));
    Scene result = scene;
    result.images.clear();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& before = scene.materials[i];
        FalseImages images = false_images(scene, before, thresholds, shown);
        auto [texture, mapping] = first_texture(before);
        Material& after = result.materials[i];
        after = Material{.name = before.name,
                         .base_color = glm::vec4(glm::vec3(kGrey), 1.0f),
                         .metallic = 1.0f,
                         .specular = glm::vec3(0.0f),
                         .emissive = glm::vec3(1.0f / exposure),
                         .alpha_cutoff = before.alpha_cutoff,
                         .alpha_mode = before.alpha_mode,
                         .double_sided = before.double_sided};
        texture.image = content::add_image(result, std::move(images.grey));
        after.base_color_texture = texture;
        texture.image = content::add_image(result, std::move(images.shine));
        after.emissive_texture = texture;
        texture.image = content::add_image(result, std::move(images.metal));
        after.metallic_roughness_texture = texture;
        after.base_color_uv = after.emissive_uv = after.metallic_roughness_uv = mapping;
    }
    for (Mesh& mesh : result.meshes) {
        mesh.colors.clear();  // they would tint the grey
        if (mesh.uv.empty()) mesh.uv.assign(mesh.positions.size(), glm::vec2(0.5f));
    }
    result.bloom = Bloom{.strength = 0.0f};
    scene = std::move(result);
}

void draw_legend(Picture& picture, const std::vector<RuleId>& rules, const perf::Lettering& lettering) {
    const int line = lettering.height() + 4;
    const std::string fine = rules.empty() ? "no texel breaks a rule" : "as the charts have it";
    int width = lettering.width(fine);
    for (const RuleId each : rules) width = std::max(width, lettering.width(rule(each).name));
    const int rows = static_cast<int>(rules.size()) + 1;
    perf::fill(picture, 0, 0, width + line + 16, rows * line + 12, kPaper);
    const auto row = [&](int index, const perf::Rgb& colour, const std::string& words) {
        const int y = 6 + index * line;
        perf::fill(picture, 6, y + 2, line - 6, line - 6, colour);
        lettering.draw(picture, line + 6, y, words, kInk);
    };
    row(0, {110, 110, 110}, fine);
    for (std::size_t i = 0; i < rules.size(); ++i) {
        row(static_cast<int>(i) + 1, colour_of(rules[i]), rule(rules[i]).name);
    }
}

}  // namespace halfframe::check
