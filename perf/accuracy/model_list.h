// Which shading models are measured against what they stand for. No shader runs: both sides are double references, and
// the function list shows that the shaders say the same.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/effects/environment/environment_reference.h"
#include "engine/effects/transparent/transparent_reference.h"
#include "engine/effects/wet_surface/wet_surface_reference.h"
#include "perf/accuracy/function_list.h"

namespace halfframe::accuracy {

/// The error (model less truth) in one place of the domain, at[i] on axis i.
struct ModelError {
    std::vector<double> at;
    double error = 0.0;
};

struct ModelEntry {
    std::string effect;
    std::string model;
    const char* truth = "";
    const char* unit = "";          ///< of the error
    std::vector<std::string> axes;  ///< the first two span the map, the worst of the others is shown
    std::function<std::vector<ModelError>()> errors;
    Bound largest;  ///< of any error's size
    Bound mean;     ///< of the mean of the sizes
};

struct ModelAccuracy {
    ModelEntry entry;
    std::vector<ModelError> errors;
    double lowest = 0.0, highest = 0.0;  ///< with sign: what is lost, what is gained; 0 when nothing is
    double mean = 0.0;                   ///< of the sizes
    std::size_t worst = 0;               ///< index of the largest size
    std::vector<std::string> violations;
};

/// Evaluates an entry. Mistake: an error that is not finite.
[[nodiscard]] ModelAccuracy measure(const ModelEntry& entry);

/// Every model of the effects that are in this build.
[[nodiscard]] std::vector<ModelEntry> model_list();

// The models of the environment; a test may plant another glossy Fresnel, or another level for a smoothness 0..1.
using LevelOfSmoothness = double (*)(double smoothness, double roughest_level);
[[nodiscard]] ModelEntry reflection_between_levels(LevelOfSmoothness level);
[[nodiscard]] ModelEntry reflection_of_constant_smoothness(LevelOfSmoothness level);
using RoughReflection = double (*)(const std::array<double, 3>& toward, const reference::RoughTerms& terms);
[[nodiscard]] ModelEntry reflection_by_vertex(RoughReflection reflection);
[[nodiscard]] ModelEntry reflection_by_vertex_of_harsh_lamp(RoughReflection reflection);

// The models of the surface, with what a test may plant: how a roughness becomes a power, how a smoothness brightens.
using PowerOfRoughness = double (*)(double roughness);
using GlossyFresnel = double (*)(double specular, double smoothness, double n_v);
[[nodiscard]] ModelEntry reflectance_of_mapping(PowerOfRoughness power);
[[nodiscard]] ModelEntry radiance_of_mapping(PowerOfRoughness power);
[[nodiscard]] ModelEntry furnace_of_ambient(GlossyFresnel fresnel);
[[nodiscard]] ModelEntry furnace_of_direct_light();
[[nodiscard]] ModelEntry glossy_fresnel_of_split_sum(GlossyFresnel fresnel);
/// Of the environment, but its Fresnel is the surface's.
[[nodiscard]] ModelEntry reflection_of_integral(GlossyFresnel fresnel);

// The models of transparent; a test may plant another order, or what is blended.
struct Pane {
    double centre_m = 0.0;  ///< before the eye
    double turned_rad = 0.0;
    double half_width_m = 0.0;
};
using PaneOrder = double (*)(const Pane& pane);  ///< what panes are sorted by
[[nodiscard]] double centre_order(const Pane& pane);
[[nodiscard]] ModelEntry order_of_panes(PaneOrder order);
[[nodiscard]] ModelEntry blended_as(reference::Held held);  ///< display or root

// The models of wet surfaces; a test may plant another formula.
using WetFormula = reference::WetMaterial (*)(const reference::DryMaterial& dry, double wetness);
[[nodiscard]] ModelEntry diffuse_light_of_film(WetFormula wet);
[[nodiscard]] ModelEntry mirrored_light_of_film(WetFormula wet);
[[nodiscard]] ModelEntry radiance_of_film(WetFormula wet);

}  // namespace halfframe::accuracy
