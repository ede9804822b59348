// halfframe cost: what a scene's frame, or a user's own fragment shader, costs on devices that are not here.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/json_place.h"
#include "engine/error.h"
#include "perf/cli/cache_folder.h"
#include "perf/cli/command.h"
#include "perf/cli/counting_device.h"
#include "perf/cli/own_process.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/spelling.h"
#include "perf/cli/terminal.h"
#include "perf/cost/cost_report.h"
#include "perf/cost/effect_table.h"
#include "perf/cost/user_shader_report.h"
#include "perf/report/atomic_file.h"

namespace halfframe::cli {
namespace {

constexpr std::uint64_t kMostShaderBytes = 1u << 20;

class CostCommand : public Command {
public:
    explicit CostCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "cost", "Says what a frame costs on a PS3, an Xbox 360 and an ES 2 phone: modelled, the same everywhere");
        command.add_option(
            "SCENE", input_,
            "A .gltf or .glb file, a built-in scene, or a fragment shader of yours (.frag, ES 1.00 or 3.00)");
        add_scene_options(command, options_);
        command
            .add_option("--profile", profiles_,
                        "Device: ps3, x360, es2_class or a .json file; repeatable. Default: these three")
            ->type_name("NAME|FILE")
            ->allow_extra_args(false);
        command
            .add_option("--why", why_, "List every instruction of a pass under its line of text, with what it costs")
            ->type_name("PASS");
        command
            .add_option("--texture", textures_,
                        "Of a shader: format of what a sampler reads, rgba8 (default), rgb10_a2, r11g11b10f, rgba16f, "
                        "rgba32f, with ,trilinear where it is; repeatable")
            ->type_name("NAME=FORMAT")
            ->allow_extra_args(false);
        command.add_option("--into", into_, "Of a shader: format of the target it fills")
            ->type_name("FORMAT")
            ->capture_default_str();
        command.add_flag("--json", json_, "Standard output is one JSON value (content/schemas/cost.schema.json)");
        command.add_option("--csv", csv_, "Also write one line for each device and pass")->type_name("FILE");
        command
            .add_option(
                "--trace", trace_,
                "Also write a trace that Perfetto opens: a process for each device, one for what is measured here")
            ->type_name("FILE");
        command
            .add_option("--refresh-tables", tables_,
                        "Instead of a scene: write the counts of every effect's shaders into this file "
                        "(content/costs/effects.json), which a test compares with the shaders")
            ->type_name("FILE");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "cost"; }

    int run() override {
        if (!tables_.empty()) {
            perf::write_file(tables_, cost::effect_table_text());
            return 0;
        }
        if (input_.empty()) throw Error(Fault::usage, "cost: name a SCENE or a shader; see halfframe cost --help");
        check_options(options_);
        std::vector<cost::Profile> profiles;
        for (const std::string& profile : profiles_) profiles.push_back(cost::load_profile(profile));
        if (profiles.empty()) profiles = cost::built_in_profiles();
        for (const std::string& file : {csv_, trace_})
            if (!file.empty()) perf::expect_can_write(file);
        if (input_.ends_with(".frag") || input_.ends_with(".glsl")) return run_shader(profiles);
        if (!textures_.empty()) throw Error(Fault::usage, "--texture belongs to a shader; SCENE is a scene");
        return run_scene(profiles);
    }

private:
    /// The priced arithmetic: half unless full was asked for, whatever runs fast here.
    [[nodiscard]] gl::Arithmetic arithmetic() const {
        return options_.arithmetic == "full" ? gl::Arithmetic::full : gl::Arithmetic::half;
    }

    int run_scene(const std::vector<cost::Profile>& profiles) {
        Progress progress;
        const auto between = [&progress](const std::string& step) {
            stop_if_interrupted();
            progress.show(step);
        };
        std::optional<cost::MeasuredPasses> measured;
        if (!trace_.empty()) {
            between("measuring");
            measured = measured_here();
        }
        between("starting");
        CountingDevice device(options_.device.device, cache_folder(options_.cache));
        const OpenedScene opened = open_with_options(input_, options_, device.caps(), between);
        between("counting fragments");
        cost::ShaderLibrary library;
        const cost::CountedFrame frame = cost::count_frame(device.recorder(), device.gl(), device.caps(), opened.scene,
                                                           opened.view, opened.wishes, library);
        between("counting instructions");
        if (!why_.empty()) {
            progress.clear();
            print(cost::why_text(frame, library, arithmetic(), why_));
            return 0;
        }
        cost::FrameCost cost = cost::frame_cost(frame, library, arithmetic(), profiles);
        cost.scene = opened.label;
        cost.notices.insert(cost.notices.begin(), opened.scene.notices.begin(), opened.scene.notices.end());
        progress.clear();
        if (!csv_.empty()) perf::write_file(csv_, cost::cost_csv(cost));
        if (!trace_.empty()) perf::write_file(trace_, cost::cost_trace(cost, measured).dump() + "\n");
        if (json_) print_json(cost::cost_json(cost));
        else print(cost::cost_text(cost));
        return 0;
    }

    /// Times run with all the machine has, in a process of their own: this one is pinned.
    [[nodiscard]] cost::MeasuredPasses measured_here() const {
        const nlohmann::json report =
            nlohmann::json::parse(output_of_own("render " + shell_quoted(input_) + options_text(options_) + " --json"));
        cost::MeasuredPasses measured{.device = report.at("renderer").get<std::string>()};
        for (const auto& pass : report.at("measurement").at("passes"))
            measured.pass_ms.emplace_back(pass.at("pass").get<std::string>(),
                                          pass.at("summary").at("median_ms").get<double>());
        return measured;
    }

    int run_shader(const std::vector<cost::Profile>& profiles) {
        if (!why_.empty() && why_ != "shader")
            throw Error(Fault::usage, "--why " + why_ + ": a shader is one pass, called shader");
        if (!trace_.empty()) throw Error(Fault::usage, "--trace is of a scene's frame; a shader has one pass");
        const std::string text = content::read_regular_file(input_, kMostShaderBytes, input_);
        cost::UserShaderRequest request{.file = input_, .text = text, .profiles = profiles};
        for (const std::string& words : textures_) request.textures.push_back(cost::parse_user_texture(words));
        const auto [width, height] = parsed_size(options_);
        request.target = {
            .width = width, .height = height, .format = cost::parse_color_format(into_, "--into"), .resolved = true};
        const cost::UserShaderCost cost = cost::user_shader_cost(request);
        if (!csv_.empty()) perf::write_file(csv_, cost::user_shader_csv(cost));
        if (json_) print_json(cost::user_shader_json(cost));
        else if (!why_.empty()) print(cost::user_shader_listing(cost, text));
        else print(cost::user_shader_text(cost));
        return 0;
    }

    std::string input_;
    SceneOptions options_;
    std::vector<std::string> profiles_;
    std::vector<std::string> textures_;
    std::string into_ = "rgba8";
    std::string why_;
    std::string csv_;
    std::string trace_;
    std::string tables_;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_cost_command(CLI::App& app) { return std::make_unique<CostCommand>(app); }

}  // namespace halfframe::cli
