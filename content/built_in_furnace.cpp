// The furnace: three unit spheres, left to right, in light that comes from everywhere alike.
//
// Ambient radiance is 0.5 and the sky shows the same radiance, so a thing that returns all the light it gets cannot be
// told from the background. No lights, so all that is seen is the ambient term (albedo + F) * 0.5 with F = 0.044 for
// dielectrics seen from the front:
//   white  albedo 1.0, rough        (1.0 + F) * 0.5 = 0.522: brighter than the background by the specular share,
//   because
//                                   the talk's ambient adds specular without taking it from the albedo. Known, and
//                                   kept.
//   mid    albedo 0.5, rough        (0.5 + F) * 0.5 = 0.272
//   black  albedo 0, roughness 0.2  F * 0.5 = 0.022 in the middle, rising towards the rim (Fresnel)
// Nothing may come back brighter than 0.522 away from the rims, and every pixel inside the white and the mid sphere
// must be alike up to the rise of F.
#include "content/built_in.h"

#include <glm/gtc/matrix_transform.hpp>

#include "content/plain_materials.h"
#include "content/shapes.h"

namespace halfframe::content {
namespace {

constexpr float kRadiance = 0.5f;

/// The display value that the engine's tone curve y = 1.0275 x / (x + 0.22) gives the radiance.
constexpr float kDisplay = 1.0275f * kRadiance / (kRadiance + 0.22f);

Material grey(const char* name, float albedo, float roughness) {
    return dielectric(name, glm::vec3(albedo), roughness);
}

}  // namespace

Scene make_furnace() {
    Scene scene;
    scene.name = "furnace";
    const int ball = add_mesh(scene, sphere(1.0f, 64, 32), "unit sphere");
    const int white = add_material(scene, grey("white", 1.0f, 1.0f));
    const int mid = add_material(scene, grey("mid", 0.5f, 1.0f));
    const int black = add_material(scene, grey("black", 0.0f, 0.2f));
    add_surface(scene, "white", ball, white, glm::translate(glm::mat4(1.0f), {-2.5f, 0.0f, 0.0f}));
    add_surface(scene, "mid", ball, mid, glm::mat4(1.0f));
    add_surface(scene, "black", ball, black, glm::translate(glm::mat4(1.0f), {2.5f, 0.0f, 0.0f}));
    scene.ambient = glm::vec3(kRadiance);
    scene.sky = Sky{glm::vec3(kDisplay), glm::vec3(kDisplay), glm::vec3(kDisplay)};
    scene.background = glm::vec3(kDisplay);
    Camera camera = camera_looking({0.0f, 0.0f, 11.0f}, glm::vec3(0.0f), 0.42f, world_box(scene));
    camera.name = "front";
    scene.cameras.push_back(camera);
    return scene;
}

}  // namespace halfframe::content
