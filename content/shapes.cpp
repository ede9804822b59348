// Quad, box, sphere, cylinder.
#include "content/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "engine/error.h"

namespace halfframe::content {
namespace {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 tangent;  ///< direction of growing u; v grows along -cross(normal, tangent), so w is always +1
    glm::vec2 uv;
};

void add(Mesh& mesh, const Vertex& vertex) {
    mesh.positions.push_back(vertex.position);
    mesh.normals.push_back(vertex.normal);
    mesh.tangents.emplace_back(vertex.tangent, 1.0f);
    mesh.uv.push_back(vertex.uv);
}

/// A rectangle around `centre`; `right` and `up` are half its sides, its front looks along cross(right, up).
void add_rectangle(Mesh& mesh, const glm::vec3& centre, const glm::vec3& right, const glm::vec3& up,
                   const glm::vec2& uv_repeats) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    const glm::vec3 tangent = glm::normalize(right);
    add(mesh, {centre - right - up, normal, tangent, {0.0f, uv_repeats.y}});
    add(mesh, {centre + right - up, normal, tangent, uv_repeats});
    add(mesh, {centre + right + up, normal, tangent, {uv_repeats.x, 0.0f}});
    add(mesh, {centre - right + up, normal, tangent, {0.0f, 0.0f}});
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) {
        mesh.indices.push_back(first + corner);
    }
}

/// Two triangles for each cell of a grid of (columns + 1) x (rows + 1) vertices that starts at `first`, row by row from
/// the top.
void add_grid(Mesh& mesh, std::uint32_t first, int columns, int rows) {
    const auto width = static_cast<std::uint32_t>(columns + 1);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::uint32_t above =
                first + static_cast<std::uint32_t>(row) * width + static_cast<std::uint32_t>(column);
            const std::uint32_t below = above + width;
            for (const std::uint32_t corner : {above, below, below + 1, above, below + 1, above + 1}) {
                mesh.indices.push_back(corner);
            }
        }
    }
}

/// A cap of the cylinder at height y; `facing` is +1 for the upper, -1 for the lower one.
void add_cap(Mesh& mesh, float radius_m, float y, float facing, int slices) {
    const auto centre = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 normal(0.0f, facing, 0.0f);
    const glm::vec3 tangent(1.0f, 0.0f, 0.0f);
    add(mesh, {{0.0f, y, 0.0f}, normal, tangent, {0.5f, 0.5f}});
    for (int i = 0; i <= slices; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(slices);
        const glm::vec2 rim(std::sin(angle), std::cos(angle));
        add(mesh, {{radius_m * rim.x, y, radius_m * rim.y},
                   normal,
                   tangent,
                   {0.5f + 0.5f * rim.x, 0.5f + 0.5f * facing * rim.y}});
    }
    for (int i = 0; i < slices; ++i) {
        const std::uint32_t here = centre + 1 + static_cast<std::uint32_t>(i);
        mesh.indices.push_back(centre);
        mesh.indices.push_back(facing > 0.0f ? here : here + 1);
        mesh.indices.push_back(facing > 0.0f ? here + 1 : here);
    }
}

}  // namespace

Mesh quad(const glm::vec2& size_m, const glm::vec2& uv_repeats, float cell_m) {
    Mesh mesh;
    mesh.name = "quad";
    const int columns = std::max(1, static_cast<int>(std::ceil(size_m.x / cell_m)));
    const int rows = std::max(1, static_cast<int>(std::ceil(size_m.y / cell_m)));
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const glm::vec2 share{static_cast<float>(column) / static_cast<float>(columns),
                                  static_cast<float>(row) / static_cast<float>(rows)};
            const glm::vec3 position{(share.x - 0.5f) * size_m.x, (0.5f - share.y) * size_m.y, 0.0f};
            add(mesh, {position, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}, share * uv_repeats});
        }
    }
    add_grid(mesh, 0, columns, rows);
    return mesh;
}

Mesh box(const glm::vec3& size_m) {
    struct Side {
        glm::vec3 right;
        glm::vec3 up;
    };
    static constexpr std::array<Side, 6> kSides{{{{0, 0, -1}, {0, 1, 0}},    // +X
                                                 {{0, 0, 1}, {0, 1, 0}},     // -X
                                                 {{1, 0, 0}, {0, 0, -1}},    // +Y
                                                 {{1, 0, 0}, {0, 0, 1}},     // -Y
                                                 {{1, 0, 0}, {0, 1, 0}},     // +Z
                                                 {{-1, 0, 0}, {0, 1, 0}}}};  // -Z
    Mesh mesh;
    mesh.name = "box";
    const glm::vec3 half = 0.5f * size_m;
    for (const Side& side : kSides) {
        add_rectangle(mesh, glm::cross(side.right, side.up) * half, side.right * half, side.up * half, glm::vec2(1.0f));
    }
    return mesh;
}

Mesh sphere(float radius_m, int slices, int stacks) {
    expect(slices >= 3 && stacks >= 2, "a sphere needs 3 slices and 2 stacks at least");
    Mesh mesh;
    mesh.name = "sphere";
    for (int stack = 0; stack <= stacks; ++stack) {
        const double v = static_cast<double>(stack) / stacks;
        const double theta = glm::pi<double>() * v;
        for (int slice = 0; slice <= slices; ++slice) {
            const double u = static_cast<double>(slice) / slices;
            const double phi = glm::two_pi<double>() * u - glm::pi<double>();
            const glm::dvec3 normal(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            const glm::dvec3 tangent(std::cos(phi), 0.0, -std::sin(phi));
            add(mesh, {glm::vec3(normal * static_cast<double>(radius_m)), glm::vec3(normal), glm::vec3(tangent),
                       glm::vec2(u, v)});
        }
    }
    add_grid(mesh, 0, slices, stacks);
    return mesh;
}

Mesh cylinder(float radius_m, float height_m, int slices) {
    expect(slices >= 3, "a cylinder needs 3 slices at least");
    Mesh mesh;
    mesh.name = "cylinder";
    const float top = 0.5f * height_m;
    for (int row = 0; row <= 1; ++row) {
        for (int slice = 0; slice <= slices; ++slice) {
            const float u = static_cast<float>(slice) / static_cast<float>(slices);
            const float phi = glm::two_pi<float>() * u - glm::pi<float>();
            const glm::vec3 normal(std::sin(phi), 0.0f, std::cos(phi));
            add(mesh, {{radius_m * normal.x, row == 0 ? top : -top, radius_m * normal.z},
                       normal,
                       {std::cos(phi), 0.0f, -std::sin(phi)},
                       {u, static_cast<float>(row)}});
        }
    }
    add_grid(mesh, 0, slices, 1);
    add_cap(mesh, radius_m, top, 1.0f, slices);
    add_cap(mesh, radius_m, -top, -1.0f, slices);
    return mesh;
}

}  // namespace halfframe::content
