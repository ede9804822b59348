// Poses, draws and writes one picture after the other.
#include "perf/cli/picture_row.h"

#include <filesystem>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/pose.h"
#include "engine/frame/renderer.h"
#include "perf/cli/cache_folder.h"
#include "perf/report/picture_file.h"

namespace halfframe::cli {

std::string numbered(const std::string& output, int frame) {
    const std::filesystem::path path(output);
    const std::string name = fmt::format("{}_{:04}{}", path.stem().string(), frame, path.extension().string());
    return (path.parent_path() / name).string();
}

std::vector<std::string> draw_row(GraphicsDevice& device, const std::string& scene, const SceneOptions& options,
                                  const Sequence& sequence, const std::string& output, Progress& progress) {
    const auto between = [&](const std::string& step) {
        stop_if_interrupted();
        progress.show(step);
    };
    between("opening " + scene);
    OpenedScene opened = open_with_options(scene, options, device.caps(), between, sequence);
    const FramePlan plan = plan_frame(opened.scene, opened.view, opened.wishes, device.caps(), all_effects());
    if (const auto sentence = broken_rule(plan, device.caps())) {
        throw Error(Fault::check, fmt::format("the plan of {} breaks a rule: {}", scene, *sentence));
    }
    Animator animator(opened.scene);
    Renderer renderer(device.gl(), device.caps(), {.program_cache_folder = cache_folder(options.cache)});
    between("loading textures and shaders");
    renderer.prepare(opened.scene, plan);
    std::vector<std::string> written;
    for (int frame = 0; frame < sequence.frames; ++frame) {
        between(fmt::format("drawing picture {} of {}", frame + 1, sequence.frames));
        animator.pose(opened.scene, opened.animation, options.time_s.value_or(0.0) + frame / sequence.fps);
        renderer.draw(moved_view(opened));
        const Picture picture = renderer.read_display();
        if (const std::string error = renderer.first_gl_error(); !error.empty()) {
            throw Error(Fault::check, fmt::format("GL reports {} after drawing picture {} of {}", error, frame, scene));
        }
        written.push_back(numbered(output, frame));
        perf::write_png(written.back(), picture);
    }
    progress.clear();
    for (const std::vector<std::string>& notices : {opened.scene.notices, plan.notices, renderer.notices()}) {
        for (const std::string& sentence : notices) notice(sentence);
    }
    return written;
}

}  // namespace halfframe::cli
