// Models against what they stand for: within their bounds, bounds that catch a wrong model, and truths that are true.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "engine/effects/environment/environment_reference.h"
#include "engine/effects/surface/surface_model_reference.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/error.h"
#include "perf/accuracy/error_map.h"
#include "perf/accuracy/model_list.h"

namespace halfframe::accuracy {
namespace {

using reference::Cosines;

TEST(Models, EveryModelIsWithinItsBounds) {
    std::size_t measured = 0;
    for (const ModelEntry& entry : model_list()) {
        const ModelAccuracy found = measure(entry);
        for (const std::string& violation : found.violations) ADD_FAILURE() << violation;
        EXPECT_GE(found.errors.size(), 500u) << entry.model;
        EXPECT_GT(found.mean, 0.0) << entry.model << ": a model without an error was compared with itself";
        // Nothing random is in these figures, so a bound can be near what it bounds.
        EXPECT_LT(entry.mean.at_most, 1.25 * found.mean) << entry.model;
        EXPECT_GT(std::string(entry.largest.reason).size(), 20u) << entry.model;
        EXPECT_GT(std::string(entry.mean.reason).size(), 20u) << entry.model;
        ++measured;
    }
    EXPECT_GE(measured, 7u);  // when this was written
}

TEST(Models, ALobeOfAnotherWidthIsCaught) {
    const PowerOfRoughness wrong[] = {
        [](double roughness) { return std::clamp(2.0 / (roughness * roughness) - 2.0, 2.0, 2048.0); },
        [](double roughness) { return std::exp2(10.0 * (1.0 - roughness) + 1.0); },
        [](double roughness) { return std::clamp(4.0 * reference::power_from_roughness(roughness), 2.0, 2048.0); },
        [](double roughness) { return std::clamp(0.25 * reference::power_from_roughness(roughness), 2.0, 2048.0); },
    };
    for (const PowerOfRoughness power : wrong) {
        const ModelAccuracy found = measure(radiance_of_mapping(power));
        EXPECT_FALSE(found.violations.empty()) << found.mean;
    }
}

TEST(Models, AnotherGlossyFresnelIsCaught) {
    const GlossyFresnel schlick = [](double specular, double, double n_v) {
        return reference::fresnel_schlick(specular, n_v);
    };
    const GlossyFresnel none = [](double specular, double, double) { return specular; };
    EXPECT_FALSE(measure(glossy_fresnel_of_split_sum(schlick)).violations.empty());
    EXPECT_FALSE(measure(glossy_fresnel_of_split_sum(none)).violations.empty());
    EXPECT_FALSE(measure(furnace_of_ambient(schlick)).violations.empty());
}

TEST(Models, AnotherReflectionOfTheEnvironmentIsCaught) {
    const GlossyFresnel none = [](double specular, double, double) { return specular; };
    const GlossyFresnel of_the_smooth = [](double specular, double, double n_v) {
        return reference::fresnel_glossy(specular, 0.5, n_v);  // forgets the smoothness
    };
    for (const GlossyFresnel wrong : {none, of_the_smooth}) {
        const ModelAccuracy found = measure(reflection_of_integral(wrong));
        EXPECT_FALSE(found.violations.empty()) << found.mean << " " << found.lowest << " " << found.highest;
    }
    const LevelOfSmoothness unbent = [](double smoothness, double roughest) { return (1.0 - smoothness) * roughest; };
    const LevelOfSmoothness nearest = [](double smoothness, double roughest) {
        return std::round((1.0 - smoothness) * roughest);
    };
    const LevelOfSmoothness too_sharp = [](double smoothness, double roughest) {
        return 0.9 * (1.0 - smoothness) * roughest;
    };
    const LevelOfSmoothness to_a_quarter = [](double smoothness, double roughest) {
        return std::round(4.0 * reference::reflection_level(smoothness, roughest)) / 4.0;
    };
    for (const LevelOfSmoothness wrong : {unbent, nearest, too_sharp}) {
        const ModelAccuracy found = measure(reflection_between_levels(wrong));
        EXPECT_FALSE(found.violations.empty()) << found.mean << " " << found.lowest << " " << found.highest;
    }
    for (const LevelOfSmoothness wrong : {nearest, too_sharp, to_a_quarter}) {
        const ModelAccuracy found = measure(reflection_of_constant_smoothness(wrong));
        EXPECT_FALSE(found.violations.empty()) << found.mean << " " << found.lowest << " " << found.highest;
    }
}

TEST(Models, AnotherReflectionByVertexIsCaught) {
    using reference::RoughTerms;
    using Toward = std::array<double, 3>;
    const RoughReflection of_two_bands = [](const Toward& toward, const RoughTerms& terms) {
        return reference::rough_reflection(toward, {.nine = terms.nine});
    };
    const RoughReflection of_three_bands = [](const Toward& toward, const RoughTerms& terms) {
        return reference::rough_reflection(toward, {.nine = terms.nine, .axis = terms.axis, .third = terms.third});
    };
    const RoughReflection turned = [](const Toward& toward, const RoughTerms& terms) {
        return reference::rough_reflection({-toward[0], -toward[1], -toward[2]}, terms);
    };
    const RoughReflection not_squared = [](const Toward& toward, const RoughTerms& terms) {
        return std::sqrt(reference::rough_reflection(toward, terms));
    };
    for (const RoughReflection wrong : {of_two_bands, of_three_bands, turned, not_squared}) {
        for (const ModelEntry& entry : {reflection_by_vertex(wrong), reflection_by_vertex_of_harsh_lamp(wrong)}) {
            const ModelAccuracy found = measure(entry);
            EXPECT_FALSE(found.violations.empty()) << found.mean << " " << found.lowest << " " << found.highest;
        }
    }
}

TEST(Models, AnotherWayOfGettingWetIsCaught) {
    using reference::DryMaterial;
    using reference::WetMaterial;
    const WetFormula dry = [](const DryMaterial& material, double) { return material; };
    const WetFormula old_way = [](const DryMaterial& material, double wetness) {  // darkens all alike
        WetMaterial wet = material;
        for (double& channel : wet.albedo) channel *= 1.0 - 0.7 * wetness;
        wet.smoothness = std::min(material.smoothness * (1.0 + 1.5 * wetness), 1.0);
        return wet;
    };
    for (const WetFormula wrong : {dry, old_way}) {
        EXPECT_FALSE(measure(diffuse_light_of_film(wrong)).violations.empty());
        EXPECT_FALSE(measure(radiance_of_film(wrong)).violations.empty());
    }
    EXPECT_FALSE(measure(mirrored_light_of_film(dry)).violations.empty());
}

TEST(Models, PanesInAnotherOrderAndAnotherBlendAreCaught) {
    const PaneOrder by_near_edge = [](const Pane& pane) {
        return pane.centre_m - pane.half_width_m * std::sin(pane.turned_rad);
    };
    const PaneOrder near_to_far = [](const Pane& pane) { return -pane.centre_m; };
    for (const PaneOrder wrong : {by_near_edge, near_to_far})
        EXPECT_FALSE(measure(order_of_panes(wrong)).violations.empty());
    // What blends display values is outside the bounds of what blends roots.
    ModelEntry swapped = blended_as(reference::Held::root);
    swapped.errors = blended_as(reference::Held::display).errors;
    EXPECT_EQ(measure(swapped).violations.size(), 2u);
}

TEST(Models, TheTwoFurnacesThatLoseNothing) {
    // Albedo 1 and specular 0 at smoothness 0; albedo 0 and specular 1 at any: both give all back from any angle.
    int places = 0;
    for (const ModelError& place : measure(furnace_of_ambient(&reference::fresnel_glossy)).errors) {
        const double smoothness = place.at[1], specular = place.at[2];
        if ((specular == 0.0 && smoothness == 0.0) || specular == 1.0) {
            EXPECT_NEAR(place.error, 0.0, 1e-15) << specular;
            ++places;
        }
    }
    EXPECT_EQ(places, 20 + 21 * 20);  // cosines; smoothnesses times cosines
}

/// A sum over an even grid of light directions; shares no sampling with the split sums.
template <typename Brdf>
double reflectance(double n_v, Brdf brdf) {
    constexpr int kHeights = 1024, kTurns = 256;
    const double sine = std::sqrt(1.0 - n_v * n_v);
    double sum = 0.0;
    for (int i = 0; i < kHeights; ++i) {
        const double n_l = (i + 0.5) / kHeights;
        for (int j = 0; j < kTurns; ++j) {
            const double l_v =
                n_l * n_v + std::sqrt(1.0 - n_l * n_l) * sine * std::cos((j + 0.5) / kTurns * std::numbers::pi);
            const double l_h = std::sqrt(0.5 * (1.0 + l_v));
            sum += brdf(Cosines{n_l, n_v, std::min((n_l + n_v) / (2.0 * l_h), 1.0), l_h}) * n_l;
        }
    }
    return sum * 2.0 * std::numbers::pi / (kHeights * kTurns);
}

TEST(ModelTruths, SplitSumsAreTheIntegralsOfTheirBrdfs) {
    for (const double n_v : {0.2, 0.7, 1.0}) {
        for (const double roughness : {0.4, 0.7, 1.0}) {
            for (const double metallic : {0.0, 1.0}) {
                const std::string where = "n.v " + std::to_string(n_v) + " roughness " + std::to_string(roughness);
                const double gltf = reflectance(
                    n_v, [&](const Cosines& at) { return reference::gltf_brdf(0.8, metallic, roughness, at); });
                // 3e-3: the split sum's 256 heights where the horizon cuts them, and this grid's at a roughness of 0.4
                EXPECT_NEAR(
                    reference::gltf_reflectance(0.8, metallic, reference::split_sum_ggx(roughness * roughness, n_v),
                                                reference::split_sum_lambert(n_v)),
                    gltf, 3e-3)
                    << where;
                EXPECT_LE(gltf, 1.0) << where;
                const double power = reference::power_from_roughness(roughness);
                const double talk =
                    reflectance(n_v, [&](const Cosines& at) { return reference::talk_brdf(0.3, 0.6, power, at); });
                EXPECT_NEAR(0.3 + reference::split_sum_blinn(power, n_v).of(0.6), talk, 3e-3) << where;
            }
        }
    }
}

TEST(ModelTruths, ReflectedLightOfAWhiteSkyIsTheSplitSum) {
    const auto white = [](const std::array<double, 3>&) { return 1.0; };
    for (const double n_v : {0.2, 0.6, 1.0}) {
        const std::array<double, 3> to_eye{std::sqrt(1.0 - n_v * n_v), 0.0, n_v};
        for (const double alpha : {0.1, 0.5, 1.0}) {
            for (const double specular : {0.04, 1.0}) {
                // 2e-3: the horizon cuts a grid of 256 x 256 half vectors and one of 256 x 64 at other places
                EXPECT_NEAR(reference::reflected_light_ggx(white, to_eye, specular, alpha * alpha, 256),
                            reference::split_sum_ggx(alpha, n_v).of(specular), 2e-3)
                    << n_v << " " << alpha;
            }
        }
    }
}

TEST(ModelTruths, KnownEnds) {
    for (const double n_v : {0.05, 0.5, 1.0}) {
        const reference::SplitSum mirror = reference::split_sum_ggx(0.0, n_v);
        EXPECT_NEAR(mirror.of(1.0), 1.0, 1e-12) << "a smooth mirror loses nothing";
        EXPECT_NEAR(mirror.of(0.04), reference::fresnel_schlick(0.04, n_v), 1e-12) << "and shows Schlick's Fresnel";
        // With V = 1 a mirror sends n.l l.h / n.h = n.v^2 back. 2e-3: the lobe of the power of 2^20 is not yet a point.
        EXPECT_NEAR(reference::split_sum_blinn(1048576.0, n_v).of(1.0), n_v * n_v, 2e-3);
    }
    // Light and view change places: both models are reciprocal.
    const Cosines there{0.3, 0.8, 0.9, 0.7}, back{0.8, 0.3, 0.9, 0.7};
    EXPECT_DOUBLE_EQ(reference::gltf_brdf(0.5, 0.3, 0.4, there), reference::gltf_brdf(0.5, 0.3, 0.4, back));
    EXPECT_DOUBLE_EQ(reference::talk_brdf(0.5, 0.3, 40.0, there), reference::talk_brdf(0.5, 0.3, 40.0, back));
    // The peak of GGX is 1 / (pi alpha^2), and V there 1 / 4; specular is the base of a metal.
    EXPECT_NEAR(reference::gltf_brdf(0.5, 1.0, 0.5, {1.0, 1.0, 1.0, 1.0}), 0.5 / (4.0 * std::numbers::pi * 0.0625),
                1e-12);
}

TEST(ErrorMap, IsRedWhereTooBrightAndHasTheSmallestValueLowerLeft) {
    ModelEntry entry = furnace_of_direct_light();
    entry.errors = [] {
        return std::vector<ModelError>{{{0.0, 0.0, 0.0}, 0.5},
                                       {{1.0, 0.0, 0.0}, 0.0},
                                       {{0.0, 1.0, 0.0}, -0.25},
                                       {{1.0, 1.0, 0.0}, 0.2},
                                       {{1.0, 1.0, 1.0}, -0.2}};
    };
    const ModelAccuracy model = measure(entry);
    std::filesystem::path font;
    try {
        font = perf::find_font();
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
    const perf::Lettering lettering(font, 16);
    const std::vector<ModelAccuracy> models(5, model);
    const Picture picture = error_maps(models, lettering);
    for (const std::size_t map : {0u, 4u}) {
        const MapPlace place = map_place(map, lettering.height());
        const auto colour = [&](int right, int up) {  // halves of the map
            const int x = place.x + (2 * right + 1) * place.width / 4;
            const int y = place.y + (3 - 2 * up) * place.height / 4;
            const std::size_t at = static_cast<std::size_t>(y * picture.width + x) * 4;
            return std::array<int, 3>{picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
        };
        EXPECT_EQ(colour(0, 0), (std::array<int, 3>{255, 0, 0}));
        EXPECT_EQ(colour(1, 0), (std::array<int, 3>{255, 255, 255}));
        EXPECT_EQ(colour(0, 1), (std::array<int, 3>{128, 128, 255}));
        EXPECT_EQ(colour(1, 1), (std::array<int, 3>{255, 255, 255})) << "the mean of what lies over one place";
        // Something is written above and below, and nothing outside.
        const auto dark = [&](int top, int bottom) {
            int count = 0;
            for (int y = top; y < bottom; ++y) {
                for (int x = place.x; x < place.x + place.width; ++x)
                    count += picture.rgba[static_cast<std::size_t>(y * picture.width + x) * 4] < 100 ? 1 : 0;
            }
            return count;
        };
        EXPECT_GT(dark(place.y - 32, place.y - 1), 100);
        EXPECT_GT(dark(place.y + place.height + 1, place.y + place.height + 32), 100);
    }
}

}  // namespace
}  // namespace halfframe::accuracy
