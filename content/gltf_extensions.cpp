// Checks of glTF extensions, and the choices that a file offers: its scenes and its material variants.
#include "content/gltf_extensions.h"

#include <array>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "content/nearest.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

constexpr double kLargestFloat = 3.4e38;
constexpr double kHalfTurn_rad = 1.5707964;  // the float above pi / 2, which exporters write

constexpr std::array<std::string_view, 12> kSupported{
    "EXT_mesh_gpu_instancing",         "EXT_meshopt_compression", "KHR_lights_punctual",
    "KHR_materials_emissive_strength", "KHR_materials_ior",       "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",          "KHR_materials_unlit",     "KHR_materials_variants",
    "KHR_mesh_quantization",           "KHR_meshopt_compression", "KHR_texture_transform"};

void check_number(const JsonPlace& owner, std::string_view key, double lowest, double highest) {
    if (const auto number = owner.find(key)) (void)number->number(lowest, highest);
}

void check_numbers(const JsonPlace& owner, std::string_view key, std::size_t count, double lowest, double highest) {
    if (const auto list = owner.find(key)) list->expect_numbers(count, lowest, highest);
}

void check_light(const JsonPlace& light) {
    const std::string& type = light.at("type").text();
    if (type != "directional" && type != "point" && type != "spot") {
        light.at("type").fail(fmt::format("'{}' is not directional, point or spot", type));
    }
    check_numbers(light, "color", 3, 0.0, 1.0);
    check_number(light, "intensity", 0.0, kLargestFloat);
    check_number(light, "range", 1e-6, kLargestFloat);
    if (type == "spot") {
        const JsonPlace spot = light.at("spot");
        check_number(spot, "innerConeAngle", 0.0, kHalfTurn_rad);
        check_number(spot, "outerConeAngle", 0.0, kHalfTurn_rad);
        const double inner = spot.has("innerConeAngle") ? spot.at("innerConeAngle").number() : 0.0;
        const double outer = spot.has("outerConeAngle") ? spot.at("outerConeAngle").number() : 0.7853981633974483;
        if (inner >= outer) {
            spot.fail(fmt::format("innerConeAngle {} is not below outerConeAngle {}", inner, outer));
        }
    }
}

std::size_t count_in_extension(const JsonPlace& root, std::string_view name, std::string_view key) {
    const auto found = extension(root, name);
    return found && found->has(key) ? found->at(key).size() : 0;
}

void check_lights(const JsonPlace& root, const std::vector<JsonPlace>& nodes) {
    if (const auto lights = extension(root, "KHR_lights_punctual")) {
        for_each_object(*lights, "lights", [&](const JsonPlace& light, std::size_t) { check_light(light); });
    }
    const std::size_t count = count_in_extension(root, "KHR_lights_punctual", "lights");
    for (const JsonPlace& node : nodes) {
        if (const auto use = extension(node, "KHR_lights_punctual")) {
            (void)use->at("light");
            (void)index_in(*use, "light", count, "lights");
        }
    }
}

void check_variants(const JsonPlace& root) {
    if (const auto variants = extension(root, "KHR_materials_variants")) {
        for_each_object(*variants, "variants",
                        [&](const JsonPlace& variant, std::size_t) { (void)variant.at("name").text(); });
    }
    const std::size_t count = count_in_extension(root, "KHR_materials_variants", "variants");
    for_each_object(root, "meshes", [&](const JsonPlace& mesh, std::size_t) {
        for_each_object(mesh, "primitives", [&](const JsonPlace& primitive, std::size_t) {
            const auto use = extension(primitive, "KHR_materials_variants");
            if (!use) return;
            for_each_object(*use, "mappings", [&](const JsonPlace& mapping, std::size_t) {
                (void)mapping.at("material");
                (void)index_in(mapping, "material", count_of(root, "materials"), "materials");
                const JsonPlace list = mapping.at("variants");
                for (std::size_t i = 0; i < list.size(); ++i) {
                    if (list.at(i).whole() >= count) {
                        list.at(i).fail(fmt::format("points at number {} of {} variants", list.at(i).whole(), count));
                    }
                }
            });
        });
    });
}

/// TRANSLATION and SCALE are vectors of float; ROTATION a quaternion of float or of normalized signed integers.
void check_instancing(const JsonPlace& root, const std::vector<JsonPlace>& nodes) {
    for (const JsonPlace& node : nodes) {
        const auto use = extension(node, "EXT_mesh_gpu_instancing");
        if (!use) continue;
        const JsonPlace attributes = use->at("attributes");
        attributes.expect_object();
        std::uint64_t instances = 0;
        for (const JsonMember& member : attributes.value().members()) {
            const std::string& name = *member.key;
            const JsonPlace place = attributes.at(name);
            const std::size_t index = *index_in(attributes, name, count_of(root, "accessors"), "accessors");
            const JsonPlace accessor = root.at("accessors").at(index);
            const std::uint64_t component = accessor.at("componentType").whole();
            const bool rotation = name == "ROTATION";
            if (rotation || name == "TRANSLATION" || name == "SCALE") {
                const bool normalized = accessor.has("normalized") && accessor.at("normalized").boolean();
                const bool fits =
                    component == 5126 || (rotation && normalized && (component == 5120 || component == 5122));
                if (accessor.at("type").text() != (rotation ? "VEC4" : "VEC3") || !fits) {
                    place.fail(fmt::format("accessor {} is {} of component type {}, which {} does not allow", index,
                                           accessor.at("type").text(), component, name));
                }
            }
            const std::uint64_t count = accessor.at("count").whole();
            if (instances != 0 && count != instances) {
                place.fail(fmt::format("has {} elements but another attribute has {}", count, instances));
            }
            instances = count;
        }
    }
}

/// The index that `wished` names: one of `names`, or a number.
std::size_t chosen(const GltfDocument& document, const std::string& wished, const std::vector<std::string>& names,
                   const char* option, const char* what) {
    std::vector<std::string> shown;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!names[i].empty() && names[i] == wished) return i;
        shown.push_back(names[i].empty() ? std::to_string(i) : names[i]);
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (std::to_string(i) == wished) return i;
    }
    if (names.empty()) {
        throw Error(Fault::usage, fmt::format("{} {}: {} has no {}s; leave the option out", option, wished,
                                              document.source.file, what));
    }
    throw Error(Fault::usage, fmt::format("{} {}: there is no such {}{}; {} has {}, or a number from 0 to {}", option,
                                          wished, what, did_you_mean(wished, names), document.source.file,
                                          fmt::join(shown, ", "), names.size() - 1));
}

std::vector<std::string> names_in(const JsonPlace& owner, std::string_view key) {
    std::vector<std::string> names;
    for_each_object(owner, key, [&](const JsonPlace& element, std::size_t) { names.push_back(name_of(element)); });
    return names;
}

}  // namespace

std::span<const std::string_view> supported_extensions() { return kSupported; }

std::optional<JsonPlace> extension(const JsonPlace& owner, std::string_view name) {
    const std::optional<JsonPlace> extensions = owner.find("extensions");
    std::optional<JsonPlace> found = extensions ? extensions->find(name) : std::nullopt;
    if (found) found->expect_object();
    return found;
}

void check_texture_transform(const JsonPlace& texture_use) {
    if (const auto transform = extension(texture_use, "KHR_texture_transform")) {
        // Coordinates past a million texels of any texture are noise; this keeps their products inside float.
        check_numbers(*transform, "offset", 2, -1e9, 1e9);
        check_numbers(*transform, "scale", 2, -1e9, 1e9);
        check_number(*transform, "rotation", -1e6, 1e6);
        if (transform->has("texCoord")) {
            (void)transform->at("texCoord").whole(0, 15);
        }
    }
}

void check_material_extensions(const JsonPlace& root, const JsonPlace& material) {
    if (const auto strength = extension(material, "KHR_materials_emissive_strength")) {
        check_number(*strength, "emissiveStrength", 0.0, kLargestFloat);
    }
    if (const auto ior = extension(material, "KHR_materials_ior")) {
        if (ior->has("ior") && ior->at("ior").number(0.0, kLargestFloat) != 0.0) {
            (void)ior->at("ior").number(1.0, kLargestFloat);
        }
    }
    if (const auto specular = extension(material, "KHR_materials_specular")) {
        check_number(*specular, "specularFactor", 0.0, 1.0);
        check_numbers(*specular, "specularColorFactor", 3, 0.0, kLargestFloat);
        check_texture_use(root, *specular, "specularTexture");
        check_texture_use(root, *specular, "specularColorTexture");
    }
    if (const auto glossy = extension(material, "KHR_materials_pbrSpecularGlossiness")) {
        check_numbers(*glossy, "diffuseFactor", 4, 0.0, 1.0);
        check_numbers(*glossy, "specularFactor", 3, 0.0, 1.0);
        check_number(*glossy, "glossinessFactor", 0.0, 1.0);
        check_texture_use(root, *glossy, "diffuseTexture");
        check_texture_use(root, *glossy, "specularGlossinessTexture");
    }
    (void)extension(material, "KHR_materials_unlit");
}

void check_gltf_extensions(const GltfDocument& document) {
    const JsonPlace root = document.root();
    for_each_object(root, "materials",
                    [&](const JsonPlace& material, std::size_t) { check_material_extensions(root, material); });
    std::vector<JsonPlace> nodes;  // few of many, as a rule
    for_each_object(root, "nodes", [&](const JsonPlace& node, std::size_t) {
        if (node.has("extensions")) nodes.push_back(node);
    });
    check_lights(root, nodes);
    check_variants(root);
    check_instancing(root, nodes);
    check_meshopt(root);
}

void apply_choices(GltfDocument& document, const LoadOptions& options) {
    if (!options.scene.empty()) {
        document.chosen_scene =
            chosen(document, options.scene, names_in(document.root(), "scenes"), "--gltf-scene", "scene");
    }
    if (!options.variant.empty()) {
        const auto variants = extension(document.root(), "KHR_materials_variants");
        document.chosen_variant =
            chosen(document, options.variant, variants ? names_in(*variants, "variants") : std::vector<std::string>(),
                   "--variant", "variant");
    }
}

std::optional<std::size_t> material_of_variant(const JsonPlace& primitive, std::size_t variant) {
    std::optional<std::size_t> material;
    if (const auto use = extension(primitive, "KHR_materials_variants")) {
        for_each_object(*use, "mappings", [&](const JsonPlace& mapping, std::size_t) {
            const JsonPlace variants = mapping.at("variants");
            for (std::size_t i = 0; i < variants.size(); ++i) {
                if (variants.at(i).whole() == variant) material = mapping.at("material").whole();
            }
        });
    }
    return material;
}

}  // namespace halfframe::content
