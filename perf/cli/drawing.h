// What render and report share: drawing options, the program cache folder, one scene from name to report.
#pragma once

#include <filesystem>
#include <string>

#include "engine/frame/budget.h"
#include "perf/cli/graphics_device.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/terminal.h"
#include "perf/measure/draw_scene.h"
#include "perf/report/budget_table.h"

namespace halfframe::cli {

struct DrawingOptions {
    int measured_frames = 5;
    std::string budget;  ///< empty: the default one, whose frame is not judged on a software driver
    bool census = false;
    bool json = false;
    bool cost = false;  ///< fill the modelled columns
};

/// Adds --measure, --budget, --census, --cost and --json.
void add_drawing_options(CLI::App& command, DrawingOptions& options);

/// The request that the options ask for.
[[nodiscard]] perf::DrawRequest draw_request(const SceneOptions& scene_options, const DrawingOptions& options,
                                             Progress& progress);

struct DrawnScene {
    perf::DrawResult result;
    perf::BudgetTable budget;
};

/// Opens, draws and judges one scene; its notices go to standard error.
[[nodiscard]] DrawnScene draw_with_options(GraphicsDevice& device, const std::string& scene,
                                           const SceneOptions& options, const DrawingOptions& drawing,
                                           const perf::DrawRequest& request);

/// Tells what is over on standard error: "failed: ..." and "warning: ...". 1 when something fails, else 0.
[[nodiscard]] int budget_verdict(const perf::BudgetTable& budget, const std::string& scene);

/// 1 when a judged limit was exceeded or the census found NaN or inf, with a sentence on standard error; else 0.
[[nodiscard]] int verdict(const DrawnScene& drawn);

/// " --measure 9 --census": the options that differ from the defaults.
[[nodiscard]] std::string options_text(const DrawingOptions& options);

}  // namespace halfframe::cli
