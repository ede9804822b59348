// The models of the surface: metallic-roughness mapped to the talk's parameters, white furnaces, the glossy Fresnel.
#include <cmath>
#include <numbers>

#include "engine/effects/surface/surface_model_reference.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/effects/tone_map/tone_map_reference.h"
#include "perf/accuracy/model_list.h"

namespace halfframe::accuracy {
namespace {

using reference::Cosines;
using reference::SplitSum;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kBase = 0.8;  // of the material that is mapped: bright plaster, or a bright metal

/// `count` numbers evenly from `first` to `last`, both among them.
std::vector<double> steps(double first, double last, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(first + (last - first) * i / (count - 1));
    return values;
}

double power_of_smoothness(double smoothness) { return std::exp2(10.0 * smoothness + 1.0); }

std::vector<ModelError> reflectance_errors(PowerOfRoughness power_of) {
    std::vector<ModelError> errors;
    for (const double view_deg : {0.0, 30.0, 60.0, 80.0}) {
        const double n_v = std::cos(view_deg * kDegree);
        const SplitSum lambert = reference::split_sum_lambert(n_v);
        for (const double roughness : steps(0.0, 1.0, 21)) {
            const SplitSum ggx = reference::split_sum_ggx(roughness * roughness, n_v);
            const SplitSum blinn = reference::split_sum_blinn(power_of(roughness), n_v);
            for (const double metallic : steps(0.0, 1.0, 11)) {
                const double mapped =
                    reference::mapped_albedo(kBase, metallic) + blinn.of(reference::mapped_specular(kBase, metallic));
                const double truth = reference::gltf_reflectance(kBase, metallic, ggx, lambert);
                errors.push_back({{metallic, roughness, view_deg}, mapped - truth});
            }
        }
    }
    return errors;
}

/// Cosines of a light at `light_deg` from the normal, `turn_deg` around it from the view's side.
Cosines cosines(double view_deg, double light_deg, double turn_deg) {
    const double n_v = std::cos(view_deg * kDegree), n_l = std::cos(light_deg * kDegree);
    const double l_v =
        n_v * n_l + std::sin(view_deg * kDegree) * std::sin(light_deg * kDegree) * std::cos(turn_deg * kDegree);
    const double l_h = std::sqrt(std::fmax(0.5 * (1.0 + l_v), 0.0));
    return {n_l, n_v, std::fmin((n_l + n_v) / (2.0 * l_h), 1.0), std::fmin(l_h, 1.0)};
}

std::vector<ModelError> radiance_errors(PowerOfRoughness power_of) {
    std::vector<ModelError> errors;
    for (const double metallic : steps(0.0, 1.0, 11)) {
        for (const double roughness : steps(0.05, 1.0, 20)) {
            const double albedo = reference::mapped_albedo(kBase, metallic);
            const double specular = reference::mapped_specular(kBase, metallic);
            for (const double view_deg : {0.0, 45.0, 75.0}) {
                for (const double light_deg : steps(0.0, 85.0, 18)) {
                    for (const double turn_deg : {0.0, 90.0, 180.0}) {
                        const Cosines at = cosines(view_deg, light_deg, turn_deg);
                        const double mapped = reference::talk_brdf(albedo, specular, power_of(roughness), at);
                        const double truth = reference::gltf_brdf(kBase, metallic, roughness, at);
                        const double irradiance = std::numbers::pi * at.n_l;  // of a sun of colour 1
                        errors.push_back({{metallic, roughness, view_deg, light_deg, turn_deg},
                                          255.0 * (reference::tone_curve(mapped * irradiance) -
                                                   reference::tone_curve(truth * irradiance))});
                    }
                }
            }
        }
    }
    return errors;
}

/// 0.05 to 1: a surface seen edge on covers no pixel.
std::vector<double> view_cosines() { return steps(0.05, 1.0, 20); }

}  // namespace

ModelEntry reflectance_of_mapping(PowerOfRoughness power) {
    return {
        .effect = "surface",
        .model = "mapped material, reflectance",
        .truth = "glTF 2.0 appendix B (GGX), white light from everywhere, base 0.8",
        .unit = "absolute",
        .axes = {"metallic", "roughness", "view [deg]"},
        .errors = [power] { return reflectance_errors(power); },
        .largest = {0.9,
                    "a mirror at 80 degrees: nothing hides in the lobe and nothing divides by n.v, so cos^2 comes "
                    "back: -0.85"},
        .mean = {0.17,
                 "mostly that, and half metals, whose diffuse part does not give up what they reflect: up to +0.21"}};
}

ModelEntry radiance_of_mapping(PowerOfRoughness power) {
    return {
        .effect = "surface",
        .model = "mapped material, radiance",
        .truth = "glTF 2.0 appendix B (GGX), a sun of colour 1, base 0.8, roughness from 0.05",
        .unit = "codes",
        .axes = {"metallic", "roughness", "view [deg]", "light [deg]", "turn [deg]"},
        .errors = [power] { return radiance_errors(power); },
        .largest = {250.0,
                    "a metal's flank at 75 degrees: GGX has a tail and brightens towards the horizon, Blinn has "
                    "neither: -245"},
        .mean = {18.9,
                 "18.6 codes, of which dielectrics have 4 and metals 37; another width of the lobe has 19.1 or more"}};
}

ModelEntry furnace_of_ambient(GlossyFresnel fresnel) {
    return {
        .effect = "surface",
        .model = "white furnace, ambient",
        .truth = "1: the albedo is 1 less the specular, so nothing is lost",
        .unit = "absolute",
        .axes = {"n.v", "smoothness", "specular"},
        .errors =
            [fresnel] {
                std::vector<ModelError> errors;
                for (const double specular : steps(0.0, 1.0, 11)) {
                    for (const double smoothness : steps(0.0, 1.0, 21)) {
                        for (const double n_v : view_cosines()) {
                            const double returned = (1.0 - specular) + fresnel(specular, smoothness, n_v);
                            errors.push_back({{n_v, smoothness, specular}, returned - 1.0});
                        }
                    }
                }
                return errors;
            },
        .largest =
            {0.78,
             "a smooth surface with a specular of 0 seen edge on: the albedo keeps what the rim gains: (1 - n.v)^5"},
        .mean = {0.03, "the same rim, the fifth power of 1 - n.v wide"}};
}

ModelEntry furnace_of_direct_light() {
    return {.effect = "surface",
            .model = "white furnace, direct light",
            .truth = "1: the albedo is 1 less the specular, so nothing is lost",
            .unit = "absolute",
            .axes = {"n.v", "smoothness", "specular"},
            .errors =
                [] {
                    std::vector<ModelError> errors;
                    for (const double smoothness : steps(0.0, 1.0, 21)) {
                        for (const double n_v : view_cosines()) {
                            const SplitSum lobe = reference::split_sum_blinn(power_of_smoothness(smoothness), n_v);
                            for (const double specular : steps(0.0, 1.0, 11)) {
                                const double returned = (1.0 - specular) + lobe.of(specular);
                                errors.push_back({{n_v, smoothness, specular}, returned - 1.0});
                            }
                        }
                    }
                    return errors;
                },
            .largest = {1.0, "a mirror seen edge on sends n.v^2 back: the lobe is not divided by n.v"},
            .mean = {0.34, "the same loss over all angles; the gain of rough dielectrics is 0.015"}};
}

ModelEntry glossy_fresnel_of_split_sum(GlossyFresnel fresnel) {
    return {
        .effect = "surface",
        .model = "glossy Fresnel",
        .truth = "the split sum of GGX, alpha^2 = 2 / (power + 2)",
        .unit = "absolute",
        .axes = {"n.v", "smoothness", "specular"},
        .errors =
            [fresnel] {
                std::vector<ModelError> errors;
                for (const double smoothness : steps(0.0, 1.0, 21)) {
                    const double alpha = std::sqrt(2.0 / (power_of_smoothness(smoothness) + 2.0));
                    for (const double n_v : view_cosines()) {
                        const SplitSum lobe = reference::split_sum_ggx(alpha, n_v);
                        for (const double specular : {0.0437, 0.25, 0.5, 0.75, 1.0}) {
                            errors.push_back(
                                {{n_v, smoothness, specular}, fresnel(specular, smoothness, n_v) - lobe.of(specular)});
                        }
                    }
                }
                return errors;
            },
        .largest =
            {0.51,
             "specular 1 at a power of 2: GGX loses a half there by scattering once only, the glossy Fresnel nothing"},
        .mean = {0.066,
                 "the same over all metals; at the specular of dielectrics the mean is 0.016, the largest 0.19"}};
}

}  // namespace halfframe::accuracy
