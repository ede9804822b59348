// Packing of vertices, cutting of large meshes, fitting of images.
#include "engine/frame/uploads.h"

#include <array>
#include <cstring>

#include <gtest/gtest.h>

namespace halfframe {
namespace {

/// A strip of `count` vertices along x; vertex i is at x = i.
Mesh strip(std::size_t count) {
    Mesh mesh;
    mesh.primitive = Primitive::triangle_strip;
    for (std::size_t i = 0; i < count; ++i)
        mesh.positions.push_back({static_cast<float>(i), static_cast<float>(i % 2), 0.0f});
    return mesh;
}

/// Position of a vertex that is stored in 32 bits: it stands first.
glm::vec3 position_of(const MeshPiece& piece, std::size_t vertex) {
    const std::size_t stride = piece.vertices.size() / piece.vertex_count;
    glm::vec3 position;
    std::memcpy(&position, piece.vertices.data() + vertex * stride, sizeof(position));
    return position;
}

/// Corners of every triangle of a piece by their x, which names the vertex.
std::vector<std::array<int, 3>> triangles(const MeshPiece& piece) {
    std::vector<std::array<int, 3>> out;
    for (std::size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
        std::array<int, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) corners[k] = static_cast<int>(position_of(piece, piece.indices[i + k]).x);
        out.push_back(corners);
    }
    return out;
}

std::vector<MeshPiece> full_pieces(const Mesh& mesh, std::size_t max_vertices) {
    return packed_pieces(mesh, full_storage(mesh), max_vertices);
}

TEST(Uploads, AMeshThatFitsIsLeftAlone) {
    const auto pieces = full_pieces(strip(10), 10);
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].primitive, Primitive::triangle_strip);
    EXPECT_TRUE(pieces[0].indices.empty());
}

TEST(Uploads, ACutStripKeepsItsTrianglesAndTheirWinding) {
    const auto pieces = full_pieces(strip(20), 7);
    ASSERT_GT(pieces.size(), 1u);
    std::vector<std::array<int, 3>> all;
    for (const MeshPiece& piece : pieces) {
        EXPECT_LE(piece.vertex_count, 7u);
        EXPECT_EQ(piece.primitive, Primitive::triangles);
        for (const auto& triangle : triangles(piece)) all.push_back(triangle);
    }
    ASSERT_EQ(all.size(), 18u);
    for (int i = 0; i < 18; ++i) {
        const auto expected = i % 2 == 0 ? std::array{i, i + 1, i + 2} : std::array{i + 1, i, i + 2};
        EXPECT_EQ(all[static_cast<std::size_t>(i)], expected) << "triangle " << i;
    }
}

TEST(Uploads, ACutFanAndLoopKeepTheirPrimitives) {
    Mesh fan = strip(9);
    fan.primitive = Primitive::triangle_fan;
    std::size_t count = 0;
    for (const MeshPiece& piece : full_pieces(fan, 5)) {
        for (const auto& triangle : triangles(piece)) {
            EXPECT_EQ(triangle[0], 0);
            ++count;
        }
    }
    EXPECT_EQ(count, 7u);

    Mesh loop = strip(9);
    loop.primitive = Primitive::line_loop;
    std::size_t lines = 0;
    for (const MeshPiece& piece : full_pieces(loop, 4)) lines += piece.indices.size() / 2;
    EXPECT_EQ(lines, 9u) << "eight lines and the one that closes the loop";
}

Image checker(int width, int height) {
    Image image{.name = "checker", .width = width, .height = height, .srgb = false, .rgba = {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::uint8_t value = (x + y) % 2 == 0 ? 255 : 0;
            image.rgba.insert(image.rgba.end(), {value, value, value, 255});
        }
    }
    return image;
}

TEST(Uploads, AnImageThatIsTooLargeIsHalved) {
    const Image small = fitted(checker(64, 16), 20, false, TexelKind::data);
    EXPECT_EQ(small.width, 16);
    EXPECT_EQ(small.height, 4);
    for (std::size_t i = 0; i < small.rgba.size(); i += 4)
        EXPECT_EQ(small.rgba[i], 128) << "the mean of black and white";
}

TEST(Uploads, AnImageBecomesAPowerOfTwo) {
    const Image fit = fitted(checker(100, 33), 4096, true, TexelKind::data);
    EXPECT_EQ(fit.width, 64);
    EXPECT_EQ(fit.height, 32);
    EXPECT_EQ(fit.rgba.size(), 64u * 32u * 4u);
    EXPECT_EQ(fitted(checker(64, 32), 4096, true, TexelKind::data).rgba, checker(64, 32).rgba)
        << "one that is already stays as it is";
}

}  // namespace
}  // namespace halfframe
