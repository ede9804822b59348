// A grid of the triangles that are not upright, and the water of one place.
#include "engine/effects/wet_surface/surface_at.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/effects/wet_surface/wet_surface.h"
#include "engine/frame/camera_space.h"
#include "engine/frame/skinning.h"
#include "engine/frame/uv_rows.h"

namespace halfframe {

namespace {

constexpr int kMostCells = 1024;  ///< a side

/// As puddle_share() of shaders_es/puddles/puddles.glsl.
float puddle_share(float hollow, float height, float level, float up) {
    const float deep = std::clamp((hollow - (1.0f - level)) * 2.5f, 0.0f, 1.0f);
    const float cracks = std::min(level, 1.0f - height);
    return std::max(deep, cracks) * std::clamp((up - 0.906f) * 12.7f, 0.0f, 1.0f);
}

int wrapped(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(texel, 0, size - 1);
    if (wrap == Wrap::repeat) return ((texel % size) + size) % size;
    const int twice = ((texel % (2 * size)) + 2 * size) % (2 * size);
    return twice < size ? twice : 2 * size - 1 - twice;
}

/// Red and green of a texture, filtered.
glm::vec2 sampled(const Scene& scene, const Texture& texture, const glm::vec2& uv) {
    const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
    const glm::vec2 at = uv * glm::vec2(image.width, image.height) - (texture.linear ? 0.5f : 0.0f);
    const glm::vec2 first = glm::floor(at), part = texture.linear ? at - first : glm::vec2(0.0f);
    const auto texel = [&](int dx, int dy) {
        const auto x = static_cast<std::size_t>(wrapped(static_cast<int>(first.x) + dx, image.width, texture.wrap_u));
        const auto y = static_cast<std::size_t>(wrapped(static_cast<int>(first.y) + dy, image.height, texture.wrap_v));
        const std::uint8_t* rgba = &image.rgba[4 * (y * static_cast<std::size_t>(image.width) + x)];
        return glm::vec2(rgba[0], rgba[1]) / 255.0f;
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x), glm::mix(texel(0, 1), texel(1, 1), part.x), part.y);
}

/// Weights of the corners at (x, z), seen from above; nothing: outside, or the triangle is upright.
std::optional<glm::dvec3> shares_at(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double x, double z) {
    const double area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
    if (area == 0.0) return std::nullopt;
    const double of_b = ((x - a.x) * (c.z - a.z) - (c.x - a.x) * (z - a.z)) / area;
    const double of_c = ((b.x - a.x) * (z - a.z) - (x - a.x) * (b.z - a.z)) / area;
    constexpr double kEdge = -1e-9;  // a point on a shared edge lies in one of the two
    if (of_b < kEdge || of_c < kEdge || of_b + of_c > 1.0 - kEdge) return std::nullopt;
    return glm::dvec3(1.0 - of_b - of_c, of_b, of_c);
}

}  // namespace

const char* name(Footing footing) {
    constexpr std::array<const char*, 3> kNames{"dry", "wet", "puddle"};
    return kNames[static_cast<std::size_t>(footing)];
}

GroundQuery::GroundQuery(const Scene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& surface = scene.surfaces[i];
        const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
        const bool stands = surface.node < 0 && surface.skin < 0 && !surface.dynamic;
        if (stands && material.alpha_mode != AlphaMode::blend) add(static_cast<int>(i));
    }
    sort_into_cells();
}

void GroundQuery::add(int index) {
    const Surface& surface = scene_.surfaces[static_cast<std::size_t>(index)];
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(surface.mesh)];
    const Material& material = scene_.materials[static_cast<std::size_t>(surface.material)];
    const glm::mat3 normals(normal_from_local(surface.world_from_local));
    const std::vector<glm::vec2>& uv = material.water_uv.set == 1 ? mesh.uv1 : mesh.uv;
    const UvRows rows = rows_of(material.water_uv);
    const auto corner = [&](std::size_t order) {
        const std::size_t vertex = mesh.indices.empty() ? order : mesh.indices[order];
        Corner made{.position = glm::vec3(surface.world_from_local * glm::vec4(mesh.positions[vertex], 1.0f)),
                    .normal = {0.0f, 1.0f, 0.0f},
                    .uv = glm::vec2(0.0f),
                    .alpha = mesh.colors.empty() ? 1.0f : mesh.colors[vertex].a};
        if (!mesh.normals.empty()) made.normal = glm::normalize(normals * mesh.normals[vertex]);
        if (vertex < uv.size()) {
            const glm::vec2 at = uv[vertex];
            made.uv = {rows[0].x * at.x + rows[0].y * at.y + rows[1].x, rows[0].z * at.x + rows[0].w * at.y + rows[1].y};
        }
        return made;
    };
    const std::size_t count = mesh.indices.empty() ? mesh.positions.size() : mesh.indices.size();
    const auto keep = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Triangle triangle{{corner(a), corner(b), corner(c)}, index};
        const glm::vec3 one = triangle.corners[1].position - triangle.corners[0].position;
        const glm::vec3 other = triangle.corners[2].position - triangle.corners[0].position;
        if (glm::cross(one, other).y != 0.0f) triangles_.push_back(triangle);
    };
    if (mesh.primitive == Primitive::triangles) {
        for (std::size_t i = 0; i + 2 < count; i += 3) keep(i, i + 1, i + 2);
    } else if (mesh.primitive == Primitive::triangle_strip) {
        for (std::size_t i = 0; i + 2 < count; ++i) keep(i, i + 1, i + 2);
    } else if (mesh.primitive == Primitive::triangle_fan) {
        for (std::size_t i = 1; i + 1 < count; ++i) keep(0, i, i + 1);
    }
}

void GroundQuery::sort_into_cells() {
    if (triangles_.empty()) return;
    glm::vec2 high(-1e30f);
    low_ = glm::vec2(1e30f);
    for (const Triangle& triangle : triangles_) {
        for (const Corner& corner : triangle.corners) {
            low_ = glm::min(low_, glm::vec2(corner.position.x, corner.position.z));
            high = glm::max(high, glm::vec2(corner.position.x, corner.position.z));
        }
    }
    // Some two triangles a cell, were they spread evenly.
    const glm::vec2 size = glm::max(high - low_, glm::vec2(1e-6f));
    const float wished = std::sqrt(2.0f * size.x * size.y / static_cast<float>(triangles_.size()));
    cell_m_ = std::max({wished, size.x / kMostCells, size.y / kMostCells});
    columns_ = static_cast<int>(size.x / cell_m_) + 1;
    rows_ = static_cast<int>(size.y / cell_m_) + 1;
    const auto each_cell = [&](const Triangle& triangle, auto&& visit) {
        glm::vec2 first(1e30f), last(-1e30f);
        for (const Corner& corner : triangle.corners) {
            first = glm::min(first, glm::vec2(corner.position.x, corner.position.z));
            last = glm::max(last, glm::vec2(corner.position.x, corner.position.z));
        }
        const auto cell = [&](float at, float low, int most) {
            return std::clamp(static_cast<int>((at - low) / cell_m_), 0, most - 1);
        };
        for (int row = cell(first.y, low_.y, rows_); row <= cell(last.y, low_.y, rows_); ++row) {
            for (int column = cell(first.x, low_.x, columns_); column <= cell(last.x, low_.x, columns_); ++column)
                visit(static_cast<std::size_t>(row * columns_ + column));
        }
    };
    first_of_cell_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (const Triangle& triangle : triangles_)
        each_cell(triangle, [&](std::size_t cell) { ++first_of_cell_[cell + 1]; });
    for (std::size_t i = 1; i < first_of_cell_.size(); ++i) first_of_cell_[i] += first_of_cell_[i - 1];
    of_cell_.resize(first_of_cell_.back());
    std::vector<std::uint32_t> next(first_of_cell_.begin(), first_of_cell_.end() - 1);
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        each_cell(triangles_[i], [&](std::size_t cell) { of_cell_[next[cell]++] = static_cast<std::uint32_t>(i); });
}

std::optional<SurfaceAt> GroundQuery::surface_at(const glm::vec3& point) const {
    const glm::vec2 from_low = (glm::vec2(point.x, point.z) - low_) / cell_m_;
    if (triangles_.empty() || !(from_low.x >= 0.0f && from_low.y >= 0.0f)) return std::nullopt;
    if (from_low.x >= static_cast<float>(columns_) || from_low.y >= static_cast<float>(rows_)) return std::nullopt;
    const auto cell = static_cast<std::size_t>(static_cast<int>(from_low.y) * columns_ + static_cast<int>(from_low.x));
    const Triangle* nearest = nullptr;
    glm::dvec3 shares{};
    double height = -1e300;
    for (std::uint32_t i = first_of_cell_[cell]; i < first_of_cell_[cell + 1]; ++i) {
        const Triangle& triangle = triangles_[of_cell_[i]];
        const glm::dvec3 a(triangle.corners[0].position), b(triangle.corners[1].position),
            c(triangle.corners[2].position);
        const auto here = shares_at(a, b, c, static_cast<double>(point.x), static_cast<double>(point.z));
        if (!here) continue;
        const double y = here->x * a.y + here->y * b.y + here->z * c.y;
        if (y <= height || y > static_cast<double>(point.y)) continue;
        nearest = &triangle;
        shares = *here;
        height = y;
    }
    if (nearest == nullptr) return std::nullopt;
    return answer(*nearest, shares, static_cast<float>(height));
}

SurfaceAt GroundQuery::answer(const Triangle& triangle, const glm::dvec3& shares, float height_m) const {
    const Surface& surface = scene_.surfaces[static_cast<std::size_t>(triangle.surface)];
    const Material& material = scene_.materials[static_cast<std::size_t>(surface.material)];
    SurfaceAt result{.height_m = height_m, .surface = triangle.surface, .material = surface.material};
    if (!takes_water(scene_, surface)) return result;
    const glm::vec3 weights(shares);
    const auto blended = [&](auto Corner::*value) {
        return triangle.corners[0].*value * weights.x + triangle.corners[1].*value * weights.y +
               triangle.corners[2].*value * weights.z;
    };
    VertexWater water;
    const bool has_colors = !scene_.meshes[static_cast<std::size_t>(surface.mesh)].colors.empty();
    if (material.water == WaterMask::vertex_color && has_colors) water = vertex_water(blended(&Corner::alpha));
    float texel_height = 1.0f;
    if (material.water_texture) {
        const glm::vec2 texel = sampled(scene_, material.water_texture, blended(&Corner::uv));
        water.open *= texel.x;
        texel_height = texel.y;
    }
    const float level = scene_.puddles ? std::clamp(scene_.puddles->level, 0.0f, 1.0f) : 0.0f;
    result.open = water.open;
    result.puddle =
        water.open * puddle_share(water.hollow, texel_height, level, glm::normalize(blended(&Corner::normal)).y);
    result.wetness = std::min(wet_levels(scene_).diffuse * water.open + result.puddle, 1.0f);
    if (result.puddle > 0.0f) {
        const float deep = std::max(water.hollow - (1.0f - level), 0.0f);
        const float crack = 0.1f * std::min(level, 1.0f - texel_height);  // cracks are shallow beside hollows
        result.puddle_depth_m = std::max(deep, crack) * material.deepest_puddle_m;
    }
    // Half of a place under water is a puddle to a foot; a hundredth of the scale is what 8 bits of a mask still tell.
    result.footing = result.puddle >= 0.5f     ? Footing::puddle
                     : result.wetness >= 0.01f ? Footing::wet
                                               : Footing::dry;
    return result;
}

}  // namespace halfframe
