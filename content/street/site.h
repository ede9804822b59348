// What every part of the street is built with, and the parts.
#pragma once

#include "content/street/builder.h"
#include "content/street/materials.h"
#include "content/street/street.h"

namespace halfframe::content::street {

constexpr float kFacadeX = 7.0f;                                              ///< of both sides [m]
constexpr float kKerbX = 4.0f;                                                ///< edge of the road
constexpr float kPavement_m = 0.15f;                                          ///< height of kerbs
constexpr float kShopFloor_m = 4.4f;                                          ///< height of ground floors
constexpr float kDepth_m = 12.0f;                                             ///< of buildings
constexpr float kNearEnd = 20.0f, kFarEnd = -96.0f;                           ///< of the street, z
constexpr float kCrossNear = -40.0f, kCrossFar = -50.0f;                      ///< facades of the crossing street, z
constexpr float kCrossHalf = 36.0f;                                           ///< it runs to x = -36 and 36
constexpr float kAlleyNear = -20.0f, kAlleyFar = -23.6f, kAlleyEnd = -29.0f;  ///< z, z, x
constexpr float kArcadeNear = -2.0f, kArcadeFar = kCrossNear;                 ///< z
constexpr float kArcadeWall = 10.5f;                                          ///< x of its shops
constexpr float kArcadeTop_m = 5.2f;                                          ///< where the floors above begin

struct Site {
    Builder& builder;
    const Materials& of;
    Street& street;
    std::uint32_t seed;
    [[nodiscard]] Random random(std::uint32_t key) const { return {seed, key}; }
};

/// A frame at `origin` whose z looks along `outward`, both in world space; y is up.
[[nodiscard]] glm::mat4 facing(const glm::vec3& origin, const glm::vec3& outward);

/// A point light in the builder's frame. The radius makes its highlight that of a lamp, not of a needle.
void add_lamp(Site& site, const char* name, const glm::vec3& here, const glm::vec3& color, float range_m,
              float radius_m = 0.12f);
/// A spot that shines straight down.
void add_down_light(Site& site, const char* name, const glm::vec3& here, const glm::vec3& color, float range_m,
                    float half_angle_rad);
/// A cone of lit air under a lamp.
void add_beam(Site& site, int material, const glm::vec3& top, float height_m, float top_radius_m, float foot_radius_m,
              float strength);

/// Sign `index` of the pictures, its middle at `centre`, read from +z of the builder's frame.
void add_sign_across(Site& site, int index, const glm::vec3& centre, float width_m);
/// A board that stands out from the wall at x and is read from both sides; `foot` is its lower end.
/// `lamp`: it lights what is round it.
void add_sign_down(Site& site, int index, const glm::vec3& foot, float height_m, bool lamp);

/// Shops and doors between x = 0 and `width_m` of the builder's frame. `lamps`: they light the pavement.
void add_ground_floor(Site& site, float width_m, float top_m, Random random, bool lamps);

void add_buildings(Site& site);
void add_road(Site& site);
void add_arcade(Site& site);
void add_street_lamps(Site& site);
void add_props(Site& site);
void add_vehicles(Site& site);
void add_big_signs(Site& site);
void add_holograms(Site& site);
void add_skyline(Site& site);
void add_characters(Site& site);
void add_cameras(Scene& scene);

}  // namespace halfframe::content::street
