// A scene that is exported and loaded again is the same scene.
#include <gtest/gtest.h>

#include "content/content.h"
#include "content/png_file.h"
#include "engine/error.h"
#include "engine/frame/renderer.h"
#include "tests/content/temporary_gltf.h"
#include "tests/harness/gl_fixture.h"

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
    Frame draw(const Scene& scene, Tier tier) {
        const View view = view_of(scene.cameras.at(0), 96, 54);
        Renderer renderer(gl(), caps());
        const FramePlan plan = plan_frame(scene, view, {.tier = tier}, caps(), all_effects());
        renderer.prepare(scene, plan);
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
        for (const Tier tier : {Tier::low, Tier::console}) {
            const Frame before = draw(scene, tier);
            const Frame after = draw(loaded, tier);
            EXPECT_EQ(before.passes, after.passes) << name;
            EXPECT_EQ(before.texture_bytes, after.texture_bytes) << name;
            EXPECT_GT(before.calls, 20u) << name;
            EXPECT_EQ(before.calls, after.calls) << name << ' ' << halfframe::name(tier);
            EXPECT_EQ(before.picture.rgba, after.picture.rgba) << name << ' ' << halfframe::name(tier);
        }
    }
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
