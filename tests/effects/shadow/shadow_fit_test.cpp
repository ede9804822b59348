// Demand and fit of the sun's map: pure, no context.
#include "engine/effects/shadow/shadow_fit.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/effects/shadow/traced.h"

namespace halfframe::tests {
namespace {

Scene box_on_ground(const glm::vec3& sun = {-0.5f, -1.0f, -0.3f}) {
    Scene scene = sunny_ground(sun);
    add_body(scene, content::box(glm::vec3(1.0f)), {0.0f, 0.5f, 0.0f});
    return scene;
}

std::optional<ShadowFit> fit_of(const Scene& scene, const View& view) {
    return fit_shadow(scene, bodies_of(scene), scene.lights.front().direction, view);
}

std::string why(const Scene& scene) {
    const EffectDecision decision = *plan(scene).find("shadow");
    EXPECT_FALSE(decision.in) << decision.why;
    return decision.why;
}

TEST(ShadowDemand, SaysWhyExactly) {
    Scene scene = box_on_ground();
    EXPECT_TRUE(plan(scene).find("shadow")->in);
    EXPECT_EQ(plan(scene).find("shadow")->why, "the scene has a sun, 2 surfaces to stop it and 2 to be in shadow");
    EXPECT_EQ(broken_rule(plan(scene), able_caps()), std::nullopt);
    Scene dark = scene;
    dark.lights[0].color = glm::vec3(0.0f);
    EXPECT_EQ(why(dark), "no sun shines");
    dark.lights.clear();
    EXPECT_EQ(why(dark), "no sun shines");
    Scene plane = scene;
    plane.surfaces.pop_back();
    EXPECT_EQ(why(plane), "the only surface is flat: it cannot shadow itself");
    Scene point = scene;
    for (Surface& surface : point.surfaces) surface.mesh = 0;
    point.surfaces.pop_back();
    for (glm::vec3& position : point.meshes[0].positions) position = glm::vec3(0.0f);
    EXPECT_EQ(why(point), "the only surface is flat: it cannot shadow itself");
    Scene glass = scene;
    glass.materials[0].alpha_mode = AlphaMode::blend;
    EXPECT_EQ(why(glass), "nothing is shaded");
    Scene unlit = scene;
    for (Mesh& mesh : unlit.meshes) mesh.normals.clear();
    EXPECT_EQ(why(unlit), "no surface is lit, so none can be in shadow");
    Scene lines = scene;
    for (Mesh& mesh : lines.meshes) mesh.primitive = Primitive::lines;
    EXPECT_EQ(why(lines), "no surface can stop the sun");
    scene.surfaces.clear();
    EXPECT_EQ(why(scene), "nothing is shaded");
}

TEST(ShadowDemand, TheMapIsReadByEverythingItDarkens) {
    Scene scene = box_on_ground();
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].alpha_mode = AlphaMode::blend;
    scene.surfaces.push_back(scene.surfaces[1]);
    scene.surfaces.back().material = 1;
    const FramePlan frame = plan(scene);
    const int map = frame.target_index("shadow_map");
    ASSERT_GE(map, 0);
    EXPECT_EQ(frame.targets[static_cast<std::size_t>(map)].bytes(), std::size_t{2} << 20) << "2 MiB, 16 bits";
    EXPECT_EQ(frame.passes.front().name, "shadow");
    int readers = 0;
    for (const Pass& pass : frame.passes) readers += std::ranges::find(pass.reads, map) != pass.reads.end();
    EXPECT_EQ(readers, 2) << "surface and transparent";
}

TEST(ShadowFit, HoldsWhatIsSeenAndWhatCastsIntoIt) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (int i = 0; i < 200; ++i) {
        Scene scene = box_on_ground({unit(random), unit(random) - 0.2f, unit(random)});
        add_body(scene, content::box(glm::vec3(0.5f)), {3.0f * unit(random), 30.0f, 3.0f * unit(random)});
        const View view = view_of(camera_looking({5.0f * unit(random), 4.0f, 6.0f}, {unit(random), 0.0f, 0.0f}, 0.7f,
                                                 Box{glm::vec3(-10.0f), glm::vec3(10.0f)}),
                                  64, 48);
        const auto fit = fit_of(scene, view);
        ASSERT_TRUE(fit.has_value());
        const glm::dmat4 from_eye(shadow_from_eye(*fit, view.eye, 1024));
        const TracedScene traced = traced_scene(scene, scene.lights[0].direction);
        for (int pixel_index = 0; pixel_index < 16; ++pixel_index) {
            const SeenPlace place = seen_place(traced, view, 4 * (pixel_index % 4) + 20, 12 * (pixel_index / 4) + 4);
            if (!place.found) continue;
            glm::dvec3 at(place.at[0], place.at[1], place.at[2]);
            const glm::dvec3 seen(from_eye * glm::dvec4(at - glm::dvec3(view.eye), 1.0));
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GT(seen[axis], 0.0) << i;
                EXPECT_LT(seen[axis], 1.0) << i;
            }
            // Whatever stops the ray to the sun is in the map's depth.
            for (const reference::Triangle& triangle : traced.triangles) {
                const double distance = reference::distance_to(triangle, place.at, traced.toward_sun);
                if (!std::isfinite(distance)) continue;
                at += distance * glm::dvec3(traced.toward_sun[0], traced.toward_sun[1], traced.toward_sun[2]);
                EXPECT_GT((from_eye * glm::dvec4(at - glm::dvec3(view.eye), 1.0)).z, 0.0) << i;
                break;
            }
        }
    }
}

TEST(ShadowFit, StandsStillWhileTheCameraMovesAndThenStepsByWholeTexels) {
    const Scene scene = box_on_ground();
    Camera camera =
        camera_looking({3.0f, 3.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, 0.4f, Box{glm::vec3(-10.0f), glm::vec3(10.0f)});
    const ShadowFit first = *fit_of(scene, view_of(camera, 64, 48));
    const double texel = shadow_texel_m(first, 1024);
    int moves = 0, equal = 0;
    ShadowFit last = first;
    for (int step = 0; step < 400; ++step) {
        camera.world_from_view[3].x += static_cast<float>(0.3 * texel);
        const ShadowFit fit = *fit_of(scene, view_of(camera, 64, 48));
        if (fit == last) ++equal;
        else ++moves;
        if (fit.side_m == last.side_m) {
            for (int axis = 0; axis < 2; ++axis) {
                const double texels = (fit.low[axis] - last.low[axis]) / texel;
                EXPECT_NEAR(texels, std::round(texels), 1e-6) << step;
            }
        }
        last = fit;
    }
    EXPECT_GT(moves, 0) << "the camera went 120 texels";
    EXPECT_GT(equal, 380) << "the map would be drawn again nearly every frame";
}

TEST(ShadowFit, IsFiniteInEveryHardCase) {
    const auto expect_finite = [](const Scene& scene, const View& view, const char* what) {
        const auto fit = fit_of(scene, view);
        ASSERT_TRUE(fit.has_value()) << what;
        const glm::mat4 eye = shadow_from_eye(*fit, view.eye, 1024);
        const glm::mat4 clip = shadow_clip_from_local(*fit, scene.surfaces[0].world_from_local);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                EXPECT_TRUE(std::isfinite(eye[column][row])) << what;
                EXPECT_TRUE(std::isfinite(clip[column][row])) << what;
            }
        }
        EXPECT_GT(fit->depth_high, fit->depth_low) << what;
        EXPECT_NEAR(glm::determinant(fit->light_from_world), 1.0, 1e-12) << what;
    };
    for (const glm::vec3& sun : {glm::vec3(0.0f, -1.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(1.0f, 0.0f, 0.0f),
                                 glm::vec3(0.0f, 0.0f, -1.0f), glm::vec3(1e-4f, -1.0f, 0.0f)})
        expect_finite(box_on_ground(sun), slanted_view(), "a sun along an axis");
    Scene point = box_on_ground();
    for (Mesh& mesh : point.meshes) {
        for (glm::vec3& position : mesh.positions) position = glm::vec3(0.0f);
    }
    expect_finite(point, slanted_view(), "a scene of one point");
    Scene plane = box_on_ground({0.0f, -1.0f, 0.0f});
    plane.surfaces.pop_back();
    expect_finite(plane, slanted_view(), "a plane across the light: no depth");
    plane.lights[0].direction = {1.0f, 0.0f, 0.0f};
    expect_finite(plane, slanted_view(), "a plane along the light: no height");
    EXPECT_EQ(
        fit_of(box_on_ground(), view_of(camera_looking({0.0f, 5.0f, 0.0f}, {0.0f, 9.0f, 0.0f}, 0.5f, Box{}), 8, 8)),
        std::nullopt)
        << "nothing is in view";
}

}  // namespace
}  // namespace halfframe::tests
