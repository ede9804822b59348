// Every glTF file that can be found loads or is refused with a sentence; nothing else happens.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/error.h"
#include "tests/harness/assets.h"

namespace halfframe::tests {
namespace {

namespace fs = std::filesystem;

/// Broken promises of a loaded scene, as one sentence; empty when there is none.
std::string broken_promise(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
        if (!fits(mesh.normals.size()) || !fits(mesh.tangents.size()) || !fits(mesh.uv.size()) ||
            !fits(mesh.colors.size())) {
            return mesh.name + ": streams of different lengths";
        }
        if (std::any_of(mesh.indices.begin(), mesh.indices.end(),
                        [&](auto index) { return index >= mesh.positions.size(); })) {
            return mesh.name + ": an index past the last vertex";
        }
        for (const glm::vec3& normal : mesh.normals) {
            if (!(std::abs(glm::length(normal) - 1.0f) < 1e-4f)) {  // a float division by a float root
                return mesh.name + ": a normal that is not unit";
            }
        }
        for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
            const glm::vec3 tangent(mesh.tangents[i]);
            // 1e-3: orthogonalised in float against a float normal.
            if (!(std::abs(glm::length(tangent) - 1.0f) < 1e-3f) ||
                !(std::abs(glm::dot(tangent, mesh.normals[i])) < 1e-3f) || std::abs(mesh.tangents[i].w) != 1.0f) {
                return mesh.name + ": a tangent that is not unit and orthogonal";
            }
        }
    }
    for (const Surface& surface : scene.surfaces) {
        if (surface.mesh < 0 || surface.mesh >= static_cast<int>(scene.meshes.size()) || surface.material < 0 ||
            surface.material >= static_cast<int>(scene.materials.size())) {
            return surface.name + ": mesh or material out of range";
        }
    }
    for (const Image& image : scene.images) {
        if (image.width < 1 || image.height < 1 ||
            image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
            return image.name + ": pixels do not fit its size";
        }
    }
    return {};
}

struct Outcome {
    int loaded = 0;
    int refused = 0;
};

Outcome sweep(const std::vector<fs::path>& files) {
    Outcome outcome;
    for (const fs::path& file : files) {
        try {
            EXPECT_EQ(broken_promise(content::load_gltf(file)), "") << file;
            ++outcome.loaded;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::input) << file;
            EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ": ")) << error.what();
            ++outcome.refused;
        }
    }
    return outcome;
}

fs::path assets() { return harness::assets_folder().value_or(fs::path()); }

TEST(GltfAssets, Khronos) {
    if (assets().empty()) GTEST_SKIP() << harness::assets_missing();
    const Outcome outcome = sweep(harness::gltf_files(assets() / "khronos"));
    EXPECT_GT(outcome.loaded, 0);
    EXPECT_LT(outcome.refused, outcome.loaded);
}

TEST(GltfAssets, KayKit) {
    if (assets().empty()) GTEST_SKIP() << harness::assets_missing();
    const Outcome outcome = sweep(harness::gltf_files(assets() / "kaykit"));
    EXPECT_GT(outcome.loaded, 0);
    EXPECT_EQ(outcome.refused, 0);
}

TEST(GltfAssets, InvalidFilesEndWell) {
    if (assets().empty()) GTEST_SKIP() << harness::assets_missing();
    const Outcome outcome = sweep(harness::gltf_files(assets() / "invalid"));
    EXPECT_GT(outcome.loaded, 0);
    EXPECT_GT(outcome.refused, 0);
}

TEST(GltfAssets, AssimpModels) {
    const auto folder = harness::assimp_models_folder();
    if (!folder) GTEST_SKIP() << harness::assimp_models_missing();
    const Outcome outcome = sweep(harness::gltf_files(*folder));
    EXPECT_GT(outcome.loaded, 0);
    EXPECT_GT(outcome.refused, 0);
}

TEST(GltfAssets, AssimpModelsOfVersion1AreNamedSo) {
    const auto folder = harness::assimp_models_folder();
    if (!folder) GTEST_SKIP() << harness::assimp_models_missing();
    const fs::path old = folder->parent_path() / "glTF";
    if (!fs::exists(old)) GTEST_SKIP() << "no " << old << ": the package of the models has no glTF 1.0 files";
    const std::vector<fs::path> files = harness::gltf_files(old);
    ASSERT_FALSE(files.empty());
    for (const fs::path& file : files) {
        try {
            (void)content::load_gltf(file);
            ADD_FAILURE() << file << " loads";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("glTF 1.0"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace halfframe::tests
