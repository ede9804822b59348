// Triangle lists, flat normals, tangents, mirroring, and the shapes made in code.
#include "content/mesh_tools.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "content/shapes.h"

namespace halfframe::tests {
namespace {

using content::add_tangents;
using content::flat_shaded;
using content::mirrored;
using content::triangle_list;

Mesh square(Primitive primitive, std::vector<std::uint32_t> indices) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.primitive = primitive;
    mesh.indices = std::move(indices);
    return mesh;
}

/// Front of every triangle, which must be the same.
glm::vec3 front(const Mesh& mesh) {
    const std::vector<std::uint32_t> list = triangle_list(mesh);
    glm::vec3 result(0.0f);
    for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
        const glm::vec3 normal = glm::normalize(glm::cross(mesh.positions[list[i + 1]] - mesh.positions[list[i]],
                                                           mesh.positions[list[i + 2]] - mesh.positions[list[i]]));
        EXPECT_TRUE(i == 0 || normal == result) << "triangle " << i / 3;
        result = normal;
    }
    return result;
}

TEST(MeshTools, ListStripAndFanShowTheSameFront) {
    const glm::vec3 to_us(0, 0, 1);
    EXPECT_EQ(front(square(Primitive::triangles, {0, 1, 2, 0, 2, 3})), to_us);
    EXPECT_EQ(front(square(Primitive::triangle_strip, {0, 1, 3, 2})), to_us);
    EXPECT_EQ(front(square(Primitive::triangle_fan, {})), to_us);
}

TEST(MeshTools, MirroredTurnsEveryFaceAndTheHandedness) {
    for (const Primitive primitive : {Primitive::triangle_strip, Primitive::triangle_fan}) {
        Mesh mesh = square(primitive, primitive == Primitive::triangle_strip ? std::vector<std::uint32_t>{0, 1, 3, 2}
                                                                             : std::vector<std::uint32_t>{});
        mesh.tangents.assign(4, {1, 0, 0, 1});
        const Mesh turned = mirrored(mesh);
        EXPECT_EQ(front(turned), glm::vec3(0, 0, -1));
        EXPECT_EQ(turned.tangents[0].w, -1.0f);
    }
}

TEST(MeshTools, FlatShadedOfADegenerateFaceIsUnit) {
    Mesh mesh;
    mesh.positions.assign(3, {1, 2, 3});
    EXPECT_EQ(flat_shaded(mesh).normals.at(0), glm::vec3(0, 1, 0));
}

/// The normal that flat_shaded() gives a face, written out.
glm::vec3 flat_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::vec3 twice_area(glm::clamp(glm::cross(b - a, c - a), -1e30, 1e30));
    const float largest = std::max({std::abs(twice_area.x), std::abs(twice_area.y), std::abs(twice_area.z)});
    const bool has_area =
        std::isfinite(twice_area.x) && std::isfinite(twice_area.y) && std::isfinite(twice_area.z) && largest > 0.0f;
    return has_area ? glm::normalize(twice_area / largest) : glm::vec3(0.0f, 1.0f, 0.0f);
}

TEST(MeshTools, FlatNormalsAreMadeAsIfOneByOneToTheBit) {
    std::mt19937 random(20131107);
    const auto number = [&] { return static_cast<float>(random() % 2001) / 1000.0f - 1.0f; };
    constexpr float kInfinite = std::numeric_limits<float>::infinity(), kNone = std::nanf("");
    for (const std::size_t faces : {1u, 63u, 64u, 65u, 1000u, 200u}) {
        const bool are_easy = faces == 200u;  // no block has one without area
        Mesh mesh;
        for (std::size_t i = 0; i < 3 * faces; ++i) {
            glm::vec3 place(number(), number(), number());
            const bool is_odd = !are_easy && i % 3 == 2 && random() % 8 == 0;
            switch (is_odd ? random() % 6 : 6) {
                case 0: place = mesh.positions[i - 1]; break;  // without area
                case 1: place.x = kInfinite; break;
                case 2: place.y = kNone; break;
                case 3: place *= 1e38f; break;
                case 4: place = mesh.positions[i - 1] * (1.0f + 1e-7f); break;
                case 5: place *= 1e-42f; break;
                default: break;
            }
            mesh.positions.push_back(place);
            mesh.indices.push_back(static_cast<std::uint32_t>((i + 2) % (3 * faces)));
        }
        for (const bool is_indexed : {true, false}) {
            if (!is_indexed) mesh.indices.clear();
            const Mesh flat = flat_shaded(mesh);
            ASSERT_EQ(flat.normals.size(), 3 * faces);
            for (std::size_t i = 0; i < 3 * faces; ++i) {
                const auto place = [&](std::size_t corner) {
                    const std::size_t at = i / 3 * 3 + corner;
                    return glm::dvec3(mesh.positions[is_indexed ? mesh.indices[at] : at]);
                };
                const glm::vec3 wanted = flat_normal(place(0), place(1), place(2));
                EXPECT_EQ(std::memcmp(&flat.normals[i], &wanted, sizeof wanted), 0)
                    << i << " of " << faces << " faces: " << flat.normals[i].x << " for " << wanted.x;
            }
        }
    }
}

TEST(MeshTools, TangentsFollowUAndKnowMirroredUv) {
    Mesh mesh = square(Primitive::triangles, {0, 1, 2, 0, 2, 3});
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uv = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    add_tangents(mesh);
    EXPECT_EQ(mesh.tangents[0], glm::vec4(1, 0, 0, 1));
    mesh.uv = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};  // u the other way around
    add_tangents(mesh);
    EXPECT_EQ(mesh.tangents[0], glm::vec4(-1, 0, 0, -1));
    mesh.uv.assign(4, {0.5f, 0.5f});  // no direction at all
    add_tangents(mesh);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6);  // rounding of one normalize
        EXPECT_NEAR(tangent.z, 0.0f, 1e-6);
    }
}

class Shapes : public ::testing::TestWithParam<int> {
protected:
    static Mesh shape(int which) {
        switch (which) {
            case 0: return content::quad({2, 3}, {4, 5});
            case 1: return content::box({1, 2, 3});
            case 2: return content::sphere(2.0f);
            default: return content::cylinder(0.5f, 3.0f);
        }
    }
};

TEST_P(Shapes, FacesLookOutAlongTheirNormals) {
    const Mesh mesh = shape(GetParam());
    const std::vector<std::uint32_t> list = triangle_list(mesh);
    ASSERT_FALSE(list.empty());
    int faces = 0;
    for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
        const glm::vec3 face = glm::cross(mesh.positions[list[i + 1]] - mesh.positions[list[i]],
                                          mesh.positions[list[i + 2]] - mesh.positions[list[i]]);
        if (glm::length(face) > 1e-9f) {  // the triangles at the poles of the sphere have no area
            EXPECT_GT(glm::dot(face, mesh.normals[list[i]]), 0.0f) << "triangle " << i / 3;
            ++faces;
        }
    }
    EXPECT_GT(faces, 1);
}

TEST_P(Shapes, TangentsAreThoseOfTheUv) {
    Mesh mesh = shape(GetParam());
    const std::vector<glm::vec4> made = mesh.tangents;
    ASSERT_EQ(made.size(), mesh.positions.size());
    add_tangents(mesh);
    int compared = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5);  // rounding of sines and cosines
        EXPECT_NEAR(glm::dot(glm::vec3(made[i]), mesh.normals[i]), 0.0f, 1e-5);
        if (std::abs(mesh.normals[i].y) < 0.99f || GetParam() == 1) {  // at a pole u has no direction
            // 0.98: along the seam a vertex has faces on one side only, half a slice (4 to 6 degrees) off.
            EXPECT_GT(glm::dot(glm::vec3(made[i]), glm::vec3(mesh.tangents[i])), 0.98f) << "vertex " << i;
            EXPECT_EQ(made[i].w, mesh.tangents[i].w) << "vertex " << i;
            ++compared;
        }
    }
    EXPECT_GT(compared, 3);
}

INSTANTIATE_TEST_SUITE_P(All, Shapes, ::testing::Range(0, 4));

/// repair_tangents() of one vertex, written out.
glm::vec4 repaired(const glm::vec4& tangent, const glm::vec3& normal) {
    const glm::vec3 given(tangent);
    if (std::abs(glm::dot(given, given) - 1.0f) < 5e-7f && std::abs(glm::dot(given, normal)) < 5e-7f &&
        std::abs(tangent.w) == 1.0f)
        return tangent;
    const float largest = std::max({std::abs(given.x), std::abs(given.y), std::abs(given.z)});
    const bool has_length =
        std::isfinite(given.x) && std::isfinite(given.y) && std::isfinite(given.z) && largest > 0.0f;
    const glm::vec3 unit = has_length ? glm::normalize(given / largest) : glm::vec3(0.0f);
    const glm::vec3 flat = unit - normal * glm::dot(normal, unit);
    const glm::vec3 axis = std::abs(normal.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
    const glm::vec3 some = glm::normalize(axis - normal * glm::dot(normal, axis));
    return {glm::length(flat) > 0.01f ? glm::normalize(flat) : some, tangent.w < 0.0f ? -1.0f : 1.0f};
}

TEST(MeshTools, TangentsAreRepairedAsIfOneByOneToTheBit) {
    std::mt19937 random(20131107);
    const auto number = [&] { return static_cast<float>(random() % 2001) / 1000.0f - 1.0f; };
    constexpr float kInfinite = std::numeric_limits<float>::infinity(), kNone = std::nanf("");
    for (const std::size_t count : {1u, 63u, 64u, 65u, 1000u, 200u}) {
        const bool along_axes = count == 200u;  // whose units are not calculated
        Mesh mesh;
        std::vector<glm::vec4> wanted;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 normal = glm::normalize(glm::vec3(number(), number(), number()) + glm::vec3(0, 0, 1.5f));
            glm::vec4 tangent(number(), number(), number(), number());
            switch (random() % 12) {
                case 0: tangent = glm::vec4(0.0f, -0.0f, 0.0f, 1.0f); break;
                case 1: tangent = glm::vec4(normal * number(), -1.0f); break;  // no direction is left
                case 2: tangent.x = kInfinite; break;
                case 3: tangent.y = kNone; break;
                case 4: tangent *= 1e38f; break;
                case 5: tangent *= 1e-42f; break;
                case 6: tangent.w = kNone; break;
                case 7: tangent = repaired(tangent, normal); break;
                default: break;
            }
            if (along_axes) {
                tangent = glm::vec4(-0.0f, 0.0f, 1e-6f * number(), 1.0f);
                tangent[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1.0f : -1.0f;
            }
            mesh.positions.emplace_back(0.0f);
            mesh.normals.push_back(normal);
            mesh.tangents.push_back(tangent);
            wanted.push_back(repaired(tangent, normal));
        }
        content::repair_tangents(mesh);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(std::memcmp(&mesh.tangents[i], &wanted[i], sizeof wanted[i]), 0)
                << i << " of " << count << ": " << mesh.tangents[i].x << " for " << wanted[i].x;
        }
    }
}

}  // namespace
}  // namespace halfframe::tests
