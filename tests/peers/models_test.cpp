// The written models come back from their files, and the camera has the whole of them in the picture.
#include <unistd.h>

#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "content/content.h"
#include "perf/peers/models.h"

namespace halfframe::peers {
namespace {

/// Largest |x| or |y| of any vertex in the picture, 1 at its edge; negative depths would make it infinite.
float outermost(const Scene& scene, const View& view) {
    float outermost = 0.0f;
    for (const Surface& surface : scene.surfaces) {
        for (const glm::vec3& position : scene.meshes[static_cast<std::size_t>(surface.mesh)].positions) {
            const glm::vec4 clip = view.clip_from_world() * (surface.world_from_local * glm::vec4(position, 1.0f));
            outermost = std::max({outermost, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
        }
    }
    return outermost;
}

TEST(WrittenModels, come_back_as_they_were_and_fill_the_picture) {
    const auto file = std::filesystem::temp_directory_path() / fmt::format("halfframe_peers_{}.glb", getpid());
    for (const Scene& written : {sphere_grid(), mapped_globe()}) {
        write_glb(file, written);
        const Scene read = content::load_gltf(file);
        std::filesystem::remove(file);
        EXPECT_EQ(triangle_count(read), triangle_count(written));
        EXPECT_LT(triangle_count(read), 150000u);
        ASSERT_EQ(read.surfaces.size(), written.surfaces.size());
        ASSERT_EQ(read.images.size(), written.images.size());
        for (std::size_t i = 0; i < read.images.size(); ++i) {
            EXPECT_EQ(read.images[i].rgba, written.images[i].rgba) << written.name << " image " << i;
        }
        EXPECT_EQ(read.materials.back().roughness, written.materials.back().roughness);
        const View view = view_of(close_camera(read, 16.0f / 9.0f), 1280, 720);
        // 0.97 by construction; 1e-3: the eye is placed in float, ten boxes away.
        EXPECT_NEAR(outermost(read, view), 0.97f, 1e-3f) << written.name;
    }
}

}  // namespace
}  // namespace halfframe::peers
