// Six views, each exposed for what it sees: signs and windows fill 5 to 10 % of a picture with light above 1.
#include "content/street/site.h"

namespace halfframe::content::street {

namespace {

void add_camera(Scene& scene, const char* name, const glm::vec3& eye, const glm::vec3& target, float fov_y_rad,
                float near_m, float exposure) {
    Camera camera = camera_looking(eye, target, fov_y_rad, {{-62.0f, 0.0f, -160.0f}, {62.0f, 70.0f, 20.0f}});
    camera.name = name;
    camera.near_m = near_m;
    camera.far_m = 230.0f;
    camera.exposure = exposure;
    scene.cameras.push_back(camera);
}

}  // namespace

void add_cameras(Scene& scene) {
    add_camera(scene, "street_long", {0.9f, 1.45f, 7.0f}, {-1.3f, 5.2f, -30.0f}, 0.90f, 0.25f, 1.72f);
    add_camera(scene, "arcade", {9.0f, 1.60f, -12.9f}, {8.45f, 2.0f, -24.0f}, 1.02f, 0.20f, 1.22f);
    add_camera(scene, "crossing", {-2.6f, 1.60f, -28.5f}, {1.6f, 4.4f, -50.0f}, 1.00f, 0.25f, 1.25f);
    add_camera(scene, "rooftop", {4.2f, 25.2f, 1.5f}, {-6.4f, 13.2f, -40.0f}, 0.95f, 0.40f, 1.62f);
    add_camera(scene, "sign_alley", {-9.5f, 1.60f, -21.4f}, {-17.0f, 3.6f, -21.9f}, 1.05f, 0.20f, 0.88f);
    add_camera(scene, "puddle_close", {0.5f, 0.36f, 4.4f}, {-1.5f, 2.30f, -9.0f}, 0.95f, 0.10f, 1.74f);
}

}  // namespace halfframe::content::street
