// The wet surface against the film of water that it stands for: diffuse light, mirrored light, and both under a sun.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "engine/effects/surface/surface_model_reference.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/effects/wet_surface/wet_surface_model_reference.h"
#include "perf/accuracy/model_list.h"

namespace halfframe::accuracy {
namespace {

using reference::Cosines;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSpecular = 0.0437;    // sRGB 59, the talk's dielectric
constexpr double kWaterPower = 2048.0;  // the sharpest lobe there is here stands for the film's mirror

/// How much of a base is open pores, by its smoothness: the talk's assumption, which no optics can judge. Lagarde,
/// "Water drop 3b: physically based wet surfaces" (2013): none above 0.5, all below 0.1.
double open_pores(double smoothness) { return std::clamp((0.5 - smoothness) / 0.4, 0.0, 1.0); }

double power_of_smoothness(double smoothness) { return std::exp2(10.0 * smoothness + 1.0); }

/// A grey dielectric of that albedo, wet.
reference::WetMaterial wetted(WetFormula wet, double albedo, double smoothness, double wetness) {
    return wet({{albedo, albedo, albedo}, {kSpecular, kSpecular, kSpecular}, smoothness}, wetness);
}

/// 0, 0.05 ... 1 and 0, 0.1 ... 1: the two axes of every map.
template <typename Visit>
void for_each_wetness(Visit visit) {
    for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 10; ++j) visit(0.05 * i, 0.1 * j);
    }
}

std::vector<ModelError> diffuse_errors(WetFormula wet) {
    std::vector<ModelError> errors;
    for_each_wetness([&](double smoothness, double wetness) {
        for (const double albedo : {0.05, 0.2, 0.5, 0.8}) {
            for (const double light_deg : {0.0, 30.0, 60.0, 75.0, 85.0}) {
                const double truth = reference::wet_diffuse_factor(albedo, open_pores(smoothness), wetness,
                                                                   std::cos(light_deg * kDegree));
                errors.push_back({{smoothness, wetness, light_deg, albedo},
                                  wetted(wet, albedo, smoothness, wetness).albedo[0] - albedo * truth});
            }
        }
    });
    return errors;
}

std::vector<ModelError> mirror_errors(WetFormula wet) {
    std::vector<ModelError> errors;
    for_each_wetness([&](double smoothness, double wetness) {
        const double wet_smoothness = wetted(wet, 0.2, smoothness, wetness).smoothness;
        for (const double view_deg : {0.0, 30.0, 45.0, 60.0, 75.0, 85.0}) {
            const double n_v = std::cos(view_deg * kDegree);
            const double truth = (1.0 - wetness) * reference::fresnel_glossy(kSpecular, smoothness, n_v) +
                                 wetness * reference::film_reflectance(n_v);
            errors.push_back(
                {{smoothness, wetness, view_deg}, reference::fresnel_glossy(kSpecular, wet_smoothness, n_v) - truth});
        }
    });
    return errors;
}

/// Cosines of a view in the plane of the light, on the far side of the normal where `view_deg` is above 0.
Cosines in_plane(double light_deg, double view_deg) {
    const double half_deg = 0.5 * (view_deg - light_deg), apart_deg = 0.5 * (view_deg + light_deg);
    return {std::cos(light_deg * kDegree), std::cos(view_deg * kDegree), std::cos(half_deg * kDegree),
            std::cos(apart_deg * kDegree)};
}

std::vector<ModelError> radiance_errors(WetFormula wet) {
    std::vector<ModelError> errors;
    for_each_wetness([&](double smoothness, double wetness) {
        for (const double albedo : {0.1, 0.5}) {
            const reference::WetMaterial look = wetted(wet, albedo, smoothness, wetness);
            for (const double light_deg : {20.0, 50.0, 75.0}) {
                for (int view_deg = -80; view_deg <= 80; view_deg += 5) {
                    const Cosines at = in_plane(light_deg, view_deg);
                    const double model =
                        reference::talk_brdf(look.albedo[0], kSpecular, power_of_smoothness(look.smoothness), at);
                    const double factor =
                        reference::wet_radiance_factor(albedo, open_pores(smoothness), wetness, at.n_l, at.n_v);
                    const double dry_lobe = reference::talk_brdf(0.0, kSpecular, power_of_smoothness(smoothness), at);
                    const double film_lobe = reference::film_reflectance(at.l_h) * (kWaterPower + 2.0) / 8.0 *
                                             std::pow(at.n_h, kWaterPower) / std::numbers::pi;
                    const double truth =
                        albedo * factor / std::numbers::pi + (1.0 - wetness) * dry_lobe + wetness * film_lobe;
                    const double irradiance = std::numbers::pi * at.n_l;  // of a sun of colour 1
                    errors.push_back({{smoothness, wetness, light_deg, static_cast<double>(view_deg), albedo},
                                      255.0 * (reference::tone_curve(model * irradiance) -
                                               reference::tone_curve(truth * irradiance))});
                }
            }
        }
    });
    return errors;
}

}  // namespace

ModelEntry diffuse_light_of_film(WetFormula wet) {
    return {.effect = "wet_surface",
            .model = "wet diffuse light",
            .truth = "a film of water over grains in water (open pores) or over a body of its own (closed)",
            .unit = "absolute",
            .axes = {"smoothness", "wetness", "light [deg]", "albedo"},
            .errors = [wet] { return diffuse_errors(wet); },
            .largest =
                {0.33,
                 "bright plaster, albedo 0.8: the talk leaves a fifth of any porous albedo, water 0.6 of this one, for "
                 "light that is scattered often comes back whatever the grains lie in: -0.32"},
            .mean = {0.02, "0.018, all from porous surfaces brighter than 0.3; without the darkening it is 0.041"}};
}

ModelEntry mirrored_light_of_film(WetFormula wet) {
    return {
        .effect = "wet_surface",
        .model = "wet mirrored share",
        .truth = "the wet share mirrors as water over stone does, the dry share as before",
        .unit = "absolute",
        .axes = {"smoothness", "wetness", "view [deg]"},
        .errors = [wet] { return mirror_errors(wet); },
        .largest = {0.32,
                    "a rough surface seen at 85 degrees, soaked: a film mirrors half there, the glossy Fresnel of a "
                    "smoothness of 0.4 little: -0.31"},
        .mean = {0.028, "0.026, from 60 degrees on; without the rise of the smoothness it is 0.033"}};
}

ModelEntry radiance_of_film(WetFormula wet) {
    return {
        .effect = "wet_surface",
        .model = "wet surface, radiance",
        .truth = "the same film with a mirror's highlight beside the dry one, a sun of colour 1, views in its plane",
        .unit = "codes",
        .axes = {"smoothness", "wetness", "light [deg]", "view [deg]", "albedo"},
        .errors = [wet] { return radiance_errors(wet); },
        .largest =
            {190.0,
             "the film's sharp highlight, low over the horizon: one lobe between dry and wet stands for the two that "
             "there are: -183"},
        .mean = {8.6, "8.4 codes, mostly near the mirror direction; a surface that is left dry has 13.2"}};
}

}  // namespace halfframe::accuracy
