// The table of keys, their checks, and their JSON schema.
#include "content/gltf_extras.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "content/gltf_extensions.h"
#include "content/nearest.h"

namespace halfframe::content {
namespace {

enum class ValueKind { boolean, number, color, environment, water_mask, texture };

struct Row {
    ExtrasOwner owner;
    const char* key;
    ValueKind kind;
    double lowest, highest;  ///< of a number, or of each of the three of a colour
    const char* purpose;
    void (*apply)(const glm::vec3& value, const ExtrasTarget& target);  ///< a boolean or a number is x
};

constexpr double kMostLight = 60000.0;  ///< below the largest half

Sky& sky_of(const ExtrasTarget& target) {
    if (!target.scene->sky) target.scene->sky.emplace();
    return *target.scene->sky;
}

Wetness& wetness_of(const ExtrasTarget& target) {
    if (!target.scene->wetness) target.scene->wetness = Wetness{.level = 0.0f};
    return *target.scene->wetness;
}

/// In the order of WaterMask.
constexpr std::array<std::string_view, 4> kWaterMasks{"none", "everywhere", "vertex", "texture"};

constexpr std::array kRows{
    Row{ExtrasOwner::scene, "hf_environment", ValueKind::environment, 0.0, 0.0,
        "surroundings that light the scene and show in it",
        [](const glm::vec3& value, const ExtrasTarget& target) {
            target.surroundings->name = environment_names()[static_cast<std::size_t>(value.x)];
        }},
    Row{ExtrasOwner::scene, "hf_environment_size", ValueKind::number, 16.0, 512.0,
        "texels a side of the surroundings: 16, 32, 64, 128, 256 or 512",
        [](const glm::vec3& value, const ExtrasTarget& target) {
            target.surroundings->size = 1 << std::lround(std::log2(value.x));
        }},
    Row{ExtrasOwner::scene, "hf_environment_strength", ValueKind::number, 0.0, 1000.0, "factor on the surroundings",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.surroundings->strength = value.x; }},
    Row{ExtrasOwner::scene, "hf_ambient", ValueKind::color, 0.0, kMostLight, "light from everywhere, linear",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.scene->ambient = value; }},
    Row{ExtrasOwner::scene, "hf_background", ValueKind::color, 0.0, 1.0, "display colour behind everything",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.scene->background = value; }},
    Row{ExtrasOwner::scene, "hf_bloom_strength", ValueKind::number, 0.0, 1.0,
        "share of the light above 1 that glows; 0: no glow",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.scene->bloom = Bloom{.strength = value.x}; }},
    Row{ExtrasOwner::scene, "hf_sky_zenith", ValueKind::color, 0.0, 1.0, "display colour of the sky above",
        [](const glm::vec3& value, const ExtrasTarget& target) { sky_of(target).zenith = value; }},
    Row{ExtrasOwner::scene, "hf_sky_horizon", ValueKind::color, 0.0, 1.0, "display colour of the sky at the horizon",
        [](const glm::vec3& value, const ExtrasTarget& target) { sky_of(target).horizon = value; }},
    Row{ExtrasOwner::scene, "hf_sky_ground", ValueKind::color, 0.0, 1.0, "display colour below the horizon",
        [](const glm::vec3& value, const ExtrasTarget& target) { sky_of(target).ground = value; }},
    Row{ExtrasOwner::scene, "hf_wetness", ValueKind::number, 0.0, 1.0,
        "how wet is what takes up water: 0 dry, 1 soaked",
        [](const glm::vec3& value, const ExtrasTarget& target) { wetness_of(target).level = value.x; }},
    Row{ExtrasOwner::scene, "hf_wetness_live", ValueKind::boolean, 0.0, 1.0,
        "the wetness changes: it is not written into textures",
        [](const glm::vec3& value, const ExtrasTarget& target) { wetness_of(target).is_static = value.x == 0.0f; }},
    Row{ExtrasOwner::scene, "hf_rain_ended_s", ValueKind::number, 0.0, 1e6, "seconds since the rain stopped; all dries",
        [](const glm::vec3& value, const ExtrasTarget& target) { wetness_of(target).since_s = value.x; }},
    Row{ExtrasOwner::scene, "hf_drying_s", ValueKind::number, 0.1, 1e6, "all is dry this long after the rain [s]",
        [](const glm::vec3& value, const ExtrasTarget& target) { wetness_of(target).dry_s = value.x; }},
    Row{ExtrasOwner::scene, "hf_puddles", ValueKind::number, 0.0, 1.0,
        "how far hollows are filled: 0 not at all, 1 to the brim",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.scene->puddles = Puddles{.level = value.x}; }},
    Row{ExtrasOwner::material, "hf_water", ValueKind::water_mask, 0.0, 0.0,
        "where it takes up water; vertex: alpha of COLOR_0, 0 sheltered, 127/255 open, 1 the deepest hollow",
        [](const glm::vec3& value, const ExtrasTarget& target) {
            target.material->water = static_cast<WaterMask>(std::lround(value.x));
        }},
    Row{ExtrasOwner::material, "hf_water_texture", ValueKind::texture, 0.0, 1e6,
        "index of a texture at the coordinates of the base colour: R share of the water, G height",
        [](const glm::vec3& value, const ExtrasTarget& target) {
            *target.water_texture = static_cast<int>(std::lround(value.x));
        }},
    Row{ExtrasOwner::material, "hf_puddle_depth_m", ValueKind::number, 0.001, 10.0,
        "depth of the deepest hollow of the vertices [m]",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.material->deepest_puddle_m = value.x; }},
    Row{ExtrasOwner::node, "hf_dynamic", ValueKind::boolean, 0.0, 1.0, "moves: casts a shadow at the low tier",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.surface->dynamic = value.x > 0.0f; }},
    Row{ExtrasOwner::mesh, "hf_dynamic", ValueKind::boolean, 0.0, 1.0, "moves: casts a shadow at the low tier",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.surface->dynamic = value.x > 0.0f; }},
    Row{ExtrasOwner::camera, "hf_exposure", ValueKind::number, 1e-6, 1e6, "factor on light before the tone map",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.camera->exposure = value.x; }},
    Row{ExtrasOwner::light, "hf_radius_m", ValueKind::number, 0.0, 1e4, "radius of the shining sphere [m]; 0: a point",
        [](const glm::vec3& value, const ExtrasTarget& target) { target.light->radius_m = value.x; }},
};

constexpr std::array<const char*, 6> kOwnerNames{"scene", "node", "mesh", "camera", "light", "material"};
const char* name_of(ExtrasOwner owner) { return kOwnerNames[static_cast<std::size_t>(owner)]; }

const Row* row_of(ExtrasOwner owner, std::string_view key) {
    for (const Row& row : kRows) {
        if (row.owner == owner && row.key == key) return &row;
    }
    return nullptr;
}

std::vector<std::string> keys_of(ExtrasOwner owner) {
    std::vector<std::string> keys;
    for (const Row& row : kRows) {
        if (row.owner == owner) keys.emplace_back(row.key);
    }
    return keys;
}

[[noreturn]] void fail_unknown(const JsonPlace& extras, ExtrasOwner owner, std::string_view key) {
    std::string elsewhere;
    for (const Row& row : kRows) {
        if (row.key == key) elsewhere = fmt::format(" (it belongs to a {})", name_of(row.owner));
    }
    const std::vector<std::string> keys = keys_of(owner);
    extras.fail(fmt::format("a {} has no key '{}'{}{}", name_of(owner), key, elsewhere,
                            elsewhere.empty() ? did_you_mean(key, keys) : std::string()),
                fmt::format("its keys are {}", fmt::join(keys, ", ")));
}

/// The value, checked. A boolean may be written 0 or 1, as some programs do.
glm::vec3 value_of(const Row& row, const JsonPlace& place) {
    glm::vec3 value(0.0f);
    if (row.kind == ValueKind::boolean) {
        value.x = place.value().is_boolean() ? (place.boolean() ? 1.0f : 0.0f) : static_cast<float>(place.whole(0, 1));
    } else if (row.kind == ValueKind::environment) {
        const std::vector<std::string> names = environment_names();
        const auto found = std::ranges::find(names, place.text());
        if (found == names.end()) {
            place.fail(fmt::format("there is no environment '{}'{}", place.text(), did_you_mean(place.text(), names)),
                       fmt::format("choose one of {}", fmt::join(names, ", ")));
        }
        value.x = static_cast<float>(found - names.begin());
    } else if (row.kind == ValueKind::water_mask) {
        const auto found = std::ranges::find(kWaterMasks, place.text());
        if (found == kWaterMasks.end()) {
            const std::vector<std::string> words(kWaterMasks.begin(), kWaterMasks.end());
            place.fail(fmt::format("there is no mask '{}'{}", place.text(), did_you_mean(place.text(), words)),
                       fmt::format("choose one of {}", fmt::join(words, ", ")));
        }
        value.x = static_cast<float>(found - kWaterMasks.begin());
    } else if (row.kind == ValueKind::texture) {
        value.x = static_cast<float>(place.whole(0, static_cast<std::uint64_t>(row.highest)));
    } else if (row.kind == ValueKind::number) {
        value.x = static_cast<float>(place.number(row.lowest, row.highest));
    } else {
        place.expect_numbers(3, row.lowest, row.highest);
        for (int i = 0; i < 3; ++i) value[i] = static_cast<float>(place.at(static_cast<std::size_t>(i)).number());
    }
    return value;
}

/// Calls visit(row, value) for every key of ours.
template <typename Visit>
void for_each_key(const JsonPlace& object, ExtrasOwner owner, Visit&& visit) {
    const auto extras = object.find("extras");
    if (!extras || !extras->value().is_object()) return;  // extras may be anything
    for (const JsonMember& member : extras->value().members()) {
        const std::string& key = *member.key;
        if (!std::string_view(key).starts_with("hf_")) continue;
        const Row* row = row_of(owner, key);
        if (row == nullptr) fail_unknown(*extras, owner, key);
        visit(*row, value_of(*row, extras->at(key)));
    }
}

/// What the keys of one material say together.
void check_water(const JsonPlace& root, const JsonPlace& material) {
    Material read;
    int texture = -1;
    apply_extras(material, ExtrasOwner::material, {.material = &read, .water_texture = &texture});
    if (texture >= 0) {
        const std::size_t count = root.has("textures") ? root.at("textures").size() : 0;
        if (static_cast<std::size_t>(texture) >= count) {
            material.at("extras")
                .at("hf_water_texture")
                .fail(fmt::format("there is no texture {}: the file has {}", texture, count));
        }
    }
    if (read.water == WaterMask::texture && texture < 0) {
        material.at("extras")
            .at("hf_water")
            .fail("the mask is in a texture and none is named", "name one with hf_water_texture");
    }
    const bool opaque = !material.has("alphaMode") || material.at("alphaMode").text() == "OPAQUE";
    if (read.water == WaterMask::vertex_color && !opaque) {
        material.at("extras")
            .at("hf_water")
            .fail("the alpha of the vertices is needed for coverage here",
                  "write everywhere or texture, or make the material OPAQUE");
    }
}

}  // namespace

void check_gltf_extras(const GltfDocument& document) {
    const JsonPlace root = document.root();
    const auto check_all = [](const JsonPlace& owner, const char* list, ExtrasOwner kind) {
        for_each_object(owner, list, [&](const JsonPlace& object, std::size_t) {
            for_each_key(object, kind, [](const Row&, const glm::vec3&) {});
        });
    };
    check_all(root, "scenes", ExtrasOwner::scene);
    check_all(root, "nodes", ExtrasOwner::node);
    check_all(root, "meshes", ExtrasOwner::mesh);
    check_all(root, "cameras", ExtrasOwner::camera);
    check_all(root, "materials", ExtrasOwner::material);
    for_each_object(root, "materials", [&](const JsonPlace& object, std::size_t) { check_water(root, object); });
    if (const auto lights = extension(root, "KHR_lights_punctual")) check_all(*lights, "lights", ExtrasOwner::light);
}

void apply_extras(const JsonPlace& object, ExtrasOwner owner, const ExtrasTarget& target) {
    for_each_key(object, owner, [&](const Row& row, const glm::vec3& value) { row.apply(value, target); });
}

std::string extras_schema() {
    nlohmann::ordered_json schema = {
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", "glTF extras that halfframe reads"},
        {"description", "One definition for each kind of object; made by extras_schema() of content/gltf_extras.cpp"}};
    for (std::size_t i = 0; i < kOwnerNames.size(); ++i) {
        nlohmann::ordered_json properties = nlohmann::ordered_json::object();
        for (const Row& row : kRows) {
            if (row.owner != static_cast<ExtrasOwner>(i)) continue;
            const nlohmann::ordered_json number = {
                {"type", "number"}, {"minimum", row.lowest}, {"maximum", row.highest}};
            nlohmann::ordered_json type = number;
            if (row.kind == ValueKind::environment) type = {{"enum", environment_names()}};
            if (row.kind == ValueKind::water_mask) type = {{"enum", kWaterMasks}};
            if (row.kind == ValueKind::texture) type["type"] = "integer";
            if (row.kind == ValueKind::boolean) type = {{"enum", {false, true, 0, 1}}};
            if (row.kind == ValueKind::color)
                type = {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
            type["description"] = row.purpose;
            properties[row.key] = type;
        }
        schema["$defs"][kOwnerNames[i]] = {{"type", "object"}, {"properties", properties}};
        // Unknown keys of ours are errors, those of others are welcome.
        schema["$defs"][kOwnerNames[i]]["propertyNames"] = {
            {"anyOf", {{{"enum", keys_of(static_cast<ExtrasOwner>(i))}}, {{"not", {{"pattern", "^hf_"}}}}}}};
    }
    return schema.dump(2) + "\n";
}

}  // namespace halfframe::content
