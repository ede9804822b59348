// Which textures a surface is drawn with, on which units, and how their coordinates are made.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/scene.h"
#include "engine/frame/texture_storage.h"

namespace halfframe {

struct DrawMesh;

/// One texture of a draw.
struct SurfaceTexture {
    std::string_view define;  ///< BASE_COLOR_MAP and so on
    const char* sampler = nullptr;
    Texture texture;
    bool srgb = false;
    Texture packed;  ///< shares its texels: metallic-roughness with NORMAL_MAP, occlusion with BASE_COLOR_MAP; or none
    bool packs_emission = false;  ///< with BASE_COLOR_MAP: `packed` is emission and not occlusion
    int unit = 0;
};

struct SurfaceTextures {
    std::vector<SurfaceTexture> used;
    std::vector<std::string_view> defines;  ///< of the textures and of their coordinates
    UvMapping first, second;                ///< the two ways of making coordinates
    glm::vec3 emission{1.0f};               ///< times Material::emissive: what the share of a packed emission is one of
    std::vector<std::string> left_out;      ///< one sentence each
};

/// The emission_mask() of a texture; asked only of an emission that could be packed.
using MaskOf = std::function<std::optional<glm::vec3>(const Texture&)>;

/// `material`'s textures as far as `mesh` can be drawn with them. There are two different mappings of coordinates, four
/// units of surface's own and `spare_units` that no other effect reads; what is seen least is left out first, at the
/// low tier always the texture of the specular factor. What a
/// mesh without normals or an unlit material has no use for is not a loss and not said. Without `mask_of` no emission
/// is packed.
[[nodiscard]] SurfaceTextures surface_textures(const Material& material, const DrawMesh& mesh,
                                               std::span<const int> spare_units, bool low,
                                               bool water_map = false, const MaskOf& mask_of = {});

/// How the shader reads one of a material's textures; `decoded`: the device decodes sRGB.
[[nodiscard]] TextureUse use_of(const Material& material, const SurfaceTexture& texture, bool decoded);

/// The defines of a material's model, beside those of its textures: none for what glTF 2.0 has without extensions.
[[nodiscard]] std::vector<std::string_view> model_defines(const Material& material);

/// What shaders_es/surface/surface.frag takes as `specular_factors`.
[[nodiscard]] glm::vec4 specular_factors_of(const Material& material);

/// True where the material shows its colour as it is, whatever lights the scene.
[[nodiscard]] inline bool is_unlit(const Material& material) { return material.model == MaterialModel::unlit; }

}  // namespace halfframe
