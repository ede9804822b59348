// Faces into cells, cells into meshes.
#include "content/street/builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "content/built_in.h"
#include "engine/effects/surface/surface.h"
#include "engine/error.h"

namespace halfframe::content::street {

namespace {

// Cells [m]: as long as two lamps reach, so that the lamps of one do not crowd those of another out of its eight; the
// sides of the street apart. What shines by itself is cut only so that most of it can be out of view.
constexpr float kCellAcross = 24.0f;
constexpr float kCellAlong = 14.0f;
constexpr float kUnlitAlong = 56.0f;
constexpr float kGroundFloor = 4.6f;

constexpr std::size_t kMostLamps = 8;  // that the effect surface draws on one object
constexpr float kShortestCut = 3.0f;  // a shorter mesh is not cut again [m]
constexpr float kShortestCutForOne = 6.0f;  // where one lamp is lost, the faintest of nine: each cut costs three draws

/// The triangles whose middle lies below the mean of all middles on an axis, and the others. Corners stay what they are.
std::pair<Mesh, Mesh> halves(const Mesh& mesh, int axis) {
    std::pair<Mesh, Mesh> result;
    double all = 0.0;
    for (const std::uint32_t corner : mesh.indices) all += static_cast<double>(mesh.positions[corner][axis]);
    const auto mean = static_cast<float>(all / static_cast<double>(mesh.indices.size()));
    std::vector<std::uint32_t> in_low(mesh.positions.size(), UINT32_MAX), in_high = in_low;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        float sum = 0.0f;
        for (std::size_t k = 0; k < 3; ++k) sum += mesh.positions[mesh.indices[i + k]][axis];
        const bool low = sum < 3.0f * mean;
        Mesh& half = low ? result.first : result.second;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = mesh.indices[i + k];
            std::uint32_t& known = (low ? in_low : in_high)[corner];
            if (known == UINT32_MAX) {
                known = static_cast<std::uint32_t>(half.positions.size());
                half.positions.push_back(mesh.positions[corner]);
                half.normals.push_back(mesh.normals[corner]);
                half.tangents.push_back(mesh.tangents[corner]);
                half.uv.push_back(mesh.uv[corner]);
                if (!mesh.colors.empty()) half.colors.push_back(mesh.colors[corner]);
            }
            half.indices.push_back(known);
        }
    }
    return result;
}

/// The unit vector, or `otherwise` where there is no direction.
glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-7f ? v / length : otherwise;
}

}  // namespace

int Builder::add_material(Material material, const Mapping& mapping) {
    mappings_.push_back(mapping);
    return content::add_material(scene_, std::move(material));
}

int Builder::add_image(Image image) { return content::add_image(scene_, std::move(image)); }

Mesh& Builder::cell_of(int material, const glm::vec3& world) {
    const Mapping& mapping = mappings_[static_cast<std::size_t>(material)];
    const float along = mapping.unlit ? kUnlitAlong : kCellAlong;
    return cells_[{material, static_cast<int>(std::floor(world.x / kCellAcross)),
                   mapping.wall && world.y > kGroundFloor ? 1 : 0, static_cast<int>(std::floor(world.z / along))}];
}

void Builder::add(Mesh& mesh, int material, const Vertex& here) {
    const glm::mat3 turn(world_from_here_);
    mesh.positions.push_back(world(here.position));
    mesh.normals.push_back(glm::normalize(turn * here.normal));
    const glm::vec3& normal = mesh.normals.back();
    const glm::vec3 tangent = turn * here.tangent;
    mesh.tangents.emplace_back(glm::normalize(tangent - normal * glm::dot(normal, tangent)), 1.0f);
    mesh.uv.push_back(here.uv);
    if (mappings_[static_cast<std::size_t>(material)].colors) mesh.colors.push_back(here.color);
}

void Builder::add_quad(int material, const std::array<Vertex, 4>& corners) {
    const glm::vec3 middle =
        0.25f * (corners[0].position + corners[1].position + corners[2].position + corners[3].position);
    Mesh& mesh = cell_of(material, world(middle));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vertex& corner : corners) add(mesh, material, corner);
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + index);
}

glm::vec2 Builder::flat_uv(int material, const glm::vec3& here, const glm::vec3& right, const glm::vec3& up) const {
    const float side_m = mappings_[static_cast<std::size_t>(material)].side_m;
    return glm::vec2(glm::dot(here, right), -glm::dot(here, up)) / side_m;
}

void Builder::quad(int material, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up) {
    patch(material, {corner, corner + right, corner + right + up, corner + up});
}

void Builder::picture(int material, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up,
                      const glm::vec2& uv_low, const glm::vec2& uv_high) {
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    const glm::vec3 tangent = glm::normalize(right);
    add_quad(material, {Vertex{corner, normal, tangent, {uv_low.x, uv_high.y}, color_},
                        Vertex{corner + right, normal, tangent, uv_high, color_},
                        Vertex{corner + right + up, normal, tangent, {uv_high.x, uv_low.y}, color_},
                        Vertex{corner + up, normal, tangent, uv_low, color_}});
}

void Builder::colored_patch(int material, const std::array<glm::vec3, 4>& corners,
                            const std::array<glm::vec4, 4>& colors) {
    const glm::vec3 right = unit_or(corners[1] - corners[0], unit_or(corners[2] - corners[3], {1.0f, 0.0f, 0.0f}));
    const glm::vec3 normal = glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
    const glm::vec3 up = glm::cross(normal, right);
    std::array<Vertex, 4> vertices;
    for (std::size_t i = 0; i < 4; ++i)
        vertices[i] = {corners[i], normal, right, flat_uv(material, corners[i], right, up), colors[i]};
    add_quad(material, vertices);
}

void Builder::patch(int material, const std::array<glm::vec3, 4>& corners) {
    colored_patch(material, corners, {color_, color_, color_, color_});
}

void Builder::triangle(int material, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 right = glm::normalize(b - a);
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const glm::vec3 up = glm::cross(normal, right);
    Mesh& mesh = cell_of(material, world((a + b + c) / 3.0f));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& corner : {a, b, c})
        add(mesh, material, {corner, normal, right, flat_uv(material, corner, right, up), color_});
    for (const std::uint32_t index : {0u, 1u, 2u}) mesh.indices.push_back(first + index);
}

void Builder::box(int material, const glm::vec3& low, const glm::vec3& high, unsigned sides) {
    const glm::vec3 size = high - low;
    const glm::vec3 x(size.x, 0.0f, 0.0f);
    const glm::vec3 y(0.0f, size.y, 0.0f);
    const glm::vec3 z(0.0f, 0.0f, size.z);
    if (sides & kFront) quad(material, low + z, x, y);
    if (sides & kBack) quad(material, low + x, -x, y);
    if (sides & kRight) quad(material, low + x + z, -z, y);
    if (sides & kLeft) quad(material, low, z, y);
    if (sides & kTop) quad(material, low + y + z, x, -z);
    if (sides & kBottom) quad(material, low, x, z);
}

void Builder::bar(int material, const glm::vec3& from, const glm::vec3& to, float radius_m, int slices, bool capped) {
    const glm::vec3 along = glm::normalize(to - from);
    const glm::vec3 side = glm::normalize(
        glm::cross(along, std::abs(along.y) > 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f)));
    const glm::vec3 other = glm::cross(along, side);
    std::vector<glm::vec3> lower;
    std::vector<glm::vec3> upper;
    std::vector<glm::vec3> normals;
    for (int i = 0; i <= slices; ++i) {
        const double angle = glm::two_pi<double>() * (i % slices) / slices;
        const glm::vec3 out = side * static_cast<float>(std::cos(angle)) + other * static_cast<float>(std::sin(angle));
        normals.push_back(out);
        lower.push_back(from + out * radius_m);
        upper.push_back(to + out * radius_m);
    }
    strip(material, lower, upper, normals);
    if (!capped) return;
    for (int i = 0; i < slices; ++i) {
        const auto at = static_cast<std::size_t>(i);
        triangle(material, to, upper[at], upper[at + 1]);
        triangle(material, from, lower[at + 1], lower[at]);
    }
}

void Builder::tube(int material, std::span<const glm::vec3> path, float radius_m, int slices) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) bar(material, path[i], path[i + 1], radius_m, slices, true);
}

void Builder::lathe(int material, const glm::vec3& foot, std::span<const glm::vec2> profile, int slices, bool smooth) {
    expect(slices >= 3 && profile.size() >= 2, "a lathe needs three slices and two points");
    for (std::size_t row = 0; row + 1 < profile.size(); ++row) {
        const glm::vec2 upper = profile[row];
        const glm::vec2 lower = profile[row + 1];
        const glm::vec2 slope = upper - lower;
        const glm::vec2 out = glm::normalize(glm::vec2(slope.y, -slope.x));  // right of the way up
        for (int i = 0; i < slices; ++i) {
            const auto around = [&](int at, float radius, float y) {
                const double angle = glm::two_pi<double>() * (at % slices) / slices;
                return foot + glm::vec3(radius * static_cast<float>(std::sin(angle)), y,
                                        radius * static_cast<float>(std::cos(angle)));
            };
            const auto normal = [&](float at) {
                const double angle = glm::two_pi<double>() * static_cast<double>(at) / slices;
                return glm::vec3(out.x * static_cast<float>(std::sin(angle)), out.y,
                                 out.x * static_cast<float>(std::cos(angle)));
            };
            const std::array<glm::vec3, 2> low{around(i, lower.x, lower.y), around(i + 1, lower.x, lower.y)};
            const std::array<glm::vec3, 2> high{around(i, upper.x, upper.y), around(i + 1, upper.x, upper.y)};
            if (upper.x < 1e-6f) {
                triangle(material, low[0], low[1], high[0]);
            } else if (lower.x < 1e-6f) {
                triangle(material, low[0], high[1], high[0]);
            } else {
                const auto at = static_cast<float>(i);
                const std::array<glm::vec3, 2> normals{normal(smooth ? at : at + 0.5f),
                                                       normal(smooth ? at + 1.0f : at + 0.5f)};
                strip(material, low, high, normals);
            }
        }
    }
}

void Builder::strip(int material, std::span<const glm::vec3> lower, std::span<const glm::vec3> upper,
                    std::span<const glm::vec3> normals) {
    const float side_m = mappings_[static_cast<std::size_t>(material)].side_m;
    float u = 0.0f;
    for (std::size_t i = 0; i + 1 < lower.size(); ++i) {
        const float step = 0.5f * (glm::distance(lower[i], lower[i + 1]) + glm::distance(upper[i], upper[i + 1]));
        const glm::vec3 right = unit_or(lower[i + 1] - lower[i] + upper[i + 1] - upper[i], {1.0f, 0.0f, 0.0f});
        const float next = u + step / side_m;
        const float height = glm::distance(lower[i], upper[i]) / side_m;
        add_quad(material, {Vertex{lower[i], normals[i], right, {u, height}, color_},
                            Vertex{lower[i + 1], normals[i + 1], right, {next, height}, color_},
                            Vertex{upper[i + 1], normals[i + 1], right, {next, 0.0f}, color_},
                            Vertex{upper[i], normals[i], right, {u, 0.0f}, color_}});
        u = next;
    }
}

void Builder::finish() {
    for (auto& [key, mesh] : cells_) {
        const auto& [material, x, y, z] = key;
        add_lit(fmt::format("{} {} {} {}", scene_.materials[static_cast<std::size_t>(material)].name, x, y, z),
                std::move(mesh), material);
    }
    cells_.clear();
}

int Builder::lamps_left_out(const Mesh& mesh, int material) const {
    int left_out = 0;
    std::vector<int> lights;
    if (scene_.materials[static_cast<std::size_t>(material)].model != MaterialModel::unlit)
        lights_reaching(scene_, local_box(mesh), kMostLamps, lights, left_out);
    return left_out;
}

// Halves of halves, until no half is reached by more lamps than are drawn.
void Builder::add_lit(const std::string& name, Mesh mesh, int material) {
    const Box box = local_box(mesh);
    const glm::vec3 size = box.high - box.low;
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::sort(axes, [&](int a, int b) { return size[a] > size[b]; });
    const int lost = lamps_left_out(mesh, material);
    for (const int axis : axes) {
        if (lost == 0 || size[axis] < (lost == 1 ? kShortestCutForOne : kShortestCut)) break;
        auto [low, high] = halves(mesh, axis);
        if (low.indices.empty() || high.indices.empty()) continue;
        if (std::min(lamps_left_out(low, material), lamps_left_out(high, material)) >= lost) continue;  // gains nothing
        add_lit(name, std::move(low), material);
        add_lit(name, std::move(high), material);
        return;
    }
    const int part = parts_[name]++;
    const std::string own = part == 0 ? name : fmt::format("{} part {}", name, part + 1);
    add_surface(scene_, own, add_mesh(scene_, std::move(mesh), own), material, glm::mat4(1.0f));
}

}  // namespace halfframe::content::street
