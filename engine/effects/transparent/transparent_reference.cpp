// What is seen through layers, in double.
#include "engine/effects/transparent/transparent_reference.h"

#include <map>

namespace halfframe::reference {

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

}  // namespace halfframe::reference
