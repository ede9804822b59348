// A square that fills the picture, seen head on from 2 m, with its scene_color read back as floats.
#pragma once

#include <string>

#include "engine/frame/renderer.h"
#include "tests/frame/planning.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {

/// A tier and an arithmetic to draw at.
struct On {
    Tier tier;
    Arithmetic arithmetic;
    [[nodiscard]] std::string words() const { return std::string(name(tier)) + ' ' + name(arithmetic); }
};
inline constexpr On kEverywhere[] = {{Tier::low, Arithmetic::half},
                                     {Tier::low, Arithmetic::full},
                                     {Tier::console, Arithmetic::half},
                                     {Tier::console, Arithmetic::full},
                                     {Tier::reference, Arithmetic::full}};

/// The square of planning.h, 100 m wide, so that it covers every pixel.
inline Scene wide_square() {
    Scene scene = square_scene();
    for (glm::vec3& position : scene.meshes[0].positions) position *= 100.0f;
    scene.materials[0].metallic = 0.0f;
    scene.materials[0].roughness = 1.0f;
    return scene;
}

/// Linear colour of the pixel at (x, y) from the left and the top.
inline glm::vec3 pixel(const FloatPicture& picture, int x, int y) {
    const std::size_t at =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)) * 4;
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

/// scene_color of one frame of `scene` in RGBA32F.
inline FloatPicture scene_color(harness::Ground& ground, const Scene& scene, const View& view, Tier tier,
                                Arithmetic arithmetic, std::span<const EffectCard* const> cards = all_effects()) {
    // One sample a pixel: what surface wrote, not what a resolve made of it.
    const Wishes wishes{.tier = tier,
                        .effect_switches = {{"anti_alias", false}},
                        .arithmetic = arithmetic,
                        .storage = gl::PixelFormat::rgba32f};
    const FramePlan frame = plan_frame(scene, view, wishes, ground.caps, cards);
    Renderer renderer(ground.gl, ground.caps, {.program_cache_folder = {}, .effects = cards});
    renderer.prepare(scene, frame);
    renderer.draw(view);
    EXPECT_EQ(renderer.first_gl_error(), "");
    return renderer.read_target(frame.target_index("scene_color"));
}

}  // namespace halfframe::tests
