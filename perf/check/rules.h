// The rules of `halfframe check`: each has an id, a sentence, a source, and what to do.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace halfframe::check {

enum class RuleId : std::uint8_t {
    albedo_dark,
    albedo_bright,
    metal_albedo,
    dielectric_specular,
    metal_specular,
    specular_gap,
    metallic_between,
    smoothness_ends,
    texture_power_of_two,
    texture_size,
    texture_mipmaps,
    texture_wrap,
    images_duplicate,
    alpha_unused,
    normal_map_length,
    normal_map_inward,
    mesh_degenerate,
    mesh_unused_vertices,
    mesh_normals,
};
inline constexpr int kRuleCount = static_cast<int>(RuleId::mesh_normals) + 1;
/// The first ones are about texels of materials, and can be shown on them.
inline constexpr int kTexelRuleCount = static_cast<int>(RuleId::smoothness_ends) + 1;

struct Rule {
    RuleId id;
    const char* name;
    const char* sentence;  ///< what must hold
    const char* source;    ///< who says so
    const char* remedy;    ///< what to do
};
/// In the order of RuleId.
[[nodiscard]] std::span<const Rule> rules();
[[nodiscard]] const Rule& rule(RuleId id);

enum class Level : std::uint8_t { note, warning, error };
[[nodiscard]] const char* name(Level level);

/// A rule that is broken somewhere.
struct Finding {
    RuleId rule = RuleId::albedo_dark;
    Level level = Level::warning;
    std::string place;  ///< JSON pointer in the file; "" when the scene is no file
    std::string thing;  ///< "material 'tyre'"
    std::string words;  ///< what is wrong, with figures
};

}  // namespace halfframe::check
