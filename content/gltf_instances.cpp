// Reads the transforms of instances.
#include "content/gltf_instances.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "content/gltf_extensions.h"

namespace halfframe::content {
namespace {

template <typename Vector>
std::vector<Vector> stream(const GltfModel& gltf, const JsonPlace& attributes, const char* name) {
    if (!attributes.has(name)) return {};
    std::vector<Vector> values = read_elements<Vector>(gltf, static_cast<int>(attributes.at(name).whole()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < Vector::length(); ++c) {
            if (!std::isfinite(values[i][c])) {
                attributes.at(name).fail(fmt::format("element {} is infinite or not a number", i));
            }
        }
    }
    return values;
}

}  // namespace

std::optional<std::vector<glm::mat4>> instances_of_node(const GltfDocument& document, const GltfModel& gltf,
                                                        std::size_t node) {
    const auto use = extension(document.root().at("nodes").at(node), "EXT_mesh_gpu_instancing");
    if (!use) return std::nullopt;
    const JsonPlace attributes = use->at("attributes");
    std::size_t count = 0;
    if (!attributes.value().members().empty()) {  // the document was checked: all have as many
        const std::string& first = *attributes.value().members().front().key;
        count = gltf.model.accessors.at(static_cast<std::size_t>(attributes.at(first).whole())).count;
    }
    if (count > kMostSurfaces) {
        use->fail(fmt::format("has {} instances, more than the {} that are read", count, kMostSurfaces));
    }
    const auto translations = stream<glm::vec3>(gltf, attributes, "TRANSLATION");
    const auto rotations = stream<glm::vec4>(gltf, attributes, "ROTATION");
    const auto scales = stream<glm::vec3>(gltf, attributes, "SCALE");
    std::vector<glm::mat4> result(count, glm::mat4(1.0f));
    for (std::size_t i = 0; i < count; ++i) {
        if (!translations.empty()) result[i] = glm::translate(result[i], translations[i]);
        if (!rotations.empty()) {
            const glm::vec4& q = rotations[i];
            if (!(glm::dot(q, q) > 0.25f)) {
                attributes.at("ROTATION").fail(fmt::format("element {} is not a unit quaternion", i));
            }
            result[i] *= glm::mat4_cast(glm::normalize(glm::quat(q.w, q.x, q.y, q.z)));
        }
        if (!scales.empty()) result[i] = glm::scale(result[i], scales[i]);
    }
    return result;
}

}  // namespace halfframe::content
