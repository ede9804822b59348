// A cube as spherical harmonics: what it keeps and what it leaves out.
#include "engine/effects/environment/reflection_harmonics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "engine/frame/cube_face.h"

namespace halfframe::tests {
namespace {

constexpr int kSide = 16;

std::vector<glm::vec3> cube_of(const std::function<double(const glm::dvec3&)>& light) {
    std::vector<glm::vec3> texels;
    for (int i = 0; i < 6 * kSide * kSide; ++i) {
        const double u = (2.0 * (i % kSide) + 1.0) / kSide - 1.0, v = (2.0 * (i / kSide % kSide) + 1.0) / kSide - 1.0;
        texels.emplace_back(static_cast<float>(light(glm::normalize(face_direction(i / kSide / kSide, u, v)))));
    }
    return texels;
}

TEST(ReflectionHarmonics, OfOneLightItsRootStaysToTheBit) {
    const ReflectionHarmonics terms = reflection_harmonics(cube_of([](const glm::dvec3&) { return 0.3; }), kSide);
    const auto root = static_cast<float>(std::sqrt(double(0.3f)));
    EXPECT_EQ(terms[0], glm::vec4(root, root, root, 0.0f));
    for (std::size_t i = 1; i < terms.size(); ++i) EXPECT_EQ(terms[i], glm::vec4(0.0f)) << i;
}

TEST(ReflectionHarmonics, ABandStaysInItsBand) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.5, -0.7, 0.6));
    constexpr double kEven = 1.0;  // light is never negative
    for (unsigned band = 0; band <= 6; ++band) {
        const ReflectionHarmonics terms = reflection_harmonics(
            cube_of([&](const glm::dvec3& n) { return std::pow(kEven + std::legendre(band, glm::dot(n, axis)), 2.0); }), kSide);
        const auto size_of = [&](std::size_t first, std::size_t past) {
            double sum = 0.0;
            for (std::size_t i = first; i < past; ++i) sum += std::abs(double(terms[i].g) - (i == 0 ? kEven : 0.0));
            return sum;
        };
        const std::array<double, 5> sizes{size_of(0, 1), size_of(1, 4), size_of(4, 9), size_of(10, 11), size_of(11, 12)};
        for (std::size_t other = 0; other < sizes.size(); ++other) {
            if (other == band) EXPECT_GT(sizes[other], 0.5) << band;
            else EXPECT_LT(sizes[other], 0.1) << band << " in " << other;
        }
        if (band != 3 && band != 4) continue;
        const glm::dvec3 found(terms[kHarmonicsAxis]);
        EXPECT_GT(std::abs(glm::dot(found, axis)), 0.99) << band;
        EXPECT_NEAR(terms[band + 7].r, band == 4 ? 1.0 : glm::dot(found, axis) > 0.0 ? 1.0 : -1.0, 0.1);
    }
}

TEST(ReflectionHarmonics, AxesAreThoseOfTheCube) {
    const ReflectionHarmonics terms =
        reflection_harmonics(cube_of([](const glm::dvec3& n) { return std::pow(1.0 + 0.1 * n.x + 0.2 * n.y + 0.3 * n.z, 2.0); }), kSide);
    EXPECT_NEAR(terms[0].r, 1.0f, 1e-6f);
    EXPECT_NEAR(terms[1].r, 0.2f, 1e-3f);
    EXPECT_NEAR(terms[2].r, 0.3f, 1e-3f);
    EXPECT_NEAR(terms[3].r, 0.1f, 1e-3f);
}

}  // namespace
}  // namespace halfframe::tests
