// Sixteen bits of vertices: what they lose, and that touching meshes keep touching.
#include "engine/frame/vertex_storage.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/frame/uploads.h"

namespace halfframe {
namespace {

glm::dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// `count` vertices in a box of `size` [m] with every stream.
Mesh cloud(std::size_t count, const glm::vec3& size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit;
    Mesh mesh;
    mesh.name = "cloud";
    mesh.primitive = Primitive::points;
    for (std::size_t i = 0; i < count; ++i) {
        mesh.positions.push_back(size * glm::vec3(unit(random), unit(random), unit(random)) - size * 0.5f);
        mesh.normals.push_back(random_direction(random));
        mesh.tangents.push_back(glm::vec4(random_direction(random), i % 2 == 0 ? 1.0f : -1.0f));
        mesh.uv.push_back({unit(random), unit(random)});
        mesh.uv1.push_back({unit(random) * 2.0f, unit(random)});
        mesh.colors.push_back({unit(random), unit(random), unit(random), unit(random)});
    }
    return mesh;
}

Scene scene_of(std::vector<Mesh> meshes) {
    Scene scene;
    scene.images.push_back({.name = "image", .width = 1024, .height = 512});
    Material material;
    material.base_color_texture.image = 0;
    scene.materials.push_back(material);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        Surface surface;
        surface.mesh = static_cast<int>(i);
        scene.surfaces.push_back(surface);
    }
    scene.meshes = std::move(meshes);
    return scene;
}

std::vector<MeshStorage> half_storages(const Scene& scene, std::vector<std::string>& notices) {
    return plan_vertex_storage(scene, VertexPrecision::half, notices);
}

TEST(VertexStorage, HalfTakesLessThanHalfTheBytesAndErrsLittle) {
    const Scene scene = scene_of({cloud(20000, {4.0f, 3.0f, 2.0f})});
    std::vector<std::string> notices;
    const MeshStorage storage = half_storages(scene, notices).front();
    EXPECT_TRUE(notices.empty());
    const StorageError error = storage_error(scene.meshes[0], storage);
    EXPECT_EQ(error.bytes_full, 20000u * 72u);
    EXPECT_EQ(error.bytes_stored, 20000u * (8 + 4 + 4 + 4 + 4 + 8)) << "dark colours need 16 bits";
    // Half a step of a 4 x 3 x 2 m box is 0.041 mm along its diagonal; random corners come near it.
    EXPECT_LE(error.worst_mm, 0.0412);
    EXPECT_GT(error.worst_mm, 0.03) << "an error of nothing would mean that nothing was stored";
    // Steps of 1/32767 on the octahedron: measured 0.0036 degrees; a tangent's y has one bit less.
    EXPECT_LE(error.worst_normal_degrees, 0.0037);
    EXPECT_GT(error.worst_normal_degrees, 0.002);
    EXPECT_LE(error.worst_tangent_degrees, 0.0065);
    EXPECT_LE(error.worst_uv_texels, 0.0157) << "half a step of two repeats of 1024 texels is 0.0156";
    // Half a step of 1/65535 where the sRGB curve is steepest (12.92): 0.025 codes.
    EXPECT_LE(error.worst_color_codes, 0.0252);
}

TEST(VertexStorage, FullLosesNothing) {
    const Mesh mesh = cloud(100, {1.0f, 1.0f, 1.0f});
    const StorageError error = storage_error(mesh, full_storage(mesh));
    EXPECT_EQ(error.worst_mm, 0.0);
    EXPECT_EQ(error.worst_normal_degrees, 0.0);
    EXPECT_EQ(error.worst_uv_texels, 0.0);
    EXPECT_EQ(error.bytes_stored, 100u * (12 + 8 + 8 + 8 + 8 + 16));
}

TEST(VertexStorage, EightBitColorsStayWhereTheyHold) {
    Mesh mesh = cloud(256, {1.0f, 1.0f, 1.0f});
    for (std::size_t i = 0; i < mesh.colors.size(); ++i) mesh.colors[i] = glm::vec4(static_cast<float>(i) / 255.0f);
    std::vector<std::string> notices;
    const MeshStorage exact = half_storages(scene_of({mesh}), notices).front();
    EXPECT_EQ(exact.colors, StreamFormat::bits8);
    EXPECT_LT(storage_error(mesh, exact).worst_color_codes, 1e-4) << "a file's own bytes come back";
    mesh.colors[3] = glm::vec4(0.5f / 255.0f);  // half way between two linear bytes: 6.5 display codes off
    EXPECT_EQ(half_storages(scene_of({mesh}), notices).front().colors, StreamFormat::bits16);
}

TEST(VertexStorage, AbsentStreamsTakeNoBytes) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<std::string> notices;
    const MeshStorage storage = half_storages(scene_of({mesh}), notices).front();
    EXPECT_EQ(vertex_layout(storage).count, 1);
    EXPECT_EQ(vertex_layout(storage).stride, 8);
    EXPECT_EQ(storage_error(mesh, storage).worst_mm, 0.0) << "corners of the box are exact";
}

TEST(VertexStorage, AMeshThatIsTooLargeKeepsThirtyTwoBitsAndSaysSo) {
    std::vector<std::string> notices;
    const auto storages = half_storages(scene_of({cloud(10, glm::vec3(100.0f))}), notices);
    EXPECT_EQ(storages[0].positions, StreamFormat::float32);
    EXPECT_EQ(storages[0].normals, StreamFormat::bits16);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("cloud keeps 32-bit positions"), std::string::npos) << notices[0];
}

TEST(VertexStorage, TheScaleItIsDrawnAtCounts) {
    Scene scene = scene_of({cloud(10, glm::vec3(1.0f))});
    scene.surfaces[0].world_from_local = glm::mat4(100.0f);
    std::vector<std::string> notices;
    EXPECT_EQ(half_storages(scene, notices)[0].positions, StreamFormat::float32);
}

TEST(VertexStorage, ManyRepeatsKeepThirtyTwoBitCoordinates) {
    Mesh mesh = cloud(10, glm::vec3(1.0f));
    mesh.uv[0] = {100.0f, 0.0f};  // 100 repeats of 1024 texels: half a step is 0.78 texels
    std::vector<std::string> notices;
    EXPECT_EQ(half_storages(scene_of({mesh}), notices)[0].uv, StreamFormat::float32);
    EXPECT_EQ(notices.size(), 1u);
}

TEST(VertexStorage, EveryHandednessSurvives) {
    std::mt19937 random(3);
    std::vector<glm::dvec3> directions{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < 5000; ++i) directions.push_back(random_direction(random));
    for (const glm::dvec3& direction : directions) {
        for (const double hand : {1.0, -1.0}) {
            const glm::i16vec2 stored = octahedral16_tangent({direction, hand});
            const glm::dvec4 back = tangent_from_octahedral(glm::dvec2(stored) / 32767.0);
            ASSERT_EQ(back.w, hand) << direction.x << ' ' << direction.y << ' ' << direction.z;
            // 2e-4: two steps of 1/32767 in y, which has half of them, at the steepest place of the octahedron.
            ASSERT_LT(glm::distance(glm::dvec3(back), direction), 2e-4);
        }
    }
}

/// Two sheets that meet along a wavy line and have different boxes.
std::pair<Mesh, Mesh> wavy_neighbours() {
    Mesh left, right;
    for (int i = 0; i <= 40; ++i) {
        const float y = static_cast<float>(i) * 0.1f - 2.0f;
        const glm::vec3 shared(0.3f * std::sin(3.0f * y), y, 0.1f * std::cos(5.0f * y));
        left.positions.insert(left.positions.end(), {shared, {-2.0f, y, 0.0f}});
        right.positions.insert(right.positions.end(), {shared, {3.7f, y * 1.3f, 0.31f}});
    }
    left.primitive = right.primitive = Primitive::triangle_strip;
    return {left, right};
}

TEST(VertexStorage, SharedCornersStaySharedToTheBit) {
    const auto [left, right] = wavy_neighbours();
    std::vector<std::string> notices;
    const Scene scene = scene_of({left, right});
    const auto storages = half_storages(scene, notices);
    ASSERT_EQ(storages[0].positions, StreamFormat::bits16);
    EXPECT_EQ(from_stored(glm::mat4(1.0f), storages[0]), from_stored(glm::mat4(1.0f), storages[1]));
    for (std::size_t i = 0; i < left.positions.size(); i += 2) {
        EXPECT_EQ(position16(left.positions[i], storages[0].position_box),
                  position16(right.positions[i], storages[1].position_box));
    }
    // Control: with a box of its own each would store them elsewhere.
    const auto alone = half_storages(scene_of({right}), notices);
    EXPECT_NE(from_stored(glm::mat4(1.0f), storages[0]), from_stored(glm::mat4(1.0f), alone[0]));
}

TEST(VertexStorage, TilesThatMeetAtTheirBoxesStillMeet) {
    // 0.3 and 0.7 are no multiples of any power of two.
    Mesh tile;
    tile.positions = {{-0.15f, 0, -0.35f}, {0.15f, 0, -0.35f}, {-0.15f, 0, 0.35f}, {0.15f, 0, 0.35f}};
    std::vector<std::string> notices;
    const MeshStorage storage = half_storages(scene_of({tile}), notices).front();
    EXPECT_EQ(storage_error(tile, storage).worst_mm, 0.0);
}

TEST(VertexStorage, MatricesTakeStoredPositionsWhereTheyBelong) {
    const Mesh mesh = cloud(500, {4.0f, 0.5f, 0.0f});
    std::vector<std::string> notices;
    const Scene scene = scene_of({mesh});
    const MeshStorage storage = half_storages(scene, notices).front();
    const glm::mat4 from_local{{0, 2, 0, 0}, {-1, 0, 0, 0}, {0, 0, 3, 0}, {5, 6, 7, 1}};
    const glm::mat4 matrix = from_stored(from_local, storage);
    const glm::vec4 scale = direction_scale(storage);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec4 exact = from_local * glm::vec4(mesh.positions[i], 1.0f);
        const glm::vec4 stored =
            matrix * glm::vec4(glm::vec3(position16(mesh.positions[i], storage.position_box)), 1.0f);
        // 7e-5: half a step of 4 m, doubled by the matrix; 1e-6 of rounding.
        EXPECT_LT(glm::distance(exact, stored), 7e-5f);
        const glm::vec3 direction = glm::normalize(glm::vec3(from_local * glm::vec4(mesh.normals[i], 0.0f)));
        const glm::vec3 undone =
            glm::normalize(glm::vec3(matrix * glm::vec4(glm::vec3(mesh.normals[i]) * glm::vec3(scale), 0.0f)));
        EXPECT_LT(glm::distance(direction, undone), 1e-5f);
    }
}

}  // namespace
}  // namespace halfframe
