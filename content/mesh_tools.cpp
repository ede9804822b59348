// Triangle lists, normals, tangents, mirroring.
#include "content/mesh_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "engine/error.h"
#include "engine/frame/uv_rows.h"

namespace halfframe::content {
namespace {

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// `v` over its length, or `otherwise` when that length is 0 or not finite. Scaled first: |v|^2 must not leave float.
glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!is_finite(v) || largest == 0.0f) {
        return otherwise;
    }
    return glm::normalize(v / largest);
}

/// What is nearer to unit, or to orthogonal, than this is so but for the rounding of floats, which would only be
/// rounded again.
constexpr float kRoundingOfUnit = 5e-7f;

bool is_unit(const glm::vec3& v) { return std::abs(glm::dot(v, v) - 1.0f) < kRoundingOfUnit; }

/// Vertices that are looked at together, without a branch for each, so that the compiler takes several at a time.
constexpr std::size_t kBlock = 64;

/// Calls mend(start, end) for each block of the first `count` in which not all is right: most meshes are right.
template <typename IsRight, typename Mend>
void for_each_block_off(std::size_t count, IsRight&& is_right, Mend&& mend) {
    for (std::size_t start = 0; start < count; start += kBlock) {
        const std::size_t end = std::min(start + kBlock, count);
        unsigned off = 0;
        for (std::size_t i = start; i < end; ++i) off |= is_right(i) ? 0u : 1u;
        if (off != 0) mend(start, end);
    }
}

/// Any unit vector orthogonal to `normal`.
glm::vec3 some_tangent(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
    return glm::normalize(axis - normal * glm::dot(normal, axis));
}

/// Under this length [1] what is left of a unit tangent across its normal is rounding: its direction means nothing.
constexpr float kLeastAcross = 0.01f;

/// `tangent` made unit and orthogonal to `normal`.
glm::vec3 orthogonal(const glm::vec3& tangent, const glm::vec3& normal) {
    const glm::vec3 given(unit_or(tangent, glm::vec3(0.0f)));
    const glm::vec3 flat = given - normal * glm::dot(normal, given);
    return glm::length(flat) > kLeastAcross ? glm::normalize(flat) : some_tangent(normal);
}

/// Vectors of a block, component by component.
struct VectorLanes {
    std::array<float, kBlock> x, y, z;

    void set(std::size_t i, const glm::vec3& vector) {
        x[i] = vector.x;
        y[i] = vector.y;
        z[i] = vector.z;
    }
    [[nodiscard]] glm::vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }

    /// Is none zero, infinite or not a number?
    [[nodiscard]] bool have_direction() const {
        std::uint32_t off = 0;
        for (std::size_t i = 0; i < kBlock; ++i) {
            const float zero = (x[i] - x[i]) + (y[i] - y[i]) + (z[i] - z[i]);
            const float largest = std::max(std::max(std::abs(x[i]), std::abs(y[i])), std::abs(z[i]));
            off |= (largest > 0.0f) & (zero == 0.0f) ? 0u : 1u;
        }
        return off == 0;
    }

    /// unit_or() to the bit, operation by operation, of vectors that have a direction.
    void normalize() {
        for (std::size_t i = 0; i < kBlock; ++i) {
            const float largest = std::max(std::max(std::abs(x[i]), std::abs(y[i])), std::abs(z[i]));
            const float sx = x[i] / largest, sy = y[i] / largest, sz = z[i] / largest;
            const float over_length = 1.0f / std::sqrt(sx * sx + sy * sy + sz * sz);
            x[i] = sx * over_length;
            y[i] = sy * over_length;
            z[i] = sz * over_length;
        }
    }
};

/// Tangents of a block and their normals, component by component.
struct TangentLanes {
    std::array<float, kBlock> x, y, z, w;
    std::array<float, kBlock> nx, ny, nz;
    VectorLanes unit;                      ///< what the tangents become
    std::array<float, kBlock> across;      ///< length of what is left of them across the normals [1]
    std::array<std::uint32_t, kBlock> stays;
    bool are_along_axes;  ///< and of length 1, as on planes, boxes and terrain: units to the bit

    /// Lanes behind the last one are right.
    void fill(std::span<const glm::vec4> tangents, std::span<const glm::vec3> normals) {
        const std::size_t count = tangents.size();
        const float *tangent = &tangents.front().x, *normal = &normals.front().x;
        for (std::size_t i = 0; i < count; ++i) {
            x[i] = tangent[4 * i];
            y[i] = tangent[4 * i + 1];
            z[i] = tangent[4 * i + 2];
            w[i] = tangent[4 * i + 3];
        }
        for (std::size_t i = 0; i < count; ++i) {
            nx[i] = normal[3 * i];
            ny[i] = normal[3 * i + 1];
            nz[i] = normal[3 * i + 2];
        }
        for (std::size_t i = count; i < kBlock; ++i) {
            x[i] = ny[i] = w[i] = 1.0f;
            y[i] = z[i] = nx[i] = nz[i] = 0.0f;
        }
    }

    /// Are all of them unit, orthogonal to their normals and of a handedness? Finds which of them stay as they are.
    bool are_right() {
        std::uint32_t off = 0, oblique = 0;
        for (std::size_t i = 0; i < kBlock; ++i) {
            const float square = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
            const float largest = std::max(std::max(std::abs(x[i]), std::abs(y[i])), std::abs(z[i]));
            const bool is_right = (std::abs(square - 1.0f) < kRoundingOfUnit) &
                                  (std::abs(x[i] * nx[i] + y[i] * ny[i] + z[i] * nz[i]) < kRoundingOfUnit) &
                                  (std::abs(w[i]) == 1.0f);
            stays[i] = is_right ? 1u : 0u;
            off |= is_right ? 0u : 1u;
            oblique |= (largest == 1.0f) & (square == 1.0f) ? 0u : 1u;
        }
        are_along_axes = oblique == 0;
        return off == 0;
    }

    // orthogonal() to the bit, operation by operation, where its direction means something. In loops of few operations,
    // so that the processor has several of the roots and divisions under way.
    void find_units() {
        unit = {x, y, z};
        if (!are_along_axes) unit.normalize();
    }

    void find_across() {
        for (std::size_t i = 0; i < kBlock; ++i) {
            const float along = nx[i] * unit.x[i] + ny[i] * unit.y[i] + nz[i] * unit.z[i];
            const float fx = unit.x[i] - nx[i] * along, fy = unit.y[i] - ny[i] * along, fz = unit.z[i] - nz[i] * along;
            across[i] = std::sqrt(fx * fx + fy * fy + fz * fz);
            unit.x[i] = fx;
            unit.y[i] = fy;
            unit.z[i] = fz;
        }
    }

    /// False: one of those that do not stay means nothing.
    bool repair() {
        std::uint32_t off = 0;
        for (std::size_t i = 0; i < kBlock; ++i) {
            const float over_across = 1.0f / across[i];
            const float fx = unit.x[i] * over_across, fy = unit.y[i] * over_across, fz = unit.z[i] * over_across;
            const float gx = x[i], gy = y[i], gz = z[i];
            const bool is_right = stays[i] != 0;
            off |= is_right | (across[i] > kLeastAcross) ? 0u : 1u;
            x[i] = is_right ? gx : fx;
            y[i] = is_right ? gy : fy;
            z[i] = is_right ? gz : fz;
            w[i] = w[i] < 0.0f ? -1.0f : 1.0f;
        }
        return off == 0;
    }
};

/// Twice the area of the face times its normal, in double: products of large coordinates leave float.
glm::vec3 face_normal_times_area(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec3 origin(mesh.positions[a]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(mesh.positions[b]) - origin, glm::dvec3(mesh.positions[c]) - origin);
    return glm::vec3(glm::clamp(normal, -1e30, 1e30));
}

template <typename Stream>
Stream gathered(const Stream& stream, const std::vector<std::uint32_t>& indices) {
    Stream result;
    if (!stream.empty()) {
        result.reserve(indices.size());
        for (const std::uint32_t index : indices) {
            result.push_back(stream[index]);
        }
    }
    return result;
}

/// The normals of the faces of `mesh`, which has three vertices for each of them: on every one. +Y without area.
std::vector<glm::vec3> normals_of_faces(const Mesh& mesh) {
    constexpr glm::vec3 kUp(0.0f, 1.0f, 0.0f);
    std::vector<glm::vec3> result(mesh.positions.size());
    VectorLanes lanes;
    for (std::size_t start = 0; start < result.size(); start += 3 * kBlock) {
        const std::size_t count = std::min(kBlock, (result.size() - start) / 3);
        for (std::size_t i = 0; i < count; ++i) {
            const auto first = static_cast<std::uint32_t>(start + 3 * i);
            lanes.set(i, face_normal_times_area(mesh, first, first + 1, first + 2));
        }
        for (std::size_t i = count; i < kBlock; ++i) lanes.set(i, kUp);
        if (lanes.have_direction()) {
            lanes.normalize();
        } else {
            for (std::size_t i = 0; i < count; ++i) lanes.set(i, unit_or(lanes.at(i), kUp));
        }
        for (std::size_t i = 0; i < count; ++i) {
            glm::vec3* corner = &result[start + 3 * i];
            corner[0] = corner[1] = corner[2] = lanes.at(i);
        }
    }
    return result;
}

/// The morph targets of `mesh` for its faces, three vertices each. A target's normals become what it changes the faces'
/// normals by: right at weight 0 and, alone, at weight 1.
std::vector<MorphTarget> flat_targets(const Mesh& mesh, const std::vector<std::uint32_t>& list,
                                      const std::vector<glm::vec3>& normals) {
    std::vector<MorphTarget> result;
    for (const MorphTarget& target : mesh.morph_targets) {
        MorphTarget flat{
            .name = target.name, .positions = gathered(target.positions, list), .normals = {}, .tangents = {}};
        Mesh moved;
        moved.positions = mesh.positions;
        for (std::size_t i = 0; i < target.positions.size(); ++i) moved.positions[i] += target.positions[i];
        for (std::size_t i = 0; i + 2 < list.size() && !target.positions.empty(); i += 3) {
            const glm::vec3 normal =
                unit_or(face_normal_times_area(moved, list[i], list[i + 1], list[i + 2]), normals[i]);
            flat.normals.insert(flat.normals.end(), 3, normal - normals[i]);
        }
        result.push_back(std::move(flat));
    }
    return result;
}

}  // namespace

bool has_faces(Primitive primitive) {
    return primitive == Primitive::triangles || primitive == Primitive::triangle_strip ||
           primitive == Primitive::triangle_fan;
}

std::size_t drawn_vertices(const Mesh& mesh) {
    return mesh.indices.empty() ? mesh.positions.size() : mesh.indices.size();
}

std::vector<std::uint32_t> triangle_list(const Mesh& mesh) {
    expect(has_faces(mesh.primitive), "a triangle list was asked of a mesh of points or lines");
    const std::size_t count = drawn_vertices(mesh);
    std::vector<std::uint32_t> result;
    if (mesh.primitive == Primitive::triangles) {
        result = mesh.indices;
        result.resize(count / 3 * 3);
        if (mesh.indices.empty()) std::iota(result.begin(), result.end(), 0u);
        return result;
    }
    const auto index = [&](std::size_t i) {
        return mesh.indices.empty() ? static_cast<std::uint32_t>(i) : mesh.indices[i];
    };
    for (std::size_t i = 2; i < count; ++i) {
        const bool fan = mesh.primitive == Primitive::triangle_fan;
        std::uint32_t first = fan ? index(0) : index(i - 2);
        std::uint32_t second = index(i - 1);
        if (!fan && i % 2 == 1) {
            std::swap(first, second);  // every other triangle of a strip runs the other way around
        }
        result.insert(result.end(), {first, second, index(i)});
    }
    return result;
}

Mesh flat_shaded(const Mesh& mesh) {
    const std::vector<std::uint32_t> list = triangle_list(mesh);
    Mesh result;
    result.name = mesh.name;
    result.positions = gathered(mesh.positions, list);
    result.uv = gathered(mesh.uv, list);
    result.uv1 = gathered(mesh.uv1, list);
    result.colors = gathered(mesh.colors, list);
    result.joints = gathered(mesh.joints, list);
    result.weights = gathered(mesh.weights, list);
    result.normals = normals_of_faces(result);
    result.morph_targets = flat_targets(mesh, list, result.normals);
    return result;
}

std::size_t repair_normals(Mesh& mesh) {
    std::vector<bool> bad(mesh.normals.size(), false);
    std::size_t bad_count = 0;
    const auto is_right = [&](std::size_t i) { return is_unit(mesh.normals[i]); };
    for_each_block_off(mesh.normals.size(), is_right, [&](std::size_t start, std::size_t end) {
        for (std::size_t i = start; i < end; ++i) {
            if (is_right(i)) continue;
            mesh.normals[i] = unit_or(mesh.normals[i], glm::vec3(0.0f));
            bad[i] = mesh.normals[i] == glm::vec3(0.0f);
            bad_count += bad[i] ? 1 : 0;
        }
    });
    if (bad_count == 0) {
        return 0;
    }
    if (has_faces(mesh.primitive)) {
        const std::vector<std::uint32_t> list = triangle_list(mesh);
        for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
            const glm::vec3 normal = face_normal_times_area(mesh, list[i], list[i + 1], list[i + 2]);
            for (std::size_t corner = i; corner < i + 3; ++corner) {
                if (bad[list[corner]]) {
                    mesh.normals[list[corner]] += normal;
                }
            }
        }
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        if (bad[i]) {
            mesh.normals[i] = unit_or(mesh.normals[i], glm::vec3(0.0f, 1.0f, 0.0f));
        }
    }
    return bad_count;
}

void add_tangents(Mesh& mesh) { add_tangents(mesh, mesh.uv); }

void add_tangents(Mesh& mesh, const std::vector<glm::vec2>& uv) {
    expect(mesh.normals.size() == mesh.positions.size() && uv.size() == mesh.positions.size(),
           "tangents need a normal and a uv at every vertex");
    std::vector<glm::dvec3> along_u(mesh.positions.size(), glm::dvec3(0.0));
    std::vector<glm::dvec3> along_v(mesh.positions.size(), glm::dvec3(0.0));
    const std::vector<std::uint32_t> list =
        has_faces(mesh.primitive) ? triangle_list(mesh) : std::vector<std::uint32_t>();
    for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
        const glm::dvec3 origin(mesh.positions[list[i]]);
        const glm::dvec3 edge_1 = glm::dvec3(mesh.positions[list[i + 1]]) - origin;
        const glm::dvec3 edge_2 = glm::dvec3(mesh.positions[list[i + 2]]) - origin;
        const glm::dvec2 uv_1 = glm::dvec2(uv[list[i + 1]]) - glm::dvec2(uv[list[i]]);
        const glm::dvec2 uv_2 = glm::dvec2(uv[list[i + 2]]) - glm::dvec2(uv[list[i]]);
        // Dividing by the determinant would only weigh by the uv area; its sign is what matters.
        const double sign = uv_1.x * uv_2.y - uv_2.x * uv_1.y < 0.0 ? -1.0 : 1.0;
        for (std::size_t corner = i; corner < i + 3; ++corner) {
            along_u[list[corner]] += sign * (edge_1 * uv_2.y - edge_2 * uv_1.y);
            along_v[list[corner]] += sign * (edge_2 * uv_1.x - edge_1 * uv_2.x);
        }
    }
    mesh.tangents.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        const glm::dvec3 normal(mesh.normals[i]);
        const glm::dvec3 tangent = along_u[i] - normal * glm::dot(normal, along_u[i]);
        const double length = glm::length(tangent);
        const bool known = std::isfinite(length) && length > 1e-12 * glm::length(along_u[i]) && length > 0.0;
        const glm::vec3 unit = known ? glm::vec3(tangent / length) : some_tangent(mesh.normals[i]);
        const bool right_handed = glm::dot(glm::cross(normal, glm::dvec3(unit)), along_v[i]) <= 0.0;
        mesh.tangents[i] = glm::vec4(unit, right_handed ? 1.0f : -1.0f);
    }
}

std::vector<glm::vec2> mapped(const std::vector<glm::vec2>& uv, const UvMapping& mapping) {
    if (is_plain(mapping)) {
        return uv;
    }
    const UvRows rows = rows_of(mapping);
    std::vector<glm::vec2> result;
    result.reserve(uv.size());
    for (const glm::vec2& at : uv) {
        result.emplace_back(rows[0].x * at.x + rows[0].y * at.y + rows[1].x,
                            rows[0].z * at.x + rows[0].w * at.y + rows[1].y);
    }
    return result;
}

void repair_tangents(Mesh& mesh) {
    TangentLanes lanes;
    for (std::size_t start = 0; start < mesh.tangents.size(); start += kBlock) {
        const std::size_t count = std::min(kBlock, mesh.tangents.size() - start);
        const std::span<glm::vec4> tangents = std::span(mesh.tangents).subspan(start, count);
        const std::span<const glm::vec3> normals = std::span(mesh.normals).subspan(start, count);
        lanes.fill(tangents, normals);
        if (lanes.are_right()) continue;
        lanes.find_units();
        lanes.find_across();
        if (!lanes.repair()) {
            for (std::size_t i = 0; i < count; ++i) {
                if (lanes.stays[i] != 0 || lanes.across[i] > kLeastAcross) continue;
                const glm::vec3 unit = orthogonal(glm::vec3(tangents[i]), normals[i]);
                lanes.x[i] = unit.x;
                lanes.y[i] = unit.y;
                lanes.z[i] = unit.z;
            }
        }
        float* tangent = &tangents.front().x;
        for (std::size_t i = 0; i < count; ++i) {
            tangent[4 * i] = lanes.x[i];
            tangent[4 * i + 1] = lanes.y[i];
            tangent[4 * i + 2] = lanes.z[i];
            tangent[4 * i + 3] = lanes.w[i];
        }
    }
}

Mesh mirrored(const Mesh& mesh) {
    Mesh result = mesh;
    if (has_faces(mesh.primitive)) {
        result.indices = triangle_list(mesh);
        result.primitive = Primitive::triangles;
        for (std::size_t i = 0; i + 2 < result.indices.size(); i += 3) {
            std::swap(result.indices[i + 1], result.indices[i + 2]);
        }
    }
    for (glm::vec4& tangent : result.tangents) {
        tangent.w = -tangent.w;
    }
    return result;
}

}  // namespace halfframe::content
