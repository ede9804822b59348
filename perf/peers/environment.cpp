// Reads an .hdr file for its mean, and lights a scene with it.
#include "perf/peers/environment.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <stb/stb_image.h>

#include "content/content.h"
#include "engine/error.h"

namespace halfframe::peers {

glm::vec3 mean_radiance(const std::filesystem::path& hdr) {
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<float, void (*)(void*)> pixels(stbi_loadf(hdr.c_str(), &width, &height, &channels, 3),
                                                         stbi_image_free);
    if (!pixels) {
        throw Error(Fault::input, hdr.string() + " is no readable .hdr file: " + stbi_failure_reason() +
                                      "; give another with --environment");
    }
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int y = 0; y < height; ++y) {
        const double weight = std::sin((y + 0.5) / height * std::numbers::pi);  // rows shrink towards the poles
        for (int x = 0; x < width; ++x) {
            const float* pixel = pixels.get() + 3 * (static_cast<std::size_t>(y) * width + x);
            sum += weight * glm::dvec3(pixel[0], pixel[1], pixel[2]);
        }
        weights += weight * width;
    }
    return glm::vec3(sum / weights);
}

void add_environment(Scene& scene, const std::filesystem::path& hdr, float scale) {
    EnvironmentMap map = content::environment(hdr.string()).map;
    for (auto& level : map.levels) {
        for (glm::vec3& texel : level) texel *= scale;
    }
    for (glm::vec3& term : map.irradiance) term *= scale;
    scene.environment = std::move(map);
    scene.ambient = glm::vec3(0.0f);
}

}  // namespace halfframe::peers
