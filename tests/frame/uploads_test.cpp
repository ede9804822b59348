// Packing of vertices, cutting of large meshes, fitting of images.
#include "engine/frame/uploads.h"

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

/// Corners of every triangle of a piece by their x, which names the vertex.
std::vector<std::array<int, 3>> triangles(const MeshPiece& piece) {
    std::vector<std::array<int, 3>> out;
    for (std::size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
        std::array<int, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = static_cast<int>(piece.vertices[piece.indices[i + k]].position[0]);
        out.push_back(corners);
    }
    return out;
}

TEST(Uploads, DirectionsKeepSixteenBits) {
    Mesh mesh = strip(3);
    mesh.normals = {{0.6f, 0.8f, 0.0f}, {0.0f, 0.0f, -1.0f}, {1.0f, 0.0f, 0.0f}};
    const MeshPiece piece = packed_pieces(mesh, 100).front();
    EXPECT_NEAR(piece.vertices[0].normal[0] / 32767.0, 0.6, 2e-5);  // half a step of 1/32767
    EXPECT_EQ(piece.vertices[1].normal[2], -32767);
}

TEST(Uploads, AMeshThatFitsIsLeftAlone) {
    const auto pieces = packed_pieces(strip(10), 10);
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].primitive, Primitive::triangle_strip);
    EXPECT_TRUE(pieces[0].indices.empty());
}

TEST(Uploads, ACutStripKeepsItsTrianglesAndTheirWinding) {
    const auto pieces = packed_pieces(strip(20), 7);
    ASSERT_GT(pieces.size(), 1u);
    std::vector<std::array<int, 3>> all;
    for (const MeshPiece& piece : pieces) {
        EXPECT_LE(piece.vertices.size(), 7u);
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
    for (const MeshPiece& piece : packed_pieces(fan, 5)) {
        for (const auto& triangle : triangles(piece)) {
            EXPECT_EQ(triangle[0], 0);
            ++count;
        }
    }
    EXPECT_EQ(count, 7u);

    Mesh loop = strip(9);
    loop.primitive = Primitive::line_loop;
    std::size_t lines = 0;
    for (const MeshPiece& piece : packed_pieces(loop, 4)) lines += piece.indices.size() / 2;
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
    const Image small = fitted(checker(64, 16), 20, false);
    EXPECT_EQ(small.width, 16);
    EXPECT_EQ(small.height, 4);
    for (std::size_t i = 0; i < small.rgba.size(); i += 4)
        EXPECT_EQ(small.rgba[i], 128) << "the mean of black and white";
}

TEST(Uploads, AnImageBecomesAPowerOfTwo) {
    const Image fit = fitted(checker(100, 33), 4096, true);
    EXPECT_EQ(fit.width, 64);
    EXPECT_EQ(fit.height, 32);
    EXPECT_EQ(fit.rgba.size(), 64u * 32u * 4u);
    EXPECT_EQ(fitted(checker(64, 32), 4096, true).rgba, checker(64, 32).rgba) << "one that is already stays as it is";
}

}  // namespace
}  // namespace halfframe
