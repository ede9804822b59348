// The surface's functions where their answer is known beforehand, in every arithmetic that is modelled.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/frame/tier.h"
#include "perf/shader_ir/compile.h"
#include "perf/shader_ir/evaluate.h"

namespace halfframe::accuracy {
namespace {

using shader_ir::Columns;
using shader_ir::Model;

constexpr std::array kModels{Model::in_double, Model::in_float, Model::half, Model::half_flushed, Model::es_minimum};

shader_ir::Module surface(const char* tier, Arithmetic arithmetic) {
    return shader_ir::compile(
        shader_ir::FunctionFiles{.paths = {"surface/surface_limits.h", "common/maths.glsl", "surface/surface.glsl"},
                                 .arithmetic = arithmetic,
                                 .defines = {{tier, "1"}},
                                 .more_text = ""});
}

/// Every half from 0 to 1, subnormals left out: 15361 - 1023 numbers.
std::vector<double> every_half() {
    std::vector<double> values{0.0};
    for (int exponent = -14; exponent < 0; ++exponent) {
        for (int fraction = 0; fraction < 1024; ++fraction)
            values.push_back(std::ldexp(1.0 + fraction / 1024.0, exponent));
    }
    values.push_back(1.0);
    return values;
}

TEST(SurfaceAnswers, FresnelEndsAtItsSpecularAndAtOneToTheBit) {
    const shader_ir::Module module = surface("TIER_CONSOLE", Arithmetic::half);
    const std::vector<double> specular = every_half();
    const Columns colour{specular, specular, specular};
    for (const Model model : kModels) {
        const auto ends = [&](double cosine) {
            const std::vector<Columns> inputs{colour, {{cosine}}};
            return shader_ir::evaluate(module, "fresnel_schlick", inputs, model).returned[1];
        };
        const std::vector<double> normal = ends(1.0), grazing = ends(0.0);
        // glossy: the grazing end is the larger of smoothness and specular.
        const std::vector<Columns> smooth{colour, {{1.0}}, {{0.0}}}, rough{colour, {{0.0}}, {{0.0}}};
        const std::vector<double> mirror = shader_ir::evaluate(module, "fresnel_glossy", smooth, model).returned[1];
        const std::vector<double> matt = shader_ir::evaluate(module, "fresnel_glossy", rough, model).returned[1];
        // A sum of 1 - s and s is 1 to the bit where rounding is to nearest, ties to even; fp32 and half both do. The
        // least that ES allows has 10 bits after the leading one, as half has, but nothing says how it rounds.
        ASSERT_EQ(normal.size(), specular.size());
        for (std::size_t i = 0; i < specular.size(); ++i) {
            ASSERT_EQ(normal[i], specular[i]) << shader_ir::name(model);
            ASSERT_EQ(matt[i], specular[i]) << shader_ir::name(model);
            ASSERT_EQ(grazing[i], 1.0) << shader_ir::name(model) << " specular " << specular[i];
            ASSERT_EQ(mirror[i], 1.0) << shader_ir::name(model) << " specular " << specular[i];
        }
    }
}

/// The lobe where h is n, for 4096 directions and powers.
std::vector<double> peaks(const shader_ir::Module& module, Model model) {
    std::vector<double> x, y, z, power;
    for (int i = 0; i < 4096; ++i) {
        const double height = 2.0 * (i + 0.5) / 4096.0 - 1.0;
        const double turn_rad = i * 2.399963;  // the golden angle: no two alike
        const double radius = std::sqrt(1.0 - height * height);
        x.push_back(static_cast<float>(radius * std::cos(turn_rad)));
        y.push_back(static_cast<float>(radius * std::sin(turn_rad)));
        z.push_back(static_cast<float>(height));
        power.push_back(std::exp2(1.0 + 10.0 * (i % 64) / 63.0));
    }
    const std::vector<Columns> inputs{{x, y, z}, {x, y, z}, {power}};
    return shader_ir::evaluate(module, "blinn_lobe", inputs, model).returned[0];
}

TEST(SurfaceAnswers, TheLobePeaksAtOne) {
    for (const Model model : kModels) {
        // The chord of n and n is 0 in every arithmetic.
        for (const double peak : peaks(surface("TIER_CONSOLE", Arithmetic::half), model)) ASSERT_EQ(peak, 1.0);
        for (const double peak : peaks(surface("TIER_LOW", Arithmetic::half), model)) ASSERT_EQ(peak, 1.0);
        // 5e-4: as written, n.n of fp32 vectors is 6e-8 to 1.2e-7 from 1, which the power of 2048 multiplies.
        for (const double peak : peaks(surface("TIER_REFERENCE", Arithmetic::full), model))
            ASSERT_NEAR(peak, 1.0, 5e-4);
    }
}

/// What reaches an eye straight above, in double, from sphere lights of `ratio` in every direction together.
double energy(const shader_ir::Module& module, double power, double ratio) {
    constexpr int kSteps = 4096;
    std::vector<double> x, z;
    for (int i = 0; i < kSteps; ++i) {
        const double angle_rad = (i + 0.5) / kSteps * 0.5 * std::numbers::pi;
        x.push_back(std::sin(angle_rad));
        z.push_back(std::cos(angle_rad));
    }
    const Columns up{{0.0}, {0.0}, {1.0}}, one{{1.0}, {1.0}, {1.0}}, black{{0.0}, {0.0}, {0.0}};
    const std::vector<Columns> inputs{black, one, {{power}}, up, up, {x, {0.0}, z}, one, {{ratio}}};
    const Columns light = shader_ir::evaluate(module, "sphere_light", inputs, Model::in_double).returned;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const std::size_t at = static_cast<std::size_t>(i);
        sum += light[0][at] * x[at] * (0.5 * std::numbers::pi / kSteps) * 2.0 * std::numbers::pi;
    }
    return sum / std::numbers::pi;  // radiance 1 is an irradiance of pi
}

TEST(SurfaceAnswers, ASphereReflectsAsMuchAsAPoint) {
    const shader_ir::Module module = surface("TIER_CONSOLE", Arithmetic::full);
    for (const double power : {8.0, 32.0, 128.0, 512.0, 2048.0}) {
        const double point = energy(module, power, 0.0);
        for (const double ratio : {0.05, 0.2, 0.5, 1.0}) {
            // A widened lobe is the lobe of a rougher surface, and the model's rough lobes reflect less: 1.8 % less at
            // a ratio of 0.2, 11 % at 0.5, 33 % at 1, where the sphere fills the sky. Never more: that would be light
            // made.
            const double kept = energy(module, power, ratio) / point;
            EXPECT_LE(kept, 1.0) << power << ' ' << ratio;
            EXPECT_GE(kept, ratio < 0.3 ? 0.97 : ratio < 0.6 ? 0.87 : 0.65) << power << ' ' << ratio;
        }
    }
}

}  // namespace
}  // namespace halfframe::accuracy
