// Chooses the bits of every stream, and measures what they lose.
#include "engine/frame/vertex_storage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/vertex_layout.h"

namespace halfframe {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSteps = 65535.0;

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * (180.0 / kPi);
}

double srgb_from_linear(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// What one of 65535 steps is [m], 1 along an axis without extent: every position is step 0 there.
glm::dvec3 step_of(const Box& box) {
    const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
    glm::dvec3 step;
    for (int axis = 0; axis < 3; ++axis) step[axis] = size[axis] > 1e-30 ? size[axis] / kSteps : 1.0;
    return step;
}

glm::dvec3 restored(const glm::u16vec3& stored, const Box& box) {
    return glm::dvec3(box.low) + step_of(box) * glm::dvec3(stored);
}

/// Half a step along each axis that has an extent, in the world [mm]: what no position of the box can err beyond.
double bound_mm(const Box& box, double world_scale) {
    return 0.5 * glm::length((glm::dvec3(box.high) - glm::dvec3(box.low)) / kSteps) * world_scale * 1000.0;
}

/// The range of a set as scale and offset of 65535 steps.
glm::vec4 range_of(const std::vector<glm::vec2>& uv) {
    glm::vec2 low = uv.front(), high = uv.front();
    for (const glm::vec2& at : uv) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::vec2 size = high - low;
    return {size.x > 0.0f ? size.x / 65535.0f : 1.0f, size.y > 0.0f ? size.y / 65535.0f : 1.0f, low.x, low.y};
}

/// Error of one axis in texels, or in 1024ths of a unit where nothing is read with the set.
double texels_of(const glm::dvec2& error, const glm::dvec2& texels) {
    const glm::dvec2 of{texels.x > 0.0 ? texels.x : 1024.0, texels.y > 0.0 ? texels.y : 1024.0};
    return std::max(std::abs(error.x) * of.x, std::abs(error.y) * of.y);
}

/// 16 bits where they hold the set to a quarter of a texel, else 32. Halves never win: the range is at most twice the
/// largest coordinate M, so unorm16 errs by M / 65535 at most, and a half by M / 4096 or more at M.
StreamFormat uv_format(const std::vector<glm::vec2>& uv, const glm::dvec2& texels, glm::vec4& range) {
    if (uv.empty()) return StreamFormat::absent;
    const glm::vec4 wanted = range_of(uv);
    // A scale of 1 stands for an axis along which the set is constant: no error there.
    const auto half_step = [](float scale) { return scale == 1.0f ? 0.0 : 0.5 * static_cast<double>(scale); };
    const double worst = texels_of({half_step(wanted.x), half_step(wanted.y)}, texels);
    if (!(worst <= kUvLimit_texels)) return StreamFormat::float32;
    range = wanted;
    return StreamFormat::bits16;
}

double color_error(const glm::vec4& color, double steps) {
    double worst = 0.0;
    for (int k = 0; k < 4; ++k) {
        const double exact = std::clamp(static_cast<double>(color[k]), 0.0, 1.0);
        const double stored = std::round(exact * steps) / steps;
        const double error = k == 3 ? stored - exact : srgb_from_linear(stored) - srgb_from_linear(exact);
        worst = std::max(worst, std::abs(error) * 255.0);
    }
    return worst;
}

StreamFormat color_format(const std::vector<glm::vec4>& colors) {
    if (colors.empty()) return StreamFormat::absent;
    const auto holds = [](const glm::vec4& color) { return color_error(color, 255.0) <= kColorLimit_codes; };
    return std::ranges::all_of(colors, holds) ? StreamFormat::bits8 : StreamFormat::bits16;
}

double largest_scale(const glm::mat4& matrix) {
    const glm::dmat3 upper(matrix);
    return std::max({glm::length(upper[0]), glm::length(upper[1]), glm::length(upper[2])});
}

/// Meshes that touch: those that hold the same corner, to the bit, and are drawn by the same matrix.
class Neighbours {
public:
    explicit Neighbours(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    int root(int mesh) {
        while (parent_[static_cast<std::size_t>(mesh)] != mesh) {
            int& parent = parent_[static_cast<std::size_t>(mesh)];
            parent = parent_[static_cast<std::size_t>(parent)];
            mesh = parent;
        }
        return mesh;
    }

    void join(int a, int b) { parent_[static_cast<std::size_t>(root(b))] = root(a); }

    /// Joins those of `meshes` that share corners. Hashes stand for corners: two corners of one hash only join more.
    void join_touching(const Scene& scene, std::span<const int> meshes) {
        std::size_t corners = 0;
        for (const int mesh : meshes) corners += scene.meshes[static_cast<std::size_t>(mesh)].positions.size();
        const std::size_t slots = std::bit_ceil(2 * corners + 1);
        std::vector<std::pair<std::uint64_t, int>> table(slots, {0, -1});
        for (const int mesh : meshes) {
            for (const glm::vec3& position : scene.meshes[static_cast<std::size_t>(mesh)].positions) {
                const std::uint64_t hash = hash_of(position);
                std::size_t slot = hash & (slots - 1);
                while (table[slot].second >= 0 && table[slot].first != hash) slot = (slot + 1) & (slots - 1);
                if (table[slot].second < 0) table[slot] = {hash, mesh};
                else if (table[slot].second != mesh) join(table[slot].second, mesh);
            }
        }
    }

private:
    static std::uint64_t hash_of(const glm::vec3& position) {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            hash ^= std::bit_cast<std::uint32_t>(position[axis] + 0.0f);  // -0 is 0
            hash *= 0x9e3779b97f4a7c15u;                                  // the golden ratio's bits: Fibonacci hashing
            hash ^= hash >> 29;
        }
        return hash;
    }

    std::vector<int> parent_;
};

/// By matrix, the meshes that are drawn by it.
std::vector<std::vector<int>> meshes_of_one_space(const Scene& scene) {
    const auto less = [](const glm::mat4& a, const glm::mat4& b) {
        return std::lexicographical_compare(&a[0][0], &a[0][0] + 16, &b[0][0], &b[0][0] + 16);
    };
    std::map<glm::mat4, std::vector<int>, decltype(less)> by_matrix(less);
    for (const Surface& surface : scene.surfaces) {
        if (surface.skin < 0) by_matrix[surface.world_from_local].push_back(surface.mesh);
    }
    std::vector<std::vector<int>> sets;
    for (auto& [matrix, meshes] : by_matrix) {
        std::ranges::sort(meshes);
        meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
        if (meshes.size() > 1) sets.push_back(std::move(meshes));
    }
    // Many instances of one model are the same set many times.
    std::ranges::sort(sets);
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    return sets;
}

void widen(glm::dvec2& texels, const Scene& scene, const Texture& texture, const UvMapping& mapping, int set) {
    if (!texture || mapping.set != set) return;
    const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
    // A turn mixes the axes: the larger scale stands for both.
    const double scale = std::max(std::abs(mapping.scale.x), std::abs(mapping.scale.y));
    texels = glm::max(texels, glm::dvec2(image.width, image.height) * scale);
}

glm::dvec2 texels_of_set(const Scene& scene, const Material& m, int set) {
    glm::dvec2 texels(0.0);
    widen(texels, scene, m.base_color_texture, m.base_color_uv, set);
    widen(texels, scene, m.metallic_roughness_texture, m.metallic_roughness_uv, set);
    widen(texels, scene, m.normal_texture, m.normal_uv, set);
    widen(texels, scene, m.emissive_texture, m.emissive_uv, set);
    widen(texels, scene, m.occlusion_texture, m.occlusion_uv, set);
    widen(texels, scene, m.specular_texture, m.specular_uv, set);
    widen(texels, scene, m.specular_color_texture, m.specular_color_uv, set);
    widen(texels, scene, m.specular_smoothness_texture, m.specular_smoothness_uv, set);
    widen(texels, scene, m.water_texture, m.water_uv, set);
    return texels;
}

/// Scale and largest textures of every mesh, from the surfaces that draw it.
void add_uses(const Scene& scene, std::vector<MeshStorage>& storages) {
    std::vector<double> scale(storages.size(), 0.0);
    for (const Surface& surface : scene.surfaces) {
        const auto mesh = static_cast<std::size_t>(surface.mesh);
        scale[mesh] = std::max(scale[mesh], surface.skin < 0 ? largest_scale(surface.world_from_local) : 1.0);
        const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
        storages[mesh].uv_texels = glm::max(storages[mesh].uv_texels, texels_of_set(scene, material, 0));
        storages[mesh].uv1_texels = glm::max(storages[mesh].uv1_texels, texels_of_set(scene, material, 1));
    }
    for (std::size_t i = 0; i < storages.size(); ++i) storages[i].world_scale = scale[i] > 0.0 ? scale[i] : 1.0;
}

/// What a sentence about one of `count` meshes ends with.
std::string and_others(std::size_t count) {
    return count < 2 ? "" : fmt::format("; {} more of {} keep theirs", count - 1, count);
}

/// Positions of every mesh: 16 bits of a box of its own, or of all that it touches.
void choose_positions(const Scene& scene, std::vector<MeshStorage>& storages, std::vector<std::string>& notices) {
    const std::size_t count = scene.meshes.size();
    Neighbours neighbours(count);
    for (const auto& meshes : meshes_of_one_space(scene)) neighbours.join_touching(scene, meshes);
    std::vector<Box> boxes(count);
    std::vector<double> scales(count, 0.0);
    std::vector<char> moves(count, 0);
    std::size_t kept = 0;
    double worst_kept = 0.0;
    std::string sentence;
    for (std::size_t i = 0; i < count; ++i) {
        const auto root = static_cast<std::size_t>(neighbours.root(static_cast<int>(i)));
        const Mesh& mesh = scene.meshes[i];
        const Box box = local_box(mesh);
        if (!box.empty()) {
            boxes[root].add(box.low);
            boxes[root].add(box.high);
        }
        scales[root] = std::max(scales[root], storages[i].world_scale);
        if (!mesh.joints.empty() || !mesh.morph_targets.empty()) moves[root] = 1;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const auto root = static_cast<std::size_t>(neighbours.root(static_cast<int>(i)));
        const Box& box = boxes[root];
        if (moves[root] || box.empty() || !is_finite(box.low) || !is_finite(box.high)) continue;
        const double worst = bound_mm(box, scales[root]);
        if (worst <= kPositionLimit_mm) {
            storages[i].positions = StreamFormat::bits16;
            storages[i].position_box = box;
        } else {
            ++kept;
            if (worst <= worst_kept) continue;
            worst_kept = worst;
            sentence = fmt::format(
                "mesh {} keeps 32-bit positions: 16 bits of the {:.1f} m that it and what it touches take would err by "
                "up to {:.2f} mm (limit {} mm)",
                scene.meshes[i].name, glm::length(glm::dvec3(box.high) - glm::dvec3(box.low)) * scales[root], worst,
                kPositionLimit_mm);
        }
    }
    if (kept > 0) notices.push_back(sentence + and_others(kept));
}

}  // namespace

const char* name(VertexPrecision precision) { return precision == VertexPrecision::half ? "half" : "full"; }

glm::dvec2 octahedral(const glm::dvec3& direction) {
    const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(sum > 0.0)) return {0.0, 0.0};  // no direction: any
    const glm::dvec2 at{direction.x / sum, direction.y / sum};
    if (direction.z >= 0.0) return at;
    return {(1.0 - std::abs(at.y)) * (at.x >= 0.0 ? 1.0 : -1.0), (1.0 - std::abs(at.x)) * (at.y >= 0.0 ? 1.0 : -1.0)};
}

glm::dvec3 from_octahedral(const glm::dvec2& stored) {
    glm::dvec3 n(stored, 1.0 - std::abs(stored.x) - std::abs(stored.y));
    const double fold = std::max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -fold : fold;
    n.y += n.y >= 0.0 ? -fold : fold;
    return glm::normalize(n);
}

glm::dvec2 octahedral_tangent(const glm::dvec4& tangent) {
    const glm::dvec2 at = octahedral(glm::dvec3(tangent));
    const double y = std::max(at.y * 0.5 + 0.5, 1.0 / 32767.0);  // never 0, which has no sign
    return {at.x, tangent.w < 0.0 ? -y : y};
}

glm::dvec4 tangent_from_octahedral(const glm::dvec2& stored) {
    return {from_octahedral({stored.x, std::abs(stored.y) * 2.0 - 1.0}), stored.y < 0.0 ? -1.0 : 1.0};
}

glm::i16vec2 octahedral16(const glm::dvec3& direction) {
    return glm::i16vec2(glm::round(octahedral(direction) * 32767.0));
}

glm::i16vec2 octahedral16_tangent(const glm::dvec4& tangent) {
    return glm::i16vec2(glm::round(octahedral_tangent(tangent) * 32767.0));
}

glm::u16vec3 position16(const glm::vec3& position, const Box& box) {
    const glm::dvec3 at = (glm::dvec3(position) - glm::dvec3(box.low)) / step_of(box);
    return glm::u16vec3(glm::round(glm::clamp(at, 0.0, kSteps)));
}

glm::u16vec2 uv16(const glm::vec2& uv, const glm::vec4& range) {
    const glm::dvec2 at = (glm::dvec2(uv) - glm::dvec2(range.z, range.w)) / glm::dvec2(range.x, range.y);
    return glm::u16vec2(glm::round(glm::clamp(at, 0.0, kSteps)));
}

MeshStorage full_storage(const Mesh& mesh) {
    const auto format = [](bool absent) { return absent ? StreamFormat::absent : StreamFormat::float32; };
    MeshStorage storage;
    storage.normals = format(mesh.normals.empty());
    storage.tangents = format(mesh.tangents.empty());
    storage.uv = format(mesh.uv.empty());
    storage.uv1 = format(mesh.uv1.empty());
    storage.colors = format(mesh.colors.empty());
    return storage;
}

std::vector<MeshStorage> plan_vertex_storage(const Scene& scene, VertexPrecision precision,
                                             std::vector<std::string>& notices) {
    std::vector<MeshStorage> storages;
    for (const Mesh& mesh : scene.meshes) storages.push_back(full_storage(mesh));
    add_uses(scene, storages);
    if (precision == VertexPrecision::full) return storages;
    std::size_t kept = 0;
    std::string sentence;
    for (std::size_t i = 0; i < storages.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        MeshStorage& storage = storages[i];
        if (!mesh.normals.empty()) storage.normals = StreamFormat::bits16;
        if (!mesh.tangents.empty()) storage.tangents = StreamFormat::bits16;
        storage.uv = uv_format(mesh.uv, storage.uv_texels, storage.uv_range);
        storage.uv1 = uv_format(mesh.uv1, storage.uv1_texels, storage.uv1_range);
        storage.colors = color_format(mesh.colors);
        if (storage.uv == StreamFormat::float32 || storage.uv1 == StreamFormat::float32) {
            if (++kept == 1) {
                sentence = fmt::format(
                    "mesh {} keeps 32-bit texture coordinates: 16 bits of their range would err by more than {} texels",
                    mesh.name, kUvLimit_texels);
            }
        }
    }
    if (kept > 0) notices.push_back(sentence + and_others(kept));
    choose_positions(scene, storages, notices);
    return storages;
}

StorageError storage_error(const Mesh& mesh, const MeshStorage& storage) {
    StorageError error;
    const std::size_t count = mesh.positions.size();
    const auto vertex_bytes = [](bool present, std::size_t bytes) { return present ? bytes : 0; };
    error.bytes_full = count * (12 + vertex_bytes(!mesh.normals.empty(), 12) +
                                vertex_bytes(!mesh.tangents.empty(), 16) + vertex_bytes(!mesh.uv.empty(), 8) +
                                vertex_bytes(!mesh.uv1.empty(), 8) + vertex_bytes(!mesh.colors.empty(), 16));
    error.bytes_stored = count * static_cast<std::size_t>(vertex_layout(storage).stride);
    if (storage.positions == StreamFormat::bits16) {
        std::vector<char> used(count, mesh.indices.empty() ? 1 : 0);
        for (const std::uint32_t index : mesh.indices) used[index] = 1;
        for (std::size_t i = 0; i < count; ++i) {
            if (!used[i]) continue;  // no triangle shows it
            const glm::dvec3 back = restored(position16(mesh.positions[i], storage.position_box), storage.position_box);
            const double apart = glm::distance(back, glm::dvec3(mesh.positions[i]));
            error.worst_mm = std::max(error.worst_mm, apart * storage.world_scale * 1000.0);
        }
    }
    if (storage.normals == StreamFormat::bits16) {
        for (const glm::vec3& normal : mesh.normals) {
            if (!(glm::length(normal) > 0.0f)) continue;  // no direction to lose
            const glm::dvec3 exact = glm::normalize(glm::dvec3(normal));
            const glm::dvec3 back = from_octahedral(glm::dvec2(octahedral16(exact)) / 32767.0);
            error.worst_normal_degrees = std::max(error.worst_normal_degrees, degrees_between(exact, back));
        }
    }
    if (storage.tangents == StreamFormat::bits16) {
        for (const glm::vec4& tangent : mesh.tangents) {
            if (!(glm::length(glm::vec3(tangent)) > 0.0f)) continue;
            const glm::dvec4 exact(glm::normalize(glm::dvec3(tangent)), tangent.w);
            const glm::dvec4 back = tangent_from_octahedral(glm::dvec2(octahedral16_tangent(exact)) / 32767.0);
            const bool same_hand = (back.w < 0.0) == (exact.w < 0.0);
            error.worst_tangent_degrees = std::max(
                error.worst_tangent_degrees, same_hand ? degrees_between(glm::dvec3(exact), glm::dvec3(back)) : 180.0);
        }
    }
    const auto add_uv = [&](const std::vector<glm::vec2>& uv, StreamFormat format, const glm::vec4& range,
                            const glm::dvec2& texels) {
        if (format != StreamFormat::bits16) return;
        for (const glm::vec2& at : uv) {
            const glm::dvec2 back =
                glm::dvec2(uv16(at, range)) * glm::dvec2(range.x, range.y) + glm::dvec2(range.z, range.w);
            error.worst_uv_texels = std::max(error.worst_uv_texels, texels_of(back - glm::dvec2(at), texels));
        }
    };
    add_uv(mesh.uv, storage.uv, storage.uv_range, storage.uv_texels);
    add_uv(mesh.uv1, storage.uv1, storage.uv1_range, storage.uv1_texels);
    if (storage.colors == StreamFormat::bits8 || storage.colors == StreamFormat::bits16) {
        const double steps = storage.colors == StreamFormat::bits8 ? 255.0 : kSteps;
        for (const glm::vec4& color : mesh.colors)
            error.worst_color_codes = std::max(error.worst_color_codes, color_error(color, steps));
    }
    return error;
}

StoredPositions stored_positions(const MeshStorage& storage) {
    if (storage.positions != StreamFormat::bits16) return {};
    return {glm::dvec3(storage.position_box.low), step_of(storage.position_box)};
}

glm::mat4 from_stored(const glm::mat4& from_local, const MeshStorage& storage) {
    if (storage.positions != StreamFormat::bits16) return from_local;
    const StoredPositions stored = stored_positions(storage);
    glm::dmat4 matrix(from_local);
    matrix[3] = matrix * glm::dvec4(stored.origin, 1.0);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= stored.step[axis];
    return glm::mat4(matrix);
}

glm::vec4 direction_scale(const MeshStorage& storage) {
    if (storage.positions != StreamFormat::bits16) return glm::vec4(1.0f, 1.0f, 1.0f, 0.0f);
    const glm::dvec3 step = step_of(storage.position_box);
    const double least = std::min({step.x, step.y, step.z});
    return glm::vec4(glm::vec3(least / step), 0.0f);
}

}  // namespace halfframe
