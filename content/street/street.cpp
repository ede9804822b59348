// Puts the street together.
#include "content/street/street.h"

#include <cmath>

#include "content/built_in.h"
#include "content/content.h"
#include "content/environment/environment_strength.h"
#include "content/street/site.h"

namespace halfframe::content {

namespace street {

namespace {

// Share of the open night sky that a street of these proportions sees; the rest is walls. Ours.
constexpr float kOpenSky = 0.70f;

void add_night(Scene& scene) {
    Light moon;
    moon.kind = LightKind::sun;
    moon.name = "moon";
    // From where the night sky has it, 38 degrees right of the street's end and 41 high (content/environment).
    moon.direction = glm::normalize(glm::vec3(-0.465f, -0.656f, 0.595f));
    moon.color = glm::vec3(0.34f, 0.43f, 0.58f);
    scene.lights.push_back(moon);
    scene.sky = Sky{{0.060f, 0.080f, 0.120f}, {0.300f, 0.330f, 0.400f}, {0.05f, 0.06f, 0.07f}};
    scene.background = scene.sky->zenith;
    scene.ambient = glm::vec3(0.018f, 0.023f, 0.031f);
    EnvironmentMap night = environment("night_sky", {.size = 32}).map;
    multiply(night, kOpenSky);
    scene.environment = std::move(night);
    scene.bloom = Bloom{0.40f};
}

}  // namespace

Street build_street(std::uint32_t seed) {
    Street street;
    street.scene.name = "street";
    Builder builder(street.scene);
    const Materials of = add_materials(builder, seed);
    Site site{builder, of, street, seed};
    add_night(street.scene);
    add_buildings(site);
    add_road(site);
    add_arcade(site);
    add_street_lamps(site);
    add_props(site);
    add_vehicles(site);
    add_big_signs(site);
    add_holograms(site);
    add_skyline(site);
    builder.finish();
    add_characters(site);
    add_cameras(street.scene);
    return street;
}

}  // namespace street

Scene make_street(std::uint32_t seed) { return street::build_street(seed).scene; }

}  // namespace halfframe::content
