// What render and report share.
#include "perf/cli/drawing.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "perf/cli/cache_folder.h"
#include "perf/cli/own_process.h"

namespace halfframe::cli {
namespace {

constexpr const char* kDefaultBudget = "ps3_30fps";

/// From `halfframe cost --json`: counting pins the driver, and times must not be taken from a pinned one.
perf::Modelled modelled(const std::string& scene, SceneOptions options) {
    options.device.context = SceneOptions().device.context;
    return perf::modelled_from(nlohmann::ordered_json::parse(
        output_of_own("cost " + shell_quoted(scene) + options_text(options) + " --budget none --json")));
}

}  // namespace

void add_drawing_options(CLI::App& command, DrawingOptions& options) {
    command
        .add_option(
            "--measure", options.measured_frames,
            "Frames to time after a first one, 0 to 100000; 0: time nothing. The table shows the median and the "
            "25th to 75th percentile [ms]")
        ->type_name("N")
        ->check(CLI::Range(0, 100000).description(""))
        ->capture_default_str();
    command
        .add_option(
            "--budget", options.budget,
            "Budget by name or .json file: rows [ms], and limits of milliseconds, memory [MiB], counters and bytes a "
            "pixel that fit scenes, cameras and tiers (content/README.md). One named here judges the frame's time on a "
            "software driver too. Default: ps3_30fps")
        ->type_name("NAME|FILE");
    command.add_flag("--census", options.census,
                     "Draw once more with every target RGBA32F and count NaN and inf; exit 1 when there is one");
    command.add_flag(
        "--cost", options.cost,
        "Fill the columns ps3, x360 and es2 of the table: a second process counts, as halfframe cost does");
    command.add_flag("--json", options.json,
                     "Standard output is one JSON value; everything else goes to standard error");
}

perf::DrawRequest draw_request(const SceneOptions& scene_options, const DrawingOptions& options, Progress& progress) {
    perf::DrawRequest request;
    request.measured_frames = options.measured_frames;
    request.census = options.census;
    request.program_cache_folder = cache_folder(scene_options.cache);
    request.between = [&progress](const std::string& step) {
        stop_if_interrupted();
        progress.show(step);
    };
    return request;
}

DrawnScene draw_with_options(GraphicsDevice& device, const std::string& scene, const SceneOptions& options,
                             const DrawingOptions& drawing, const perf::DrawRequest& request) {
    const Budget budget = content::budget(drawing.budget.empty() ? kDefaultBudget : drawing.budget);
    request.between("opening " + scene);
    const OpenedScene opened = open_with_options(scene, options, device.caps(), request.between);
    DrawnScene drawn;
    drawn.result = perf::draw_scene(device.gl(), device.caps(), opened.scene, opened.view, opened.wishes, request);
    perf::FrameReport& report = drawn.result.report;
    report.scene = opened.label;
    report.camera = camera_name(opened);
    report.context = device.context().description();
    if (drawing.cost) {
        request.between("counting " + scene);
        report.modelled = modelled(scene, options);
    }
    drawn.budget = perf::budget_table(report, budget, !drawing.budget.empty());
    return drawn;
}

int budget_verdict(const perf::BudgetTable& budget, const std::string& scene) {
    const auto tell = [&](perf::Verdict verdict, const std::string& sentence) {
        if (verdict == perf::Verdict::over) complain("failed: " + scene + ": " + sentence + "\n");
        if (verdict == perf::Verdict::warned) complain("warning: " + scene + ": " + sentence + "\n");
    };
    for (const perf::BudgetLine& line : budget.lines) tell(line.verdict, line.name + " is " + line.verdict_text);
    for (const perf::LimitLine& line : budget.limits) {
        tell(line.verdict, fmt::format("{} {} is {} (limit {})", line.name, line.value, line.verdict_text, line.limit));
    }
    return budget.exceeded() ? 1 : 0;
}

int verdict(const DrawnScene& drawn) {
    int code = 0;
    const auto fail = [&](const std::string& sentence) {
        complain("failed: " + sentence + "\n");
        code = 1;
    };
    code = budget_verdict(drawn.budget, drawn.result.report.scene);
    for (const CensusRow& row : drawn.result.report.census.value_or(std::vector<CensusRow>{})) {
        if (row.nan + row.inf > 0) {
            fail(
                fmt::format("{}: {} holds {} NaN and {} inf", drawn.result.report.scene, row.target, row.nan, row.inf));
        }
    }
    return code;
}

std::string options_text(const DrawingOptions& options) {
    const DrawingOptions defaults;
    std::string text;
    if (options.measured_frames != defaults.measured_frames) {
        text += fmt::format(" --measure {}", options.measured_frames);
    }
    if (!options.budget.empty()) {
        text += " --budget " + shell_quoted(options.budget);
    }
    if (options.census) {
        text += " --census";
    }
    if (options.cost) {
        text += " --cost";
    }
    return text;
}

}  // namespace halfframe::cli
