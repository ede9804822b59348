// --set KEY=VALUE: changes to a scene and a plan without editing files.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "engine/frame/frame_plan.h"
#include "engine/frame/scene.h"

namespace halfframe::cli {

/// "KEY=VALUE" cut in two; Error(usage) without '=' or without a key.
struct Setting {
    std::string key;
    std::string value;
};
[[nodiscard]] Setting parse_setting(const std::string& text);

/// Applies one setting; an unknown key is Error(usage) with the nearest spelling.
void apply(const Setting& setting, Scene& scene, View& view, Wishes& wishes);

/// Numbers of options. `what` names the option in the Error(usage).
[[nodiscard]] float parse_number(const std::string& text, const std::string& what);
[[nodiscard]] glm::vec3 parse_triple(const std::string& text, const std::string& what);  ///< "X,Y,Z"

}  // namespace halfframe::cli
