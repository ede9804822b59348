// Meshes: triangles without area, vertices that nothing names, normals that are not unit.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

#include <fmt/format.h>

#include "content/gltf_document.h"
#include "content/mesh_tools.h"
#include "perf/check/check.h"

namespace halfframe::check {
namespace {

/// Height of a triangle over its longest side, below which it has no area that float arithmetic can hold: 16 times the
/// 2^-24 that one rounding errs.
constexpr float kFlattest = 1e-6f;

bool is_degenerate(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const float longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return !(glm::length(glm::cross(b - a, c - a)) > kFlattest * longest * longest);
}

MeshFigures figures_of(const Mesh& mesh) {
    MeshFigures figures;
    figures.name = mesh.name;
    figures.vertices = mesh.positions.size();
    std::vector<bool> named(mesh.positions.size(), mesh.indices.empty());
    for (const std::uint32_t index : mesh.indices) named[index] = true;
    figures.unused_vertices = static_cast<std::size_t>(std::count(named.begin(), named.end(), false));
    if (!content::has_faces(mesh.primitive)) return figures;
    const std::vector<std::uint32_t> corners = content::triangle_list(mesh);
    figures.triangles = corners.size() / 3;
    // Strips and fans are stitched together with triangles without area: there they are meant.
    for (std::size_t i = 0; mesh.primitive == Primitive::triangles && i + 2 < corners.size(); i += 3) {
        const auto at = [&](std::size_t corner) { return mesh.positions[corners[i + corner]]; };
        figures.degenerate += is_degenerate(at(0), at(1), at(2)) ? 1u : 0u;
    }
    return figures;
}

/// The normals of one accessor, or nothing where they do not lie plainly in a buffer.
std::vector<glm::vec3> normals_of(const content::JsonPlace& root, const content::GltfResources& resources,
                                  std::size_t accessor_index) {
    std::vector<glm::vec3> normals;
    const content::JsonPlace accessor = root.at("accessors").at(accessor_index);
    if (!accessor.has("bufferView") || accessor.has("sparse")) return normals;
    const content::JsonPlace view =
        root.at("bufferViews").at(static_cast<std::size_t>(accessor.at("bufferView").whole()));
    if (view.has("extensions")) return normals;  // compressed
    const auto type = accessor.at("componentType").whole();
    const auto number = [](const content::JsonPlace& place, const char* key) {
        return place.has(key) ? static_cast<std::size_t>(place.at(key).whole()) : std::size_t{0};
    };
    const auto size = static_cast<std::size_t>(content::component_bytes(type));
    const std::size_t stride = view.has("byteStride") ? number(view, "byteStride") : 3 * size;
    const std::size_t start = number(view, "byteOffset") + number(accessor, "byteOffset");
    const content::GltfBuffer& buffer = resources.buffers[number(view, "buffer")];
    const std::string_view bytes = buffer.part(0, buffer.size());
    for (std::size_t i = 0; i < number(accessor, "count"); ++i) {
        glm::vec3 normal(0.0f);
        for (int k = 0; k < 3; ++k) {
            const std::size_t at = start + i * stride + static_cast<std::size_t>(k) * size;
            if (at + size > bytes.size()) return {};
            if (type == 5126) {
                std::memcpy(&normal[k], &bytes[at], sizeof(float));
            } else if (type == 5122) {
                std::int16_t value = 0;
                std::memcpy(&value, &bytes[at], sizeof value);
                normal[k] = std::max(static_cast<float>(value) / 32767.0f, -1.0f);
            } else if (type == 5120) {
                normal[k] = std::max(static_cast<float>(static_cast<signed char>(bytes[at])) / 127.0f, -1.0f);
            }
        }
        normals.push_back(normal);
    }
    return normals;
}

struct LengthError {
    std::size_t off = 0;
    std::size_t none = 0;  ///< of these: zero or not finite
    float worst = 0.0f;
};
LengthError length_error(const std::vector<glm::vec3>& normals, double allowed) {
    LengthError error;
    for (const glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        const float off = std::abs(length - 1.0f);
        if (off <= static_cast<float>(allowed)) continue;
        ++error.off;
        if (!(length > 1e-6f) || !std::isfinite(length)) {
            ++error.none;
        } else {
            error.worst = std::max(error.worst, off);
        }
    }
    return error;
}

Finding normals_finding(const LengthError& error, std::size_t count, const std::string& place,
                        const std::string& thing) {
    return {.rule = RuleId::mesh_normals,
            .level = error.none > 0 ? Level::error : Level::warning,
            .place = place,
            .thing = thing,
            .words = fmt::format("{} of {} are not unit (worst by {:.3g}), {} of them zero or no number", error.off,
                                 count, error.worst, error.none)};
}

}  // namespace

void check_meshes(const Scene& scene, const Request& request, const Places& places, Report& report) {
    std::set<int> used;
    for (const Surface& surface : scene.surfaces) used.insert(surface.mesh);
    for (const int index : used) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(index)];
        MeshFigures figures = figures_of(mesh);
        figures.place = places.mesh(index);
        const std::string thing = fmt::format("mesh '{}'", mesh.name);
        const auto add = [&](RuleId rule, std::size_t count, std::size_t of, double share, const char* what) {
            if (count == 0 || static_cast<double>(count) <= share * static_cast<double>(of)) return;
            report.findings.push_back(
                {rule, Level::warning, figures.place, thing, fmt::format("{} of {} {}", count, of, what)});
        };
        add(RuleId::mesh_degenerate, figures.degenerate, figures.triangles, request.thresholds.degenerate_share,
            "triangles have no area");
        add(RuleId::mesh_unused_vertices, figures.unused_vertices, figures.vertices,
            request.thresholds.unused_vertex_share, "vertices are named by no index");
        if (request.file.empty()) {  // of a file the loader has repaired them: check_file_normals() reads it again
            const LengthError error = length_error(mesh.normals, request.thresholds.vertex_normal_length);
            if (error.off > 0) {
                report.findings.push_back(normals_finding(error, mesh.normals.size(), figures.place, thing));
            }
        }
        report.meshes.push_back(std::move(figures));
    }
}

void check_file_normals(const Request& request, Report& report) {
    content::GltfDocument document = content::read_gltf_document(request.file);
    content::check_gltf(document);
    const content::GltfResources resources = content::read_gltf_resources(document);
    const content::JsonPlace root = document.root();
    std::set<std::size_t> seen;
    content::for_each_object(root, "meshes", [&](const content::JsonPlace& mesh, std::size_t at) {
        content::for_each_object(mesh, "primitives", [&](const content::JsonPlace& primitive, std::size_t part) {
            const auto normal = primitive.at("attributes").find("NORMAL");
            if (!normal) return;
            const auto accessor = static_cast<std::size_t>(normal->whole());
            if (!seen.insert(accessor).second) return;
            const std::vector<glm::vec3> normals = normals_of(root, resources, accessor);
            const LengthError error = length_error(normals, request.thresholds.vertex_normal_length);
            if (error.off > 0) {
                report.findings.push_back(normals_finding(
                    error, normals.size(), fmt::format("/meshes/{}/primitives/{}/attributes/NORMAL", at, part),
                    fmt::format("accessor {}", accessor)));
            }
        });
    });
}

}  // namespace halfframe::check
