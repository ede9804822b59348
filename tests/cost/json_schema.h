// Checks a value against the part of JSON Schema that the published schemas use.
#pragma once

#include <algorithm>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

namespace halfframe::cost {

inline nlohmann::json schema_named(const std::string& name) {
    std::ifstream stream(std::string(HALFFRAME_SOURCE_DIR) + "/content/schemas/" + name);
    return nlohmann::json::parse(stream);
}

inline bool has_type(const nlohmann::json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "null") return value.is_null();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
}

/// "/place: what is wrong", or nothing. Knows type, enum, minimum, required, properties, additionalProperties, items.
inline std::string schema_violation(const nlohmann::json& schema, const nlohmann::json& value,
                                    const std::string& place = "") {
    if (schema.contains("type")) {
        const nlohmann::json types =
            schema["type"].is_array() ? schema["type"] : nlohmann::json::array({schema["type"]});
        const auto fits = [&](const nlohmann::json& type) { return has_type(value, type.get<std::string>()); };
        if (std::none_of(types.begin(), types.end(), fits))
            return place + ": not of type " + (types.size() == 1 ? types[0].get<std::string>() : types.dump());
    }
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
        return place + ": " + value.dump() + " is not allowed";
    if (schema.contains("minimum") && value.get<double>() < schema["minimum"].get<double>())
        return place + ": below the minimum";
    if (value.is_object()) {
        for (const auto& key : schema.value("required", nlohmann::json::array()))
            if (!value.contains(key.get<std::string>())) return place + ": without " + key.get<std::string>();
        const nlohmann::json properties = schema.value("properties", nlohmann::json::object());
        for (const auto& [key, child] : value.items()) {
            if (properties.contains(key)) {
                const std::string story = schema_violation(properties[key], child, place + "/" + key);
                if (!story.empty()) return story;
            } else if (schema.contains("additionalProperties")) {
                if (schema["additionalProperties"] == false) return place + ": unknown key " + key;
                const std::string story = schema_violation(schema["additionalProperties"], child, place + "/" + key);
                if (!story.empty()) return story;
            }
        }
    }
    if (value.is_array() && schema.contains("items")) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string story = schema_violation(schema["items"], value[i], place + "/" + std::to_string(i));
            if (!story.empty()) return story;
        }
    }
    return "";
}

}  // namespace halfframe::cost
