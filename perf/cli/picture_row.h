// A row of numbered pictures of an animation.
#pragma once

#include <string>
#include <vector>

#include "perf/cli/graphics_device.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/terminal.h"

namespace halfframe::cli {

/// "out.png" as the pictures of a row are called: "out_0000.png", "out_0001.png" ...
[[nodiscard]] std::string numbered(const std::string& output, int frame);

/// Draws `sequence` of a scene from the options' time on and writes each picture as soon as it is there, whole. Returns
/// their names. An interruption keeps those that are written.
[[nodiscard]] std::vector<std::string> draw_row(GraphicsDevice& device, const std::string& scene,
                                                const SceneOptions& options, const Sequence& sequence,
                                                const std::string& output, Progress& progress);

}  // namespace halfframe::cli
