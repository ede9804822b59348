// Picks the textures of a draw, in the order in which their loss would be seen.
#include "engine/effects/surface/surface_textures.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "engine/frame/renderer.h"
#include "engine/frame/uv_rows.h"

namespace halfframe {

namespace {

/// A texture that a material asks for; `name` as in a glTF file.
struct Wish {
    std::string_view define;
    std::string_view second_define;  ///< read at the second mapping
    const char* sampler;
    const char* name;
    const Texture* texture;
    const UvMapping* uv;
    bool srgb;
    std::optional<int> own_unit;
};

std::vector<Wish> wishes_of(const Material& material, const DrawMesh& mesh, bool water_map) {
    std::vector<Wish> wishes;
    const auto add = [&](const Wish& wish) {
        if (*wish.texture) wishes.push_back(wish);
    };
    add({"BASE_COLOR_MAP", "BASE_COLOR_UV_B", "base_color_map", "base colour", &material.base_color_texture,
         &material.base_color_uv, true, kBaseColorUnit});
    if (is_unlit(material)) return wishes;
    const bool lit = mesh.has_normals;
    const bool glossy = material.model == MaterialModel::specular_glossiness;
    if (lit && glossy) {
        add({"SPECULAR_GLOSSINESS_MAP", "ROUGHNESS_UV_B", "specular_glossiness_map", "specular-glossiness",
             &material.specular_smoothness_texture, &material.specular_smoothness_uv, true, kMetallicRoughnessUnit});
    }
    if (lit && !glossy) {
        add({"METALLIC_ROUGHNESS_MAP", "ROUGHNESS_UV_B", "metallic_roughness_map", "metallic-roughness",
             &material.metallic_roughness_texture, &material.metallic_roughness_uv, false, kMetallicRoughnessUnit});
    }
    if (lit && mesh.has_tangents) {
        add({"NORMAL_MAP", "NORMAL_UV_B", "normal_map", "normal", &material.normal_texture, &material.normal_uv, false,
             kNormalUnit});
    }
    add({"EMISSIVE_MAP", "EMISSIVE_UV_B", "emissive_map", "emissive", &material.emissive_texture, &material.emissive_uv,
         true, kEmissiveUnit});
    if (!lit) return wishes;
    if (water_map) {
        add({"WATER_MAP", "WATER_UV_B", "water_map", "water", &material.water_texture, &material.water_uv, false,
             std::nullopt});
    }
    if (material.occlusion_strength > 0.0f) {
        add({"OCCLUSION_MAP", "OCCLUSION_UV_B", "occlusion_map", "occlusion", &material.occlusion_texture,
             &material.occlusion_uv, false, std::nullopt});
    }
    if (glossy) return wishes;
    add({"SPECULAR_COLOR_MAP", "SPECULAR_COLOR_UV_B", "specular_color_map", "specular colour",
         &material.specular_color_texture, &material.specular_color_uv, true, std::nullopt});
    add({"SPECULAR_MAP", "SPECULAR_UV_B", "specular_map", "specular", &material.specular_texture, &material.specular_uv,
         false, std::nullopt});
    return wishes;
}

bool has(const std::vector<Wish>& wishes, std::string_view define) {
    return std::ranges::find(wishes, define, &Wish::define) != wishes.end();
}

/// Read at the same place in the same way, perhaps from another image.
bool read_alike(Texture a, const UvMapping& a_uv, const Texture& b, const UvMapping& b_uv) {
    a.image = b.image;
    return a == b && a_uv == b_uv;
}

/// What comes with the fetch of another texture.
struct Packing {
    bool roughness_with_normal = false;
    bool occlusion_with_base = false;
    std::optional<glm::vec3> emission_with_base;  ///< its emission_mask()
};

/// Normals take metallic-roughness along. Occlusion goes into the alpha of an opaque colour, which means nothing,
/// unless it is in the texels of metallic-roughness already and those stay alone; where it does not go there, an
/// emission that is a mask may.
Packing packing_of(const Material& material, const std::vector<Wish>& wishes, const MaskOf& mask_of) {
    const Texture& roughness = material.metallic_roughness_texture;
    const UvMapping& roughness_uv = material.metallic_roughness_uv;
    const bool occluded = has(wishes, "OCCLUSION_MAP");
    const bool in_roughness = occluded && has(wishes, "METALLIC_ROUGHNESS_MAP") &&
                              material.occlusion_texture == roughness && material.occlusion_uv == roughness_uv;
    const bool fits_normal = has(wishes, "NORMAL_MAP") && has(wishes, "METALLIC_ROUGHNESS_MAP") &&
                             read_alike(material.normal_texture, material.normal_uv, roughness, roughness_uv);
    const bool has_alpha_left = has(wishes, "BASE_COLOR_MAP") && material.alpha_mode == AlphaMode::opaque;
    const bool fits_base = occluded && has_alpha_left &&
                           read_alike(material.base_color_texture, material.base_color_uv, material.occlusion_texture,
                                      material.occlusion_uv);
    Packing packing{.roughness_with_normal = fits_normal && (!in_roughness || fits_base),
                    .occlusion_with_base = fits_base && (!in_roughness || fits_normal),
                    .emission_with_base = std::nullopt};
    const bool emits_alike = mask_of && has_alpha_left && !packing.occlusion_with_base && has(wishes, "EMISSIVE_MAP") &&
                             read_alike(material.base_color_texture, material.base_color_uv, material.emissive_texture,
                                        material.emissive_uv);
    if (emits_alike) packing.emission_with_base = mask_of(material.emissive_texture);
    return packing;
}

bool same_picture(const Wish& a, const Wish& b) { return *a.texture == *b.texture && *a.uv == *b.uv; }

/// `spare`, and the units of textures that this material does not have.
std::vector<int> free_units(const std::vector<Wish>& wishes, std::span<const int> spare) {
    std::vector<int> units(spare.begin(), spare.end());
    for (const int own : {kEmissiveUnit, kNormalUnit, kMetallicRoughnessUnit, kBaseColorUnit}) {
        if (std::ranges::none_of(wishes, [own](const Wish& wish) { return wish.own_unit == own; }))
            units.push_back(own);
    }
    return units;
}

/// Leaves out what has coordinates of a third kind, or of a set that the mesh lacks.
void choose_mappings(const Material& material, const DrawMesh& mesh, std::vector<Wish>& wishes,
                     SurfaceTextures& result) {
    std::vector<UvMapping> kinds;
    std::erase_if(wishes, [&](const Wish& wish) {
        if (wish.uv->set == 1 && !mesh.has_uv1) {
            result.left_out.push_back(
                fmt::format("the {} texture of {} is left out: the mesh has no second set of texture coordinates",
                            wish.name, material.name));
            return true;
        }
        if (std::ranges::find(kinds, *wish.uv) != kinds.end()) return false;
        if (kinds.size() < 2) {
            kinds.push_back(*wish.uv);
            return false;
        }
        result.left_out.push_back(
            fmt::format("the {} texture of {} is left out: its coordinates are made in a third way, and two are drawn",
                        wish.name, material.name));
        return true;
    });
    if (!kinds.empty()) result.first = kinds[0];
    if (kinds.size() > 1) result.second = kinds[1];
    if (result.first.set == 1) result.defines.push_back("UV_FROM_1");
    if (!is_plain(result.first)) result.defines.push_back("UV_MAPPED");
    if (kinds.size() < 2) return;
    result.defines.push_back("UV_B");
    if (result.second.set == 1) result.defines.push_back("UV_B_FROM_1");
}

}  // namespace

SurfaceTextures surface_textures(const Material& material, const DrawMesh& mesh, std::span<const int> spare_units,
                                 bool low, bool water_map, const MaskOf& mask_of) {
    SurfaceTextures result;
    std::vector<Wish> wishes = wishes_of(material, mesh, water_map);
    choose_mappings(material, mesh, wishes, result);
    const Packing packing = packing_of(material, wishes, mask_of);
    if (packing.roughness_with_normal) {
        std::erase_if(wishes, [](const Wish& wish) { return wish.define == "METALLIC_ROUGHNESS_MAP"; });
        result.defines.push_back("PACKED_MAPS");
    }
    if (packing.occlusion_with_base) {
        std::erase_if(wishes, [](const Wish& wish) { return wish.define == "OCCLUSION_MAP"; });
        result.defines.push_back("OCCLUSION_IN_BASE");
    }
    if (packing.emission_with_base) {
        std::erase_if(wishes, [](const Wish& wish) { return wish.define == "EMISSIVE_MAP"; });
        result.defines.push_back("EMISSION_IN_BASE");
        result.emission = *packing.emission_with_base;
    }
    std::vector<int> free = free_units(wishes, spare_units);
    const auto roughness = std::ranges::find(wishes, "METALLIC_ROUGHNESS_MAP", &Wish::define);
    for (const Wish& wish : wishes) {
        if (wish.define == "OCCLUSION_MAP" && roughness != wishes.end() && same_picture(wish, *roughness)) {
            result.defines.push_back("OCCLUSION_PACKED");  // its red channel is at hand
            continue;
        }
        if (!wish.own_unit && (free.empty() || (low && wish.define == "SPECULAR_MAP"))) {
            result.left_out.push_back(fmt::format("the {} texture of {} is left out: there are eight texture units",
                                                  wish.name, material.name));
            continue;
        }
        int unit = wish.own_unit.value_or(0);
        if (!wish.own_unit) {
            unit = free.front();
            free.erase(free.begin());
        }
        SurfaceTexture used{.define = wish.define,
                            .sampler = wish.sampler,
                            .texture = *wish.texture,
                            .srgb = wish.srgb,
                            .packed = {},
                            .unit = unit};
        if (packing.roughness_with_normal && wish.define == "NORMAL_MAP")
            used.packed = material.metallic_roughness_texture;
        if (packing.occlusion_with_base && wish.define == "BASE_COLOR_MAP") used.packed = material.occlusion_texture;
        if (packing.emission_with_base && wish.define == "BASE_COLOR_MAP") {
            used.packed = material.emissive_texture;
            used.packs_emission = true;
        }
        result.used.push_back(used);
        result.defines.push_back(wish.define);
        if (!(*wish.uv == result.first)) result.defines.push_back(wish.second_define);
    }
    return result;
}

TextureUse use_of(const Material& material, const SurfaceTexture& texture, bool decoded) {
    if (texture.define == "BASE_COLOR_MAP") {
        TextureUse use = base_color_use(material, decoded);
        use.alpha_emits = texture.packs_emission;
        return use;
    }
    if (texture.define == "NORMAL_MAP") return {.kind = texture.packed ? TexelKind::packed_surface : TexelKind::normal};
    return {.decoded = texture.srgb && decoded, .kind = texture.srgb ? TexelKind::color : TexelKind::data};
}

std::vector<std::string_view> model_defines(const Material& material) {
    if (is_unlit(material)) return {"UNLIT", "DISPLAY_COLOR"};
    if (material.model == MaterialModel::specular_glossiness) return {"SPECULAR_GLOSSINESS"};
    const bool own = material.ior != Material{}.ior || material.specular != Material{}.specular ||
                     material.specular_texture || material.specular_color_texture;
    if (own) return {"OWN_SPECULAR"};
    return {};
}

glm::vec4 specular_factors_of(const Material& material) {
    if (material.model == MaterialModel::specular_glossiness)
        return {glm::clamp(material.specular, 0.0f, 1.0f), material.occlusion_strength};
    const float ratio = (material.ior - 1.0f) / (material.ior + 1.0f);
    const float normal = material.ior > 0.0f ? ratio * ratio : 1.0f;
    return {material.specular * normal, material.occlusion_strength};
}

}  // namespace halfframe
