// The projection.
#include "engine/effects/environment/reflection_harmonics.h"

#include <cmath>

#include "engine/frame/cube_face.h"

namespace halfframe {

namespace {

/// Orthogonal over all directions n, not of equal norm.
std::array<double, 25> polynomials(const glm::dvec3& n) {
    const double x = n.x, y = n.y, z = n.z, xx = x * x, yy = y * y, zz = z * z;
    return {1.0,
            y,
            z,
            x,
            x * y,
            y * z,
            3.0 * zz - 1.0,
            x * z,
            xx - yy,
            y * (3.0 * xx - yy),
            x * y * z,
            y * (5.0 * zz - 1.0),
            z * (5.0 * zz - 3.0),
            x * (5.0 * zz - 1.0),
            z * (xx - yy),
            x * (xx - 3.0 * yy),
            x * y * (xx - yy),
            y * z * (3.0 * xx - yy),
            x * y * (7.0 * zz - 1.0),
            y * z * (7.0 * zz - 3.0),
            zz * (35.0 * zz - 30.0) + 3.0,
            x * z * (7.0 * zz - 3.0),
            (xx - yy) * (7.0 * zz - 1.0),
            x * z * (xx - 3.0 * yy),
            xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy)};
}

}  // namespace

ReflectionHarmonics reflection_harmonics(const std::vector<glm::vec3>& light, int side) {
    const auto centre = [side](int index) { return (2.0 * index + 1.0) / side - 1.0; };
    const auto visit = [&](auto&& one) {
        std::size_t at = 0;
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < side; ++row) {
                for (int column = 0; column < side; ++column, ++at) {
                    const glm::dvec3 toward = face_direction(face, centre(column), centre(row));
                    const double length = glm::length(toward);
                    one(toward / length, 1.0 / (length * length * length), glm::sqrt(glm::dvec3(light[at])));
                }
            }
        }
    };
    // Only what differs from the mean is projected: texels are no perfect quadrature, and the root of one light must stay itself.
    double weights = 0.0;
    glm::dvec3 mean(0.0);
    const glm::dvec3 first = glm::sqrt(glm::dvec3(light.front()));
    visit([&](const glm::dvec3&, double weight, const glm::dvec3& root) {
        weights += weight;
        mean += weight * (root - first);
    });
    mean = first + mean / weights;
    std::array<glm::dvec3, 25> sums{};
    std::array<double, 25> norms{};
    visit([&](const glm::dvec3& n, double weight, const glm::dvec3& root) {
        const std::array<double, 25> values = polynomials(n);
        for (std::size_t i = 1; i < values.size(); ++i) {
            sums[i] += (root - mean) * (weight * values[i]);
            norms[i] += weight * values[i] * values[i];
        }
    });
    for (std::size_t i = 1; i < sums.size(); ++i) sums[i] /= norms[i];
    ReflectionHarmonics result{};
    result[0] = glm::vec4(glm::vec3(mean), 0.0f);
    for (std::size_t i = 1; i < 9; ++i) result[i] = glm::vec4(glm::vec3(sums[i]), 0.0f);
    // About an axis a the best factor of Legendre's polynomial of band l is what the band has at a, and what that leaves out is
    // least where its square over 2 l + 1 is largest.
    double most = 0.0;
    visit([&](const glm::dvec3& n, double, const glm::dvec3&) {
        const std::array<double, 25> values = polynomials(n);
        glm::dvec3 third(0.0), fourth(0.0);
        for (std::size_t i = 9; i < 16; ++i) third += sums[i] * values[i];
        for (std::size_t i = 16; i < 25; ++i) fourth += sums[i] * values[i];
        const double share = glm::dot(third, third) / 7.0 + glm::dot(fourth, fourth) / 9.0;
        if (share <= most) return;
        most = share;
        result[9] = glm::vec4(glm::vec3(n), 0.0f);
        result[10] = glm::vec4(glm::vec3(third), 0.0f);
        result[11] = glm::vec4(glm::vec3(fourth), 0.0f);
    });
    return result;
}

}  // namespace halfframe
