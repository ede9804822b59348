// A scene that is exported and loaded again is the same scene.
#include <gtest/gtest.h>

#include "content/content.h"
#include "content/png_file.h"
#include "engine/error.h"
#include "engine/frame/pose.h"
#include "engine/frame/renderer.h"
#include "tests/content/temporary_gltf.h"
#include "tests/harness/assets.h"
#include "tests/harness/gl_fixture.h"
#include "tests/motion/moving_scenes.h"

namespace halfframe::tests {
namespace {

class GltfExport : public harness::GlFixture {
protected:
    Scene back(const Scene& scene) {
        return content::load_gltf(folder_.write("exported.glb", content::gltf_binary(scene)));
    }
    struct Frame {
        Picture picture;
        std::vector<std::string> passes;
        std::size_t texture_bytes = 0;
        std::size_t calls = 0;
    };
    /// As it stands, or in the middle of its first animation.
    Frame draw(Scene scene, Tier tier, bool moving = false) {
        const View view = view_of(scene.cameras.at(0), 96, 54);
        Renderer renderer(gl(), caps());
        Animator animator(scene);
        const FramePlan plan = plan_frame(scene, view, {.tier = tier}, caps(), all_effects());
        renderer.prepare(scene, plan);
        if (moving) animator.pose(scene, 0, 0.4 * scene.animations.at(0).duration_s);
        gl().start_trace();
        renderer.draw(view);
        Frame frame{.picture = renderer.read_display(), .passes = {}, .texture_bytes = renderer.texture_bytes()};
        const std::string trace = gl().trace_json();
        gl().stop_trace();
        for (std::size_t at = trace.find("\"gl"); at != std::string::npos; at = trace.find("\"gl", at + 1))
            ++frame.calls;
        for (const Pass& pass : plan.passes) frame.passes.push_back(pass.name);
        return frame;
    }
    void expect_same_frame(const Scene& scene, const Scene& loaded, Tier tier, bool moving) {
        const Frame before = draw(scene, tier, moving);
        const Frame after = draw(loaded, tier, moving);
        const std::string what = scene.name + ' ' + halfframe::name(tier) + (moving ? ", moving" : ", at rest");
        EXPECT_EQ(before.passes, after.passes) << what;
        EXPECT_EQ(before.texture_bytes, after.texture_bytes) << what;
        EXPECT_GT(before.calls, 10u) << what;
        EXPECT_EQ(before.calls, after.calls) << what;
        EXPECT_TRUE(before.picture.rgba == after.picture.rgba) << what;
    }
    TemporaryFolder folder_;
};

TEST_F(GltfExport, BuiltInScenesDrawTheSameFrame) {
    for (const char* name : {"test_room", "spheres", "lamps", "wet_yard"}) {
        const Scene scene = content::open_scene(name);
        const Scene loaded = back(scene);
        EXPECT_TRUE(loaded.notices.empty()) << loaded.notices.front();
        EXPECT_TRUE(content::not_exported(scene).empty());
        EXPECT_EQ(loaded.surfaces.size(), scene.surfaces.size()) << name;
        EXPECT_EQ(loaded.meshes.size(), scene.meshes.size()) << name;
        EXPECT_EQ(loaded.materials.size(), scene.materials.size()) << name;
        EXPECT_EQ(loaded.images.size(), scene.images.size()) << name;
        EXPECT_EQ(loaded.lights.size(), scene.lights.size()) << name;
        for (const Tier tier : {Tier::low, Tier::console}) expect_same_frame(scene, loaded, tier, false);
    }
}

void add_view_of_all(Scene& scene) {
    if (scene.cameras.empty()) scene.cameras.push_back(camera_framing(world_box(scene), 16.0f / 9.0f));
    (void)content::add_studio_rig(scene);
}

void expect_same_motion(const Scene& scene, const Scene& loaded) {
    ASSERT_EQ(loaded.surfaces.size(), scene.surfaces.size()) << scene.name;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        EXPECT_EQ(loaded.surfaces[i].world_from_local, scene.surfaces[i].world_from_local) << scene.name << ' ' << i;
        EXPECT_EQ(loaded.surfaces[i].dynamic, scene.surfaces[i].dynamic) << scene.name << ' ' << i;
        const Mesh& a = scene.meshes.at(static_cast<std::size_t>(scene.surfaces[i].mesh));
        const Mesh& b = loaded.meshes.at(static_cast<std::size_t>(loaded.surfaces[i].mesh));
        EXPECT_TRUE(a.positions == b.positions && a.normals == b.normals) << scene.name << ' ' << i;
        EXPECT_EQ(a.joints.size(), b.joints.size()) << scene.name << ' ' << i;
        EXPECT_EQ(a.morph_targets.size(), b.morph_targets.size()) << scene.name << ' ' << i;
    }
    ASSERT_EQ(loaded.animations.size(), scene.animations.size()) << scene.name;
    for (std::size_t i = 0; i < scene.animations.size(); ++i) {
        EXPECT_EQ(loaded.animations[i].name, scene.animations[i].name);
        EXPECT_EQ(loaded.animations[i].duration_s, scene.animations[i].duration_s) << scene.animations[i].name;
        EXPECT_EQ(loaded.animations[i].channels.size(), scene.animations[i].channels.size());
    }
}

TEST_F(GltfExport, WhatMovesMovesTheSame) {
    std::vector<Scene> scenes{two_bones({3.0f, 0.0f, -2.0f}), many_bones(40), morphing_square(), moving_scene()};
    if (const auto assets = harness::assets_folder()) {
        for (const char* file :
             {"AnimatedMorphCube/glTF-Quantized/AnimatedMorphCube.gltf", "BoxAnimated/glTF-Binary/BoxAnimated.glb",
              "CesiumMan/glTF-Binary/CesiumMan.glb", "Fox/glTF-Binary/Fox.glb",
              "InterpolationTest/glTF-Binary/InterpolationTest.glb", "LightsPunctualLamp/glTF/LightsPunctualLamp.gltf",
              "MorphPrimitivesTest/glTF-Binary/MorphPrimitivesTest.glb",
              "NegativeScaleTest/glTF-Binary/NegativeScaleTest.glb"}) {
            scenes.push_back(content::load_gltf(*assets / "khronos" / file));
        }
    }
    for (Scene& scene : scenes) {
        place(scene);
        add_view_of_all(scene);
        for (Camera& camera : scene.cameras) camera.node = -1;  // one that is framed moves with nothing
        const Scene loaded = back(scene);
        EXPECT_TRUE(content::not_exported(scene).empty());
        expect_same_motion(scene, loaded);
        expect_same_frame(scene, loaded, Tier::console, false);
        if (!scene.animations.empty()) expect_same_frame(scene, loaded, Tier::console, true);
    }
}

TEST_F(GltfExport, TheStreetAndItsWalkersComeBack) {
    Scene scene = content::open_scene("street");
    place(scene);
    const Scene loaded = back(scene);
    EXPECT_EQ(loaded.notices, std::vector<std::string>());
    EXPECT_EQ(loaded.skins.size(), 2u);
    expect_same_motion(scene, loaded);
    expect_same_frame(scene, loaded, Tier::console, true);
}

TEST_F(GltfExport, ThingsKeepTheirOrder) {
    // Two things that turn on one standing node, one that stands between them, a lamp and an eye that are carried.
    Scene scene = content::open_scene("lamps");
    scene.surfaces.resize(3);
    scene.nodes = {{.name = "stand", .translation = {1.0f, 0.0f, 0.0f}},
                   {.name = "left", .parent = 0, .translation = {0.0f, 0.5f, 0.0f}},
                   {.name = "right", .parent = 0, .translation = {0.0f, 1.5f, 0.0f}, .scale = glm::vec3(0.5f)}};
    scene.animations = {{.name = "turn", .channels = {}, .duration_s = 1.0f}};
    for (const int node : {1, 2}) {
        scene.animations[0].channels.push_back({.node = node,
                                                .value = AnimatedValue::rotation,
                                                .interpolation = Interpolation::linear,
                                                .times_s = {0.0f, 1.0f},
                                                .values = {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 0.0f}});
    }
    scene.surfaces[0].node = 1;
    scene.surfaces[2].node = 2;
    scene.lights.back().node = 2;
    scene.cameras.push_back(scene.cameras.front());
    scene.cameras.back().name = "carried";
    scene.cameras.back().node = 1;
    place(scene);
    for (std::size_t i : {std::size_t{0}, std::size_t{2}}) scene.surfaces[i].dynamic = true;
    const Scene loaded = back(scene);
    ASSERT_EQ(loaded.surfaces.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(loaded.surfaces[i].name, scene.surfaces[i].name);
    ASSERT_EQ(loaded.cameras.size(), scene.cameras.size());
    EXPECT_EQ(loaded.cameras.back().name, "carried");
    EXPECT_EQ(loaded.lights.size(), scene.lights.size());
    expect_same_motion(scene, loaded);
    expect_same_frame(scene, loaded, Tier::console, true);
    // And once more: a file does not grow by being loaded and written.
    EXPECT_EQ(content::gltf_binary(back(loaded)).size(), content::gltf_binary(loaded).size());
}

TEST_F(GltfExport, EveryWordOfAMaterialComesBack) {
    Scene scene = content::open_scene("test_room");
    Material& material = scene.materials.at(0);
    scene.images.push_back({.name = "dot", .width = 1, .height = 1, .srgb = false, .rgba = {1, 2, 3, 4}});
    const Texture dot{.image = static_cast<int>(scene.images.size()) - 1,
                      .wrap_u = Wrap::mirror,
                      .wrap_v = Wrap::clamp,
                      .linear = false,
                      .mipmaps = true,
                      .minify = Minify{.linear = true, .between = false}};
    material.ior = 1.7f;
    material.specular = {0.25f, 0.5f, 0.75f};
    material.occlusion_texture = material.specular_texture = dot;
    material.occlusion_strength = 0.3f;
    material.occlusion_uv = {.set = 0, .offset = {0.1f, 0.2f}, .scale = {3.0f, 4.0f}, .rotation_rad = 0.5f};
    material.emissive = {5.3f, 0.1f, 0.0f};
    material.alpha_mode = AlphaMode::mask;
    material.alpha_cutoff = 0.35f;
    material.double_sided = true;
    const Scene loaded = back(scene);
    const auto found = std::find_if(loaded.materials.begin(), loaded.materials.end(),
                                    [&](const Material& each) { return each.name == material.name; });
    ASSERT_NE(found, loaded.materials.end());
    EXPECT_EQ(found->ior, material.ior);
    EXPECT_EQ(found->specular, material.specular);
    EXPECT_EQ(found->occlusion_strength, material.occlusion_strength);
    EXPECT_EQ(found->occlusion_uv, material.occlusion_uv);
    EXPECT_EQ(found->emissive, material.emissive);
    EXPECT_EQ(found->alpha_cutoff, material.alpha_cutoff);
    EXPECT_TRUE(found->double_sided);
    Texture same = found->occlusion_texture;
    EXPECT_EQ(loaded.images.at(static_cast<std::size_t>(same.image)).rgba, scene.images.back().rgba);
    same.image = dot.image;
    EXPECT_EQ(same, dot);
}

TEST_F(GltfExport, MirroredSurfacesKeepTheirFaces) {
    Scene scene = content::open_scene("lamps");
    scene.surfaces.at(0).world_from_local[0] *= -1.0f;
    const Scene loaded = back(scene);
    const auto& a = scene.meshes.at(static_cast<std::size_t>(scene.surfaces.at(0).mesh));
    const auto& b = loaded.meshes.at(static_cast<std::size_t>(loaded.surfaces.at(0).mesh));
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_EQ(a.positions, b.positions);
}

}  // namespace
}  // namespace halfframe::tests
