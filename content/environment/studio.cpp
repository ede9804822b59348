// A photographer's studio: a large key box, a strip behind for the rim, a dim wall of fill. They stand where the studio
// rig (content/studio_rig.cpp) has its lights, so that reflections and shading tell of the same room.
#include <algorithm>
#include <cmath>

#include "content/environment/built_in_environments.h"

namespace halfframe::content {
namespace {

/// A soft box: a rectangle on the plane at distance 1 before `towards`.
struct SoftBox {
    glm::dvec3 towards;
    double half_width;   ///< tangent of the half angle
    double half_height;  ///< the same
    double edge;         ///< width of its soft edge, the same
    glm::dvec3 radiance;
};

glm::dvec3 light_of(const SoftBox& box, const glm::dvec3& direction) {
    const glm::dvec3 axis = glm::normalize(box.towards);
    const double depth = glm::dot(direction, axis);
    if (depth <= 0.05) return glm::dvec3(0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(right, axis);
    const double x = std::abs(glm::dot(direction, right) / depth) / box.half_width;
    const double y = std::abs(glm::dot(direction, up) / depth) / box.half_height;
    const double inside = (1.0 - glm::smoothstep(1.0 - box.edge / box.half_width, 1.0, x)) *
                          (1.0 - glm::smoothstep(1.0 - box.edge / box.half_height, 1.0, y));
    // The lamp behind the cloth: the middle is brighter than the rim.
    const double lamp = 0.65 + 0.35 * std::exp(-1.5 * (x * x + y * y));
    return box.radiance * (inside * lamp);
}

}  // namespace

glm::dvec3 studio_radiance(const glm::dvec3& direction) {
    static const SoftBox kKey{{0.45, 0.75, 0.50}, 0.62, 0.44, 0.10, {6.6, 6.35, 6.0}};
    static const SoftBox kRim{{0.55, 0.45, -0.70}, 0.13, 0.80, 0.06, {6.4, 6.0, 7.4}};
    static const SoftBox kFill{{-0.85, 0.25, 0.45}, 0.70, 0.85, 0.35, {0.55, 0.66, 0.82}};
    // Walls: darker above, lighter where they meet the table, a dark floor.
    const double height = direction.y;
    const glm::dvec3 above =
        glm::mix(glm::dvec3(0.105, 0.110, 0.120), glm::dvec3(0.022, 0.024, 0.030), glm::smoothstep(0.0, 0.75, height));
    const glm::dvec3 below =
        glm::mix(glm::dvec3(0.085, 0.086, 0.090), glm::dvec3(0.028, 0.028, 0.030), glm::smoothstep(0.0, 0.6, -height));
    const glm::dvec3 walls = glm::mix(below, above, glm::smoothstep(-0.03, 0.03, height));
    return walls + light_of(kKey, direction) + light_of(kRim, direction) + light_of(kFill, direction);
}

}  // namespace halfframe::content
