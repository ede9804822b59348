// halfframe check SCENE: a scene against the artists' chart.
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "perf/check/check.h"
#include "perf/check/check_report.h"
#include "perf/check/false_colour.h"
#include "perf/cli/cache_folder.h"
#include "perf/cli/command.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/terminal.h"
#include "perf/measure/draw_scene.h"
#include "perf/report/atomic_file.h"
#include "perf/report/picture_file.h"

namespace halfframe::cli {
namespace {

constexpr int kLetters_px = 16;

class CheckCommand : public Command {
public:
    explicit CheckCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "check",
            "Judges materials, textures and meshes of a scene by the artists' chart: albedo, specular, metal, "
            "smoothness, sizes, normal maps, waste; and says what storing it spares and loses");
        command.add_option("SCENE", scene_, "A .gltf or .glb file, or a built-in scene (halfframe scenes)")->required();
        command
            .add_option(
                "--thresholds", thresholds_,
                "A .json file with limits of your own; what it leaves out stays as content/check/thresholds.json "
                "has it")
            ->type_name("FILE");
        command.add_flag("--strict", strict_, "Warnings fail the check too");
        command.add_flag("--json", json_, "Standard output is one JSON value");
        command.add_option("--sarif", sarif_, "Also write the findings as SARIF 2.1.0")->type_name("FILE");
        command
            .add_option(
                "--picture", picture_,
                "Also draw the scene in false colours into a .png: grey where the chart is kept. The options below "
                "are for it, but for --device, whose largest texture is judged by")
            ->type_name("FILE");
        command
            .add_option("--font", font_, "TrueType font of the legend. Default: DejaVu Sans, else another of Debian's")
            ->type_name("FILE");
        add_scene_options(command, options_);
        command.footer(std::string("Exit code 1: there are errors (with --strict: or warnings).\n") + kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "check"; }

    int run() override {
        check_options(options_);
        check_outputs();
        check::Request request;
        request.thresholds = check::thresholds(thresholds_);
        const gl::DeviceProfile device = content::device_profile(options_.device.device);
        request.device = device.name;
        request.largest_texture = device.max_texture_size;
        request.most_texture_bytes = device.max_texture_bytes;
        Progress progress;
        progress.show("opening " + scene_);
        const Scene scene = content::open_scene(scene_);
        if (is_file()) request.file = scene_;
        progress.show("checking");
        const check::Report report = check::check_scene(scene, request);
        stop_if_interrupted();
        progress.clear();
        if (!picture_.empty()) draw(report, request.thresholds, progress);
        if (!sarif_.empty()) perf::write_file(sarif_, check::check_sarif(report, HALFFRAME_VERSION).dump(2) + "\n");
        for (const std::string& sentence : scene.notices) notice(sentence);
        if (json_) {
            print_json(check::check_json(report));
        } else {
            print(check::check_text(report));
        }
        const bool failed =
            report.count(check::Level::error) > 0 || (strict_ && report.count(check::Level::warning) > 0);
        return failed ? static_cast<int>(Fault::check) : 0;
    }

private:
    /// As content::open_scene() decides.
    [[nodiscard]] bool is_file() const {
        const auto& built_in = content::built_in_scenes();
        return std::none_of(built_in.begin(), built_in.end(),
                            [&](const content::BuiltInScene& each) { return each.name == scene_; });
    }

    void check_outputs() const {
        if (!picture_.empty() && !picture_.ends_with(".png")) {
            throw Error(Fault::usage, fmt::format("--picture {}: the name must end in .png", picture_));
        }
        std::set<std::filesystem::path> seen;
        for (const std::string& file : {picture_, sarif_}) {
            if (file.empty()) continue;
            perf::expect_can_write(file);
            if (!seen.insert(std::filesystem::weakly_canonical(file)).second) {
                throw Error(Fault::usage, fmt::format("{} is named twice; give each output a file of its own", file));
            }
        }
    }

    void draw(const check::Report& report, const check::Thresholds& limits, Progress& progress) const {
        const perf::Lettering lettering(perf::find_font(font_), kLetters_px);
        perf::DrawRequest request;
        request.measured_frames = 0;
        request.program_cache_folder = cache_folder(options_.cache);
        request.between = [&progress](const std::string& step) {
            stop_if_interrupted();
            progress.show(step);
        };
        GraphicsDevice device(options_.device);
        OpenedScene opened = open_with_options(scene_, options_, device.caps(), request.between);
        check::show_broken_rules(opened.scene, report, limits, opened.view.exposure);
        perf::DrawResult drawn =
            perf::draw_scene(device.gl(), device.caps(), opened.scene, opened.view, opened.wishes, request);
        check::draw_legend(drawn.report.display, check::shown_rules(report), lettering);
        perf::write_png(picture_, drawn.report.display);
        progress.clear();
    }

    std::string scene_;
    std::string thresholds_;
    std::string sarif_;
    std::string picture_;
    std::string font_;
    SceneOptions options_;
    bool strict_ = false;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_check_command(CLI::App& app) { return std::make_unique<CheckCommand>(app); }

}  // namespace halfframe::cli
