// What is seen through layers, in double.
#include "engine/effects/transparent/transparent_reference.h"

#include <cmath>
#include <map>

#include "engine/effects/tone_map/tone_map_reference.h"

namespace halfframe::reference {
namespace {

glm::dvec3 each(const glm::dvec3& values, double (*function)(double)) {
    return {function(values.x), function(values.y), function(values.z)};
}

}  // namespace

glm::dvec3 seen_through(const std::vector<BlendedLayer>& layers, const glm::dvec3& behind) {
    std::multimap<double, const BlendedLayer*> near_to_far;
    for (const BlendedLayer& layer : layers) near_to_far.emplace(layer.distance_m, &layer);
    glm::dvec3 light(0.0);
    double passed = 1.0;  // share of what lies behind that comes through all layers so far
    for (const auto& [distance_m, layer] : near_to_far) {
        light += passed * layer->alpha * layer->light;
        passed *= 1.0 - layer->alpha;
    }
    return light + passed * behind;
}

glm::dvec3 shown_through(const std::vector<BlendedLayer>& layers, const glm::dvec3& behind, Held held) {
    if (held == Held::light) return each(seen_through(layers, behind), tone_curve);
    double (*const held_of)(double) =
        held == Held::root ? static_cast<double (*)(double)>([](double light) { return std::sqrt(light); })
                           : tone_curve;
    std::vector<BlendedLayer> stored = layers;
    for (BlendedLayer& layer : stored) layer.light = each(layer.light, held_of);
    const glm::dvec3 seen = seen_through(stored, each(behind, held_of));
    return held == Held::root ? each(seen * seen, tone_curve) : seen;
}

}  // namespace halfframe::reference
