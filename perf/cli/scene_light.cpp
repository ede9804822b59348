// Environments from the command line, and the studio rig.
#include "perf/cli/scene_light.h"

#include <fmt/format.h>

#include "content/content.h"

namespace halfframe::cli {
namespace {

constexpr const char* kStudio = "studio";  // the environment that goes with the rig

EnvironmentMap loaded(Scene& scene, const std::string& name_or_file, const std::filesystem::path& cache_folder,
                      const std::function<void(const std::string&)>& between) {
    content::EnvironmentOptions options;
    if (!cache_folder.empty()) options.cache_folder = cache_folder / "environments";
    options.progress = [&](double done) {
        between(fmt::format("filtering the environment {}: {:.0f} %", name_or_file, 100.0 * done));
    };
    content::LoadedEnvironment environment = content::environment(name_or_file, options);
    scene.notices.insert(scene.notices.end(), environment.notices.begin(), environment.notices.end());
    return std::move(environment.map);
}

}  // namespace

void light(Scene& scene, const std::string& wished, const std::filesystem::path& cache_folder,
           const std::function<void(const std::string&)>& between) {
    if (wished == "none") {
        scene.environment.reset();
    } else if (!wished.empty()) {
        scene.environment = loaded(scene, wished, cache_folder, between);
    }
    const bool is_dark = scene.lights.empty() && scene.ambient == glm::vec3(0.0f) && !scene.environment;
    if (!is_dark) return;
    if (wished == "none") {
        content::add_studio_rig(scene);
        scene.notices.push_back("the scene brings no lights, so the studio rig lights it: a sun, two points, ambient");
    } else {
        content::add_studio_rig(scene, loaded(scene, kStudio, cache_folder, between));
        scene.notices.push_back(
            "the scene brings no lights, so the studio rig lights it: a sun, two points and an environment");
    }
}

}  // namespace halfframe::cli
