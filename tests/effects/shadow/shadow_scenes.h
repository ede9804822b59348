// Scenes whose shadows are known: a sun over a white ground, with nothing else to light it.
#pragma once

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "content/built_in.h"
#include "content/shapes.h"
#include "engine/effects/shadow/shadow_reference.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {

inline Material white() {
    Material material;
    material.metallic = 0.0f;
    material.roughness = 1.0f;
    return material;
}

inline Light sun_along(const glm::vec3& direction) {
    Light sun;
    sun.kind = LightKind::sun;
    sun.name = "sun";
    sun.direction = glm::normalize(direction);
    return sun;
}

/// A level square of ground, `size_m` wide, around (0, 0, 0), and a sun.
inline Scene sunny_ground(const glm::vec3& sun_direction, float size_m = 20.0f) {
    Scene scene;
    scene.name = "sunny ground";
    content::add_material(scene, white());
    content::add_surface(scene, "ground", content::add_mesh(scene, content::quad(glm::vec2(size_m)), "ground"), 0,
                         glm::rotate(glm::mat4(1.0f), -0.5f * std::numbers::pi_v<float>, glm::vec3(1.0f, 0.0f, 0.0f)));
    scene.lights.push_back(sun_along(sun_direction));
    return scene;
}

inline void add_body(Scene& scene, Mesh mesh, const glm::vec3& position, int material = 0) {
    content::add_surface(scene, "body", content::add_mesh(scene, std::move(mesh), "body"), material,
                         glm::translate(glm::mat4(1.0f), position));
}

/// From above and aside, the whole of a few metres around the origin in view.
inline View slanted_view(int width = 160, int height = 120) {
    return view_of(camera_looking({3.0f, 6.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, 0.8f,
                                  Box{glm::vec3(-10.0f, 0.0f, -10.0f), glm::vec3(10.0f, 3.0f, 10.0f)}),
                   width, height);
}

/// The world triangles of a surface.
inline std::vector<reference::Triangle> triangles_of(const Scene& scene, std::size_t index) {
    const Surface& surface = scene.surfaces[index];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
    std::vector<reference::Triangle> triangles;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        reference::Triangle triangle;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec4 at = glm::dmat4(surface.world_from_local) *
                                  glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + corner]]), 1.0);
            triangle.corners[corner] = {at.x, at.y, at.z};
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

/// The way from the eye through a pixel (from the left and the top), unit.
inline reference::Point pixel_ray(const View& view, int x, int y) {
    const double u = 2.0 * (x + 0.5) / view.width - 1.0;
    const double v = 1.0 - 2.0 * (y + 0.5) / view.height;
    const glm::dvec4 at = glm::inverse(glm::dmat4(view.clip_from_view)) * glm::dvec4(u, v, 0.0, 1.0);
    const glm::dvec3 ray = glm::normalize(glm::inverse(glm::dmat3(view.view_from_world)) * (glm::dvec3(at) / at.w));
    return {ray.x, ray.y, ray.z};
}

/// scene_color with the shadow switched, as floats, one sample a pixel. `surface`: its tier, if not `tier`.
inline FloatPicture with_shadow(harness::Ground& ground, const Scene& scene, const View& view, Tier tier,
                                Arithmetic arithmetic, bool on, std::optional<Tier> surface = {}) {
    const Wishes wishes{.tier = tier,
                        .effect_tiers = {{"surface", surface.value_or(tier)}},
                        .effect_switches = {{"shadow", on}, {"anti_alias", false}},
                        .arithmetic = arithmetic,
                        .storage = gl::PixelFormat::rgba32f};
    const FramePlan frame = plan_frame(scene, view, wishes, ground.caps, all_effects());
    Renderer renderer(ground.gl, ground.caps);
    renderer.prepare(scene, frame);
    renderer.draw(view);
    EXPECT_EQ(renderer.first_gl_error(), "");
    return renderer.read_target(frame.target_index("scene_color"));
}

/// Share of the light that the shadow leaves at each pixel, row by row from the top; -1 where there was none.
struct Shares {
    int width = 0;
    std::vector<double> values;
    [[nodiscard]] double at(int x, int y) const {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};
inline Shares shares(harness::Ground& ground, const Scene& scene, const View& view, Tier tier, Arithmetic arithmetic,
                     std::optional<Tier> surface = {}) {
    const FloatPicture on = with_shadow(ground, scene, view, tier, arithmetic, true, surface);
    const FloatPicture off = with_shadow(ground, scene, view, tier, arithmetic, false, surface);
    Shares result{.width = on.width, .values = {}};
    for (std::size_t i = 0; i < on.rgba.size(); i += 4) {
        // Below 1e-3 the quotient says nothing: the surface looks away from the sun.
        result.values.push_back(off.rgba[i] > 1e-3f ? double{on.rgba[i]} / double{off.rgba[i]} : -1.0);
    }
    return result;
}

}  // namespace halfframe::tests
