// A scene that draws a given picture of linear light: one square a pixel, seen straight on.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "engine/frame/renderer.h"
#include "tests/frame/planning.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {

/// Linear light, row 0 at the top.
struct LightPicture {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> light;
    LightPicture(int w, int h, const glm::vec3& all = glm::vec3(0.0f))
        : width(w), height(h), light(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), all) {}
    [[nodiscard]] glm::vec3& at(int x, int y) { return light[static_cast<std::size_t>(y * width + x)]; }
    [[nodiscard]] const glm::vec3& at(int x, int y) const { return light[static_cast<std::size_t>(y * width + x)]; }
};

/// Every pixel of one light is a square of one mesh; without normals, so it shows what its material says.
inline Scene pixel_scene(const LightPicture& picture) {
    Scene scene;
    scene.name = "pixels";
    scene.background = glm::vec3(0.0f);
    std::map<std::tuple<float, float, float>, int> known;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::vec3& light = picture.at(x, y);
            const auto [entry, is_new] = known.try_emplace({light.r, light.g, light.b}, static_cast<int>(known.size()));
            if (is_new) {
                scene.meshes.emplace_back();
                scene.materials.push_back({.base_color = glm::vec4(light, 1.0f)});
                scene.surfaces.push_back({.name = "light",
                                          .mesh = entry->second,
                                          .material = entry->second,
                                          .world_from_local = glm::mat4(1.0f),
                                          .dynamic = false});
            }
            Mesh& mesh = scene.meshes[static_cast<std::size_t>(entry->second)];
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            const auto left = static_cast<float>(x);
            const auto bottom = static_cast<float>(picture.height - 1 - y);
            for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
                mesh.positions.emplace_back(left + corner.x, bottom + corner.y, 0.0f);
            for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
        }
    }
    return scene;
}

/// One unit of the scene is one pixel.
inline View pixel_view(int width, int height) {
    Camera camera;
    camera.world_from_view[3] = {0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height), 2.0f, 1.0f};
    camera.orthographic = true;
    camera.half_height_m = 0.5f * static_cast<float>(height);
    camera.near_m = 1.0f;
    camera.far_m = 3.0f;
    return view_of(camera, width, height);
}

/// Draws one frame and hands the renderer to `read` before it goes.
template <typename Read>
auto draw_and_read(harness::Ground& ground, const Scene& scene, const View& view, const Wishes& wishes, Read read,
                   std::span<const EffectCard* const> cards = all_effects()) {
    const FramePlan frame = plan_frame(scene, view, wishes, ground.caps, cards);
    EXPECT_EQ(broken_rule(frame, ground.caps), std::nullopt);
    Renderer renderer(ground.gl, ground.caps, {.effects = cards});
    renderer.prepare(scene, frame);
    renderer.draw(view);
    EXPECT_EQ(renderer.first_gl_error(), "");
    return read(renderer);
}

/// The target of that name after one frame, as floats.
inline FloatPicture target_after(harness::Ground& ground, const Scene& scene, const View& view, const Wishes& wishes,
                                 const char* target, std::span<const EffectCard* const> cards = all_effects()) {
    return draw_and_read(
        ground, scene, view, wishes,
        [&](Renderer& renderer) {
            const int index = renderer.plan().target_index(target);
            EXPECT_GE(index, 0) << target;
            return index < 0 ? FloatPicture{} : renderer.read_target(index);
        },
        cards);
}

inline Picture display_after(harness::Ground& ground, const Scene& scene, const View& view, const Wishes& wishes) {
    return draw_and_read(ground, scene, view, wishes, [](Renderer& renderer) { return renderer.read_display(); });
}

}  // namespace halfframe::tests
