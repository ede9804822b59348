// halfframe render SCENE: one picture and what it cost.
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/drawing.h"
#include "perf/cli/picture_row.h"
#include "perf/report/atomic_file.h"
#include "perf/report/html_page.h"
#include "perf/report/json_report.h"
#include "perf/report/picture_file.h"
#include "perf/report/text_report.h"

namespace halfframe::cli {
namespace {

class RenderCommand : public Command {
public:
    explicit RenderCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "render", "Draws a scene without a window, writes the picture, and prints what each pass cost");
        command.add_option("SCENE", scene_, "A .gltf or .glb file, or a built-in scene (halfframe scenes)")->required();
        command
            .add_option("-o,--output", output_,
                        ".png: what a display shows, 8-bit RGB. .exr: linear light of scene_color, 32-bit float")
            ->type_name("FILE");
        add_scene_options(command, options_);
        add_drawing_options(command, drawing_);
        command
            .add_option("--trace", trace_,
                        "Write every GL call of preparing and of exactly one frame as JSON, byte-stable between runs; "
                        "without timing and without the program cache")
            ->type_name("FILE");
        command.add_flag("--ledger", ledger_,
                         "Print the GL calls of preparing and of one frame by pass; without the program cache");
        command.add_flag("--programs", programs_, "Print every program that was linked, and what each is for");
        command.add_option("--html", html_, "Also write one self-contained HTML page")->type_name("FILE");
        command
            .add_option(
                "--frames", frames_,
                "Draw a row of so many pictures, 1 to 100000, each 1 / --fps later than the one before: FILE is "
                "numbered, out.png gives out_0000.png and so on. Nothing is timed, and no table printed")
            ->type_name("N")
            ->check(CLI::Range(1, 100000).description(""));
        command.add_option("--fps", fps_, "Pictures a second of --frames, above 0")
            ->type_name("F")
            ->capture_default_str()
            ->needs("--frames");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "render"; }

    int run() override {
        check_options(options_);
        check_outputs();
        Progress progress;
        if (frames_) {
            return draw_pictures(progress);
        }
        perf::DrawRequest request = draw_request(options_, drawing_, progress);
        request.between("starting");
        request.trace = !trace_.empty();
        request.linear = wants_exr();
        if (ledger_ || request.trace) {
            request.program_cache_folder.clear();
        }
        GraphicsDevice device(options_.device);
        DrawnScene drawn = draw_with_options(device, scene_, options_, drawing_, request);
        drawn.result.report.picture_file = output_;
        drawn.result.report.reproduce = reproduce();
        stop_if_interrupted();
        progress.clear();
        write_files(drawn);
        for (const std::string& sentence : drawn.result.report.notices) {
            notice(sentence);
        }
        print_results(drawn);
        return verdict(drawn);
    }

private:
    int draw_pictures(Progress& progress) const {
        GraphicsDevice device(options_.device);
        SceneOptions options = options_;
        if (!options.time_s) {
            options.time_s = 0.0;  // a row of rest poses would be a row of one picture
        }
        const std::vector<std::string> files = draw_row(device, scene_, options, {*frames_, fps_}, output_, progress);
        if (drawing_.json) {
            print_json({{"scene", scene_}, {"fps", fps_}, {"pictures", files}});
        } else {
            print(fmt::format("{} pictures: {} to {}\n", files.size(), files.front(), files.back()));
        }
        return 0;
    }

    void check_row() const {
        if (!(fps_ > 0.0 && fps_ <= 10000.0)) {
            throw Error(Fault::usage, fmt::format("--fps {}: above 0 and at most 10000", fps_));
        }
        if (!output_.ends_with(".png")) {
            throw Error(Fault::usage, "--frames needs -o FILE.png, from which the pictures get their names");
        }
        if (!trace_.empty() || !html_.empty() || ledger_ || programs_ || drawing_.census) {
            throw Error(Fault::usage,
                        "--frames draws pictures alone: leave out --trace, --ledger, --programs, --html and --census, or choose "
                        "one moment with --time");
        }
        perf::expect_can_write(numbered(output_, 0));
    }

    [[nodiscard]] bool wants_exr() const { return output_.ends_with(".exr"); }

    /// Before minutes of drawing: can all that was asked for be written?
    void check_outputs() const {
        if (!output_.empty() && !wants_exr() && !output_.ends_with(".png")) {
            throw Error(Fault::usage, fmt::format("-o {}: the name must end in .png or .exr", output_));
        }
        if (frames_) {
            check_row();
            return;
        }
        std::set<std::filesystem::path> seen;
        for (const std::string& file : {output_, trace_, html_}) {
            if (file.empty()) {
                continue;
            }
            perf::expect_can_write(file);
            if (!seen.insert(std::filesystem::weakly_canonical(file)).second) {
                throw Error(Fault::usage, fmt::format("{} is named twice; give each output a file of its own", file));
            }
        }
    }

    void write_files(const DrawnScene& drawn) const {
        if (wants_exr()) {
            perf::write_exr(output_, drawn.result.linear.value());
        } else if (!output_.empty()) {
            perf::write_png(output_, drawn.result.report.display);
        }
        if (!trace_.empty()) {
            perf::write_file(trace_, drawn.result.trace_json);
        }
        if (!html_.empty()) {
            perf::write_file(html_, perf::html_page({{&drawn.result.report, &drawn.budget}}));
        }
    }

    void print_results(const DrawnScene& drawn) const {
        if (drawing_.json) {
            print_json(perf::report_json(drawn.result.report, drawn.budget));
            return;
        }
        print(perf::budget_text(drawn.budget, drawn.result.report));
        if (drawn.result.report.census) {
            print("\n" + perf::census_text(*drawn.result.report.census));
        }
        if (programs_) {
            print("\n" + perf::programs_text(drawn.result.report));
        }
        if (ledger_) {
            print("\n" + perf::ledger_text(drawn.result.report));
        }
    }

    [[nodiscard]] std::string reproduce() const {
        return "halfframe render " + shell_quoted(scene_) + options_text(options_) + options_text(drawing_) +
               (output_.empty() ? "" : " -o " + shell_quoted(output_));
    }

    std::string scene_;
    std::string output_;
    SceneOptions options_;
    DrawingOptions drawing_;
    std::string trace_;
    std::string html_;
    bool ledger_ = false;
    bool programs_ = false;
    std::optional<int> frames_;
    double fps_ = 30.0;
};

}  // namespace

std::unique_ptr<Command> make_render_command(CLI::App& app) { return std::make_unique<RenderCommand>(app); }

}  // namespace halfframe::cli
