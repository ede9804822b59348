// Every measured function is within its bounds, and every bound is narrow enough to catch a wrong formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "engine/effects/anti_alias/anti_alias_reference.h"
#include "engine/effects/bloom/bloom_reference.h"
#include "engine/effects/depth_prepass/depth_prepass_reference.h"
#include "engine/effects/environment/environment_reference.h"
#include "engine/effects/sky/sky_reference.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/effects/transparent/transparent_reference.h"
#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "perf/accuracy/depth_lanes.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/measure.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

std::string title(const FunctionEntry& entry) { return entry.effect + "." + entry.function + " " + name(entry.tier); }

std::vector<FunctionEntry> entries_of(const std::string& function) {
    std::vector<FunctionEntry> found;
    for (const FunctionEntry& entry : function_list()) {
        if (entry.function == function) found.push_back(entry);
    }
    EXPECT_FALSE(found.empty()) << function;
    return found;
}

TEST(Accuracy, EveryFunctionIsWithinItsBounds) {
    std::size_t measured = 0;
    for (const FunctionEntry& entry : function_list()) {
        const FunctionAccuracy found = measure(entry);
        for (const std::string& violation : found.violations) ADD_FAILURE() << violation;
        EXPECT_GE(found.lanes, 4096u) << title(entry);
        // A gap of exactly 0 would mean that a result was compared with itself.
        EXPECT_GT(found.arithmetic[0].largest, 0.0) << title(entry);
        for (const Gap& gap : found.arithmetic) EXPECT_LE(gap.p99, gap.largest) << title(entry);
        if (entry.arithmetic == Arithmetic::half) {
            EXPECT_GT(found.arithmetic[1].largest, 2.0 * found.arithmetic[0].largest) << title(entry);
        } else {
            EXPECT_EQ(found.arithmetic[1].largest, found.arithmetic[0].largest) << title(entry);
        }
        for (const Bound& bound : {entry.method, entry.in_float, entry.half, entry.flushed}) {
            EXPECT_GT(std::string(bound.reason).size(), 5u) << title(entry);
        }
        ++measured;
    }
    EXPECT_GE(measured, 11u);  // when this was written
}

TEST(Accuracy, EveryEffectIsMeasured) {
    std::set<std::string> measured;
    for (const FunctionEntry& entry : function_list()) measured.insert(entry.effect);
    for (const EffectCard* card : all_effects()) EXPECT_TRUE(measured.contains(std::string(card->name))) << card->name;
}

TEST(Accuracy, BoundsOfHalfAreNoWiderThanTenTimesWhatIsFound) {
    for (const FunctionEntry& entry : function_list()) {
        const FunctionAccuracy found = measure(entry);
        EXPECT_GE(10.0 * found.arithmetic[1].largest, entry.half.at_most) << title(entry);
    }
}

/// `wrong` in the place of the reference is further from the shader than the bound allows.
void expect_caught(const std::string& function, const PerScalar& wrong) {
    for (FunctionEntry entry : entries_of(function)) {
        entry.reference = wrong;
        const FunctionAccuracy found = measure(entry);
        EXPECT_GT(found.method.largest, 2.0 * entry.method.at_most) << title(entry);
        ASSERT_EQ(found.violations.size(), 1u) << title(entry);
        EXPECT_NE(found.violations[0].find("method"), std::string::npos) << found.violations[0];
    }
}

reference::Vector vector_of(const Lane& in, std::size_t argument) {
    return {in(argument, 0), in(argument, 1), in(argument, 2)};
}

double product(const reference::Vector& a, const reference::Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

TEST(WrongFormula, ToneMapWithoutItsScale) {
    expect_caught("tone_map", [](const Lane& in, std::size_t s) {
        const double light = std::min(in(0, s), 8.0);
        return light / (light + 0.22);
    });
    expect_caught("inverse_tone_map",
                  [](const Lane& in, std::size_t s) { return 0.22 * in(0, s) / (1.03 - in(0, s)); });
}

TEST(WrongFormula, BloomOfEachChannelByItselfAndABlurOfAnotherWidth) {
    expect_caught("light_above_threshold",
                  [](const Lane& in, std::size_t s) { return std::max(std::min(in(0, s), 8.0) - 1.0, 0.0); });
    expect_caught("blur_weight", [](const Lane& in, std::size_t) { return reference::tap_weight(in(0), 8, 2.9); });
    expect_caught("blur_pair_at", [](const Lane& in, std::size_t) { return in(0) + 0.5; });
}

TEST(WrongFormula, EdgeShareThatReachesThePixelsBorderAndLumaOfAnotherGreen) {
    expect_caught("edge_share",
                  [](const Lane& in, std::size_t) { return std::max(0.5 - (in(0) - 0.5) / (in(0) + in(1)), 0.0); });
    expect_caught("edge_luma", [](const Lane& in, std::size_t) {
        return 0.2126 * in(0, 0) + 0.7152 * in(0, 1) + 0.0722 * in(0, 2);
    });
}

TEST(WrongFormula, PanesNearToFarOrAddedAndDepthThatIsEvenInDistance) {
    const auto panes = [](const Lane& in, std::size_t s, bool reversed) {
        std::vector<reference::BlendedLayer> layers;
        for (std::size_t i = 1; i <= 3; ++i)
            layers.push_back({.light = glm::dvec3(in(i, s)),
                              .alpha = in(4, i - 1),
                              .distance_m = reversed ? static_cast<double>(i) : 3.0 - static_cast<double>(i)});
        return reference::seen_through(layers, glm::dvec3(in(0, s))).x;
    };
    expect_caught("blended", [&](const Lane& in, std::size_t s) { return panes(in, s, true); });
    expect_caught("blended", [](const Lane& in, std::size_t s) {
        return in(0, s) + in(1, s) * in(4, 0) + in(2, s) * in(4, 1) + in(3, s) * in(4, 2);
    });
    expect_caught("depth", [](const Lane& in, std::size_t) {
        reference::DepthRange range = depth_truths()[in.number()].range;
        range.orthographic = true;
        return reference::window_depth(depth_truths()[in.number()].along_m, range);
    });
    expect_caught("depth", [](const Lane& in, std::size_t) {  // -1..1, as clip coordinates are
        const DepthTruth& lane = depth_truths()[in.number()];
        return 2.0 * reference::window_depth(lane.along_m, lane.range) - 1.0;
    });
}

TEST(WrongFormula, GradientWithoutItsCube) {
    expect_caught("sky_gradient", [](const Lane& in, std::size_t s) {
        if (in(0) < 0.0) return reference::sky_gradient(in(0), in(1, s), in(2, s), in(3, s));
        return in(0) * in(1, s) + (1.0 - in(0)) * in(2, s);
    });
}

TEST(WrongFormula, EnvironmentWithATermLeftOutOrARootForgotten) {
    expect_caught("irradiance", [](const Lane& in, std::size_t s) {
        std::array<double, 9> terms{};
        for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = in(1 + i, s);
        std::swap(terms[1], terms[2]);
        return reference::irradiance({in(0, 0), in(0, 1), in(0, 2)}, terms);
    });
    expect_caught("reflection_level", [](const Lane& in, std::size_t) { return (1.0 - in(0)) * in(1); });
    expect_caught("unpacked_rgbm", [](const Lane& in, std::size_t s) { return in(0, s) * in(0, 3) * in(1); });
    expect_caught("mixed_reflection",
                  [](const Lane& in, std::size_t s) { return in(0, s) + (in(2, s) - in(0, s)) * in(3); });
}

TEST(WrongFormula, FresnelWithAnotherPowerOrAnotherEnd) {
    expect_caught("fresnel_schlick", [](const Lane& in, std::size_t s) {
        return in(0, s) + (1.0 - in(0, s)) * std::pow(1.0 - in(1), 4.0);
    });
    expect_caught("fresnel_glossy",
                  [](const Lane& in, std::size_t s) { return reference::fresnel_schlick(in(0, s), in(2)); });
}

TEST(WrongFormula, PowerOfAnotherAlphaAndSmoothnessOffByOne) {
    expect_caught("power_from_roughness",
                  [](const Lane& in, std::size_t) { return std::clamp(2.0 / (in(0) * in(0)) - 2.0, 2.0, 2048.0); });
    expect_caught("smoothness_from_power", [](const Lane& in, std::size_t) { return std::log2(in(0)) / 10.0; });
}

TEST(WrongFormula, MaterialExtensionsWithAFactorForgotten) {
    expect_caught("dielectric_specular", [](const Lane& in, std::size_t s) { return in(0, s) * in(1, s); });
    expect_caught("albedo_beside", [](const Lane& in, std::size_t s) { return in(0, s) * (1.0 - in(1, s)); });
    expect_caught("occlusion_share", [](const Lane& in, std::size_t) { return in(0) * in(1); });
}

TEST(WrongFormula, LobeOfAnotherPower) {
    expect_caught("blinn_lobe", [](const Lane& in, std::size_t) {
        return reference::blinn_lobe(vector_of(in, 0), vector_of(in, 1), in(2) + 2.0);
    });
}

TEST(WrongFormula, LiftByTheCosineShareOfThreeTapsAndBlobWithoutItsSquare) {
    expect_caught("shadow_lift", [](const Lane& in, std::size_t s) { return in(0, s) * in(2) * in(0, 1); });
    expect_caught("lit_share", [](const Lane& in, std::size_t) { return (in(0, 0) + in(0, 1) + in(0, 2)) / 3.0; });
    expect_caught("blob_shade", [](const Lane& in, std::size_t) {
        return 1.0 - in(1) * std::max(1.0 - in(0, 0) * in(0, 0) - in(0, 1) * in(0, 1), 0.0);
    });
}

TEST(WrongFormula, FalloffWithoutItsWindowAndConeWithoutItsSmoothStep) {
    expect_caught("distance_falloff", [](const Lane& in, std::size_t) { return 1.0 / std::max(in(0), 1e-5 / in(1)); });
    expect_caught("cone_falloff",
                  [](const Lane& in, std::size_t) { return std::clamp((in(0) - in(1)) * in(2), 0.0, 1.0); });
}

TEST(WrongFormula, DirectLightWithoutEnergyNormalisation) {
    expect_caught("direct_light", [](const Lane& in, std::size_t s) {
        const reference::Vector n = vector_of(in, 3);
        const reference::Vector v = vector_of(in, 4);
        const reference::Vector l = vector_of(in, 5);
        reference::Vector h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
        const double length = std::sqrt(product(h, h));
        for (double& part : h) part /= length;
        const double highlight =
            reference::fresnel_schlick(in(1, s), product(l, h)) * reference::blinn_lobe(n, h, in(2));
        return (in(0, s) + highlight) * std::max(product(n, l), 0.0) * in(6, s);
    });
}

/// direct_light() with another power: what an area light would be if `power` were its widened one.
double light_of_power(const Lane& in, std::size_t s, double power) {
    return reference::direct_light(in(0, s), in(1, s), power, vector_of(in, 3), vector_of(in, 4), vector_of(in, 5),
                                   in(6, s));
}

TEST(WrongFormula, SphereThatIsAPointThatWidensWithDistanceOrThatGainsEnergy) {
    expect_caught("area_power", [](const Lane& in, std::size_t) { return in(0); });
    expect_caught("sphere_light", [](const Lane& in, std::size_t s) { return light_of_power(in, s, in(2)); });
    // The talk's product with a distance falloff: near spheres would be the sharp ones.
    expect_caught("sphere_light",
                  [](const Lane& in, std::size_t s) { return light_of_power(in, s, in(2) * in(7) * in(7)); });
    // Normalised by the unwidened power: the highlight gets wider and no lower.
    expect_caught("sphere_light", [](const Lane& in, std::size_t s) {
        const double widened = reference::area_power(in(2), in(7));
        return light_of_power(in, s, widened) * (in(2) + 2.0) / (widened + 2.0);
    });
}

TEST(Measure, AResultThatIsNotFiniteIsCountedAndRefused) {
    FunctionEntry entry = entries_of("fresnel_schlick").front();
    const auto sound = entry.arguments;
    entry.arguments = [sound] {
        std::vector<Argument> arguments = sound();
        arguments[0].values[1][7] = std::numeric_limits<double>::quiet_NaN();
        return arguments;
    };
    entry.reference = [](const Lane&, std::size_t) { return 0.5; };
    entry.method.at_most = 1.0;
    const FunctionAccuracy found = measure(entry);
    EXPECT_EQ(found.method.not_finite, 1u);
    EXPECT_EQ(found.method.worst_lane, 7u);
    for (const Gap& gap : found.arithmetic) EXPECT_EQ(gap.not_finite, 1u);
    EXPECT_EQ(found.violations.size(), 5u);
}

TEST(Measure, AReferenceThatIsNotFiniteIsOurMistake) {
    FunctionEntry entry = entries_of("tone_map").front();
    entry.reference = [](const Lane&, std::size_t) { return std::numeric_limits<double>::infinity(); };
    EXPECT_THROW((void)measure(entry), Mistake);
}

TEST(Measure, TwoRunsGiveTheSameFigures) {
    const FunctionEntry entry = entries_of("blinn_lobe").front();
    const FunctionAccuracy once = measure(entry);
    const FunctionAccuracy again = measure(entry);
    EXPECT_EQ(once.method.largest, again.method.largest);
    EXPECT_EQ(once.method.worst_lane, again.method.worst_lane);
    EXPECT_EQ(once.arithmetic[1].p99, again.arithmetic[1].p99);
}

TEST(Samples, StartWithTheCornersAndFillTheCube) {
    const std::vector<std::vector<double>> points = unit_cube(3);
    ASSERT_EQ(points.size(), 3u);
    ASSERT_EQ(points[0].size(), 8u + 4096u);
    std::set<std::vector<double>> corners;
    for (std::size_t i = 0; i < 8; ++i) corners.insert({points[0][i], points[1][i], points[2][i]});
    EXPECT_EQ(corners.size(), 8u);
    EXPECT_TRUE(corners.contains({1.0, 0.0, 1.0}));
    // Each of 64 cells of the cube holds about a 64th of the points: 64, and never under a half of that.
    std::vector<int> cells(64);
    for (std::size_t i = 8; i < points[0].size(); ++i) {
        std::size_t cell = 0;
        for (const std::vector<double>& values : points) {
            ASSERT_GE(values[i], 0.0);
            ASSERT_LT(values[i], 1.0);
            cell = cell * 4 + static_cast<std::size_t>(values[i] * 4.0);
        }
        ++cells[cell];
    }
    EXPECT_GE(*std::min_element(cells.begin(), cells.end()), 32);
    EXPECT_THROW((void)unit_cube(0), Mistake);
    EXPECT_THROW((void)unit_cube(11), Mistake);
}

TEST(References, SayWhatTheirSourcesSay) {
    EXPECT_NEAR(255.0 * reference::tone_curve(1.0), 214.764, 1e-3);  // 255 * 1.0275 / 1.22
    EXPECT_EQ(reference::tone_curve(8.0), 1.0);
    EXPECT_EQ(reference::tone_curve(0.0), 0.0);
    for (const double display : {0.0, 0.1, 0.5, 0.99, 1.0}) {
        EXPECT_NEAR(reference::tone_curve(reference::inverse_tone_curve(display)), display, 1e-15) << display;
    }
    for (const bool orthographic : {false, true}) {
        const reference::DepthRange range{0.5, 20.0, orthographic};
        EXPECT_EQ(reference::window_depth(0.5, range), 0.0);
        EXPECT_NEAR(reference::window_depth(20.0, range), 1.0, 1e-15);
        for (const double along_m : {0.6, 3.0, 19.0})
            EXPECT_NEAR(reference::distance_at(reference::window_depth(along_m, range), range), along_m, 1e-12);
    }
    EXPECT_NEAR(reference::window_depth(1.0, {0.5, 1e9}), 0.5, 1e-8) << "twice as far as the near plane: half of all";
    const std::vector<reference::BlendedLayer> pane{{.light = glm::dvec3(2.0), .alpha = 0.5}};
    EXPECT_NEAR(reference::shown_through(pane, glm::dvec3(0.0), reference::Held::light).x, reference::tone_curve(1.0),
                1e-15);
    EXPECT_NEAR(reference::shown_through(pane, glm::dvec3(0.0), reference::Held::root).x, reference::tone_curve(0.5),
                1e-15);
    EXPECT_NEAR(reference::shown_through(pane, glm::dvec3(0.0), reference::Held::display).x,
                0.5 * reference::tone_curve(2.0), 1e-15);
    EXPECT_EQ(reference::sky_gradient(0.0, 0.2, 0.6, 0.9), 0.6);
    EXPECT_EQ(reference::sky_gradient(1.0, 0.2, 0.6, 0.9), 0.2);
    EXPECT_EQ(reference::sky_gradient(-0.125, 0.2, 0.6, 0.9), 0.9);
    const reference::Vector up{0.0, 0.0, 1.0};
    const reference::Vector side{1.0, 0.0, 0.0};
    EXPECT_NEAR(reference::direct_light(0.5, 0.25, 6.0, up, up, up, 2.0), 2.0 * (0.5 + 0.25), 1e-15);
    EXPECT_EQ(reference::direct_light(0.5, 0.25, 6.0, up, up, side, 2.0), 0.0);
    EXPECT_EQ(reference::fresnel_schlick(0.04, 1.0), 0.04);
    EXPECT_EQ(reference::fresnel_schlick(0.04, 0.0), 1.0);
    EXPECT_EQ(reference::power_from_roughness(0.0), 2048.0);
    EXPECT_EQ(reference::power_from_roughness(1.0), 2.0);
    EXPECT_NEAR(reference::distance_falloff(1.0, 100.0), 1.0, 3e-8);  // the window: 1 - 2e-8
    EXPECT_EQ(reference::distance_falloff(10.0, 10.0), 0.0);
    EXPECT_EQ(reference::cone_falloff(0.5, 0.4, 0.6), 0.5);
}

}  // namespace
}  // namespace halfframe::accuracy
