// The list of measured models, and their measurement.
#include "perf/accuracy/model_list.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/effects/environment/environment_reference.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/effects/wet_surface/wet_surface_reference.h"
#include "engine/error.h"
#include "engine/frame/effect_card.h"

namespace halfframe::accuracy {
namespace {

void judge(ModelAccuracy& result, const char* what, double found, const Bound& bound) {
    if (found <= bound.at_most) return;
    result.violations.push_back(fmt::format("{}, {}: {} error {:.3g} {} is over the bound of {:g} ({})",
                                            result.entry.effect, result.entry.model, what, found, result.entry.unit,
                                            bound.at_most, bound.reason));
}

}  // namespace

ModelAccuracy measure(const ModelEntry& entry) {
    ModelAccuracy result{.entry = entry, .errors = entry.errors(), .violations = {}};
    expect(!result.errors.empty(), "a measured model has errors to measure");
    for (std::size_t i = 0; i < result.errors.size(); ++i) {
        const ModelError& at = result.errors[i];
        expect(std::isfinite(at.error) && at.at.size() == entry.axes.size(),
               [&] { return fmt::format("{}: error {} is {}", entry.model, i, at.error); });
        result.lowest = std::min(result.lowest, at.error);
        result.highest = std::max(result.highest, at.error);
        result.mean += std::fabs(at.error) / static_cast<double>(result.errors.size());
        if (std::fabs(at.error) > std::fabs(result.errors[result.worst].error)) result.worst = i;
    }
    judge(result, "largest", std::fabs(result.errors[result.worst].error), entry.largest);
    judge(result, "mean", result.mean, entry.mean);
    return result;
}

std::vector<ModelEntry> model_list() {
    const std::vector<ModelEntry> all{reflectance_of_mapping(&reference::power_from_roughness),
                                      radiance_of_mapping(&reference::power_from_roughness),
                                      furnace_of_ambient(&reference::fresnel_glossy),
                                      furnace_of_direct_light(),
                                      glossy_fresnel_of_split_sum(&reference::fresnel_glossy),
                                      reflection_of_integral(&reference::fresnel_glossy),
                                      reflection_between_levels(&reference::reflection_level),
                                      reflection_of_constant_smoothness(&reference::constant_reflection_level),
                                      reflection_by_vertex(&reference::rough_reflection),
                                      reflection_by_vertex_of_harsh_lamp(&reference::rough_reflection),
                                      diffuse_light_of_film(&reference::wet_material),
                                      mirrored_light_of_film(&reference::wet_material),
                                      radiance_of_film(&reference::wet_material),
                                      order_of_panes(&centre_order),
                                      blended_as(reference::Held::root),
                                      blended_as(reference::Held::display)};
    std::vector<ModelEntry> list;
    for (const ModelEntry& entry : all) {
        if (find_effect(entry.effect) != nullptr) list.push_back(entry);
    }
    return list;
}

}  // namespace halfframe::accuracy
