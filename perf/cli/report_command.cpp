// halfframe report SCENE...: a folder with the picture of each scene and one page over all of them.
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/drawing.h"
#include "perf/report/atomic_file.h"
#include "perf/report/html_page.h"
#include "perf/report/json_report.h"
#include "perf/report/picture_file.h"
#include "perf/report/text_report.h"

namespace halfframe::cli {
namespace {

class ReportCommand : public Command {
public:
    explicit ReportCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "report", "Draws several scenes into a folder: NAME.png each, and index.html over all of them");
        command.add_option("SCENE", scenes_, "One or more .gltf or .glb files or built-in scenes (halfframe scenes)")
            ->required();
        command.add_option("-o,--output", folder_, "Folder, made when it is missing")
            ->type_name("DIR")
            ->capture_default_str();
        add_scene_options(command, options_);
        add_drawing_options(command, drawing_);
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "report"; }

    int run() override {
        check_options(options_);
        make_folder();
        Progress progress;
        const perf::DrawRequest request = draw_request(options_, drawing_, progress);
        request.between("starting");
        GraphicsDevice device(options_.device);
        std::vector<DrawnScene> drawn;
        for (const std::string& scene : scenes_) {
            drawn.push_back(draw_with_options(device, scene, options_, drawing_, request));
            perf::FrameReport& report = drawn.back().result.report;
            const std::string picture = file_name(scene);
            report.picture_file = picture;
            report.reproduce = "halfframe render " + shell_quoted(scene) + options_text(options_) +
                               options_text(drawing_) + " -o " + shell_quoted(picture);
            stop_if_interrupted();
            progress.clear();
            perf::write_png(std::filesystem::path(folder_) / picture, report.display);
            for (const std::string& sentence : report.notices) {
                notice(report.scene + ": " + sentence);
            }
        }
        write_page(drawn);
        return print_results(drawn);
    }

private:
    void make_folder() const {
        std::error_code error;
        std::filesystem::create_directories(folder_, error);
        if (error) {
            throw Error(Fault::environment, fmt::format("cannot make the folder {} ({}); choose another with -o",
                                                        folder_, error.message()));
        }
        perf::expect_can_write(page());
    }

    [[nodiscard]] std::filesystem::path page() const { return std::filesystem::path(folder_) / "index.html"; }

    /// The scene's name with .png; a second scene of the same name gets a number.
    std::string file_name(const std::string& scene) {
        const std::string stem = std::filesystem::path(scene).stem().string();
        std::string file = stem + ".png";
        for (int number = 2; !used_names_.insert(file).second; ++number) {
            file = fmt::format("{}-{}.png", stem, number);
        }
        return file;
    }

    void write_page(const std::vector<DrawnScene>& drawn) const {
        std::vector<perf::PageScene> scenes;
        for (const DrawnScene& scene : drawn) {
            scenes.push_back({&scene.result.report, &scene.budget});
        }
        perf::write_file(page(), perf::html_page(scenes));
    }

    [[nodiscard]] int print_results(const std::vector<DrawnScene>& drawn) const {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        int code = 0;
        for (const DrawnScene& scene : drawn) {
            const perf::FrameReport& report = scene.result.report;
            if (drawing_.json) {
                all.push_back(perf::report_json(report, scene.budget));
            } else {
                print(perf::budget_text(scene.budget, report) + "\n");
                if (report.census) {
                    print(perf::census_text(*report.census) + "\n");
                }
            }
            code = std::max(code, verdict(scene));
        }
        if (drawing_.json) {
            print_json(all);
            return code;
        }
        print("written:\n");
        for (const DrawnScene& scene : drawn) {
            print("  " + (std::filesystem::path(folder_) / scene.result.report.picture_file).string() + "\n");
        }
        print("  " + page().string() + "\n");
        return code;
    }

    std::vector<std::string> scenes_;
    std::string folder_ = "out";
    SceneOptions options_;
    DrawingOptions drawing_;
    std::set<std::string> used_names_;
};

}  // namespace

std::unique_ptr<Command> make_report_command(CLI::App& app) { return std::make_unique<ReportCommand>(app); }

}  // namespace halfframe::cli
