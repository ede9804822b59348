// Neo-Paris at night, by code and seed alone. x right, y up, z towards who looks down the street; metres.
//
// The street runs along -z between facades at x = -7 and 7: a road of 8 m, pavements of 3 m. An arcade stands on the
// right from z = -2 to -40, an alley leaves to the left at z = -20 to -23.6, a street crosses at z = -40 to -50.
#pragma once

#include <string_view>
#include <vector>

#include "content/street/facade_plan.h"
#include "engine/frame/scene.h"

namespace halfframe::content::street {

struct PlacedSign {
    std::string_view text;
    glm::vec3 centre;   ///< [m] world
    glm::vec3 outward;  ///< unit: where it is read from
    glm::vec2 size_m;
    bool two_sided = false;
};

struct Street {
    Scene scene;
    std::vector<PlacedSign> signs;
    std::vector<FacadePlan> facades;
};

/// The same bits for the same seed.
[[nodiscard]] Street build_street(std::uint32_t seed);

/// 2084: the year of the talk's Neo-Paris.
constexpr std::uint32_t kDefaultSeed = 2084;

/// Depth of the deepest hollow [m].
constexpr float kDeepestPuddle_m = 0.04f;
/// COLOR_0 of asphalt, cobbles and paving: white, which leaves the albedo alone, and an alpha, for which an opaque
/// material has no other use, that says how open the place is to the rain (0..1) and how deep its hollow [m]
/// (vertex_alpha()).
[[nodiscard]] glm::vec4 water_color(float open, float depth_m);
/// How deep water stands on the road at (x, z) [m], 0 where it is dry.
[[nodiscard]] float puddle_depth_m(float x, float z, std::uint32_t seed);
/// Height of the road over its gutters [m]: it is cambered.
[[nodiscard]] float road_height_m(float x);

}  // namespace halfframe::content::street
