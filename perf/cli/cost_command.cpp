// halfframe cost: what a scene's frame, or a user's own fragment shader, costs on devices that are not here.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "content/json_place.h"
#include "engine/error.h"
#include "perf/cli/cache_folder.h"
#include "perf/cli/command.h"
#include "perf/cli/cost_views.h"
#include "perf/cli/drawing.h"
#include "perf/cli/own_process.h"
#include "perf/cli/price_table.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/spelling.h"
#include "perf/cli/terminal.h"
#include "perf/cost/cost_report.h"
#include "perf/cost/effect_table.h"
#include "perf/cost/user_shader_report.h"
#include "perf/report/atomic_file.h"
#include "perf/report/html_page.h"
#include "perf/report/json_report.h"

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
        command.add_flag("--all-cameras", all_cameras_,
                         "Count every camera of the scene: a table with a line for each");
        command.add_option("--tiers", tiers_, "Count these tiers too: a table with a line for each view and tier")
            ->type_name("TIER,...")
            ->delimiter(',')
            ->allow_extra_args(false);
        command
            .add_option("--jobs", jobs_,
                        "Processes that share the views of --all-cameras and --tiers, 1 to 256. Default: as many as "
                        "this machine has processors")
            ->type_name("N")
            ->check(CLI::Range(1, 256).description(""));
        command
            .add_option("--part", part_,
                        "Of the views of --all-cameras and --tiers, count every PARTS-th from PART on, for several "
                        "machines")
            ->type_name("PART/PARTS");
        command
            .add_option("--budget", budget_,
                        "Budget by name or .json file that is held against modelled times, counters and memory; none: "
                        "no budget. Exit code 1 when a limit of level error is exceeded")
            ->type_name("NAME|FILE|none")
            ->capture_default_str();
        command.add_flag("--json", json_,
                         "Standard output is one JSON value (content/schemas/cost.schema.json; of a shader "
                         "shader_cost.schema.json; of several views a list of the former)");
        command.add_option("--csv", csv_, "Also write one line for each device and pass")->type_name("FILE");
        command.add_option("--html", html_, "Also write one self-contained HTML page")->type_name("FILE");
        command
            .add_option(
                "--trace", trace_,
                "Also write a trace that Perfetto opens: a process for each device, one for what is measured here")
            ->type_name("FILE");
        command
            .add_option("--refresh-tables", tables_,
                        "Instead of a scene: write the counts of every effect's shaders into this file "
                        "(content/costs/effects.json) and the prices of effects in the built-in scenes beside it "
                        "(prices.json); tests compare both with the shaders")
            ->type_name("FILE");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "cost"; }

    int run() override {
        if (!tables_.empty()) return refresh_tables();
        if (input_.empty()) throw Error(Fault::usage, "cost: name a SCENE or a shader; see halfframe cost --help");
        check_options(options_);
        for (const std::string& profile : profiles_) loaded_.push_back(cost::load_profile(profile));
        if (loaded_.empty()) loaded_ = cost::built_in_profiles();
        check_profiles();
        for (const std::string& file : {csv_, trace_, html_})
            if (!file.empty()) perf::expect_can_write(file);
        if (input_.ends_with(".frag") || input_.ends_with(".glsl")) return run_shader();
        for (const char* other : {".vert", ".vs", ".geom", ".comp"})
            if (input_.ends_with(other))
                throw Error(Fault::usage, input_ +
                                              ": only fragment shaders (.frag, .glsl) are priced alone; the vertex "
                                              "stage of a scene is in the cost of its passes");
        if (!textures_.empty()) throw Error(Fault::usage, "--texture belongs to a shader; SCENE is a scene");
        if (budget_ != "none") loaded_budget_ = content::budget(budget_);
        return all_cameras_ || !tiers_.empty() ? run_views() : run_scene();
    }

private:
    /// The priced arithmetic: half unless full was asked for, whatever runs fast here.
    [[nodiscard]] gl::Arithmetic arithmetic() const {
        return options_.arithmetic == "full" ? gl::Arithmetic::full : gl::Arithmetic::half;
    }

    /// Reports find devices by name.
    void check_profiles() const {
        std::set<std::string> names;
        for (const cost::Profile& profile : loaded_)
            if (!names.insert(profile.name).second)
                throw Error(Fault::usage, fmt::format("--profile: two devices are called {}; give one of the files "
                                                      "another name",
                                                      profile.name));
    }

    int refresh_tables() const {
        Progress progress;
        const auto between = [&progress](const std::string& step) {
            stop_if_interrupted();
            progress.show(step);
        };
        const std::filesystem::path prices = std::filesystem::path(tables_).parent_path() / "prices.json";
        perf::expect_can_write(tables_);
        perf::expect_can_write(prices);
        between("counting shaders");
        const std::string effects = cost::effect_table_text();
        perf::write_file(tables_, effects);
        perf::write_file(prices, price_table(effects, jobs(), options_.cache, between));
        return 0;
    }

    [[nodiscard]] int jobs() const {
        return jobs_ ? *jobs_ : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    }

    [[nodiscard]] CostRequest request(const std::function<void(const std::string&)>& between) const {
        return {
            .input = input_, .options = options_, .profiles = loaded_, .arithmetic = arithmetic(), .between = between};
    }

    int run_scene() {
        Progress progress;
        const auto between = [&progress](const std::string& step) {
            stop_if_interrupted();
            progress.show(step);
        };
        if (!part_.empty()) throw Error(Fault::usage, "--part shares out the views of --all-cameras or --tiers");
        std::optional<cost::MeasuredPasses> measured;
        if (!trace_.empty()) {
            between("measuring");
            measured = measured_here();
        }
        between("starting");
        ViewCounter counter(request(between));
        if (!why_.empty()) {
            const cost::CountedFrame frame = counter.counted({});
            const std::string text = cost::why_text(frame, counter.library(), arithmetic(), why_);
            progress.clear();
            print(text);
            return 0;
        }
        const cost::FrameCost cost = counter.cost_of({});
        const std::optional<perf::BudgetTable> budget = judged(cost, loaded_budget_);
        progress.clear();
        if (!csv_.empty()) perf::write_file(csv_, cost::csv_of(nlohmann::ordered_json::array({cost::cost_json(cost)})));
        if (!trace_.empty()) perf::write_file(trace_, cost::cost_trace(cost, measured).dump() + "\n");
        if (!html_.empty()) write_page(cost, budget);
        if (json_) print_json(json_of(cost, budget));
        else print(cost::cost_text(cost, budget ? &*budget : nullptr));
        return budget ? budget_verdict(*budget, cost.title()) : 0;
    }

    static nlohmann::ordered_json json_of(const cost::FrameCost& cost, const std::optional<perf::BudgetTable>& budget) {
        nlohmann::ordered_json json = cost::cost_json(cost);
        if (budget) json["budget"] = perf::budget_json(*budget);
        return json;
    }

    void write_page(const cost::FrameCost& cost, const std::optional<perf::BudgetTable>& budget) const {
        perf::FrameReport report = cost::report_of(cost);
        report.reproduce = "halfframe cost " + shell_quoted(input_) + options_text(options_) + own_options_text();
        const perf::BudgetTable table = budget ? *budget : perf::budget_table(report, {.name = "none"}, false);
        perf::write_file(html_, perf::html_page({{&report, &table}}));
    }

    [[nodiscard]] std::string own_options_text() const {
        std::string text;
        for (const std::string& profile : profiles_) text += " --profile " + shell_quoted(profile);
        if (budget_ != kDefaultBudget) text += " --budget " + shell_quoted(budget_);
        return text;
    }

    /// Every view in this process, or shared out among several.
    int run_views() {
        if (!why_.empty() || !trace_.empty() || !html_.empty())
            throw Error(Fault::usage, "--why, --trace and --html are of one view: leave out --all-cameras and --tiers");
        if (all_cameras_ && (!options_.camera.empty() || !options_.eye.empty()))
            throw Error(Fault::usage,
                        "--all-cameras stands for every camera of the scene: leave out --camera and --eye");
        Progress progress;
        const auto between = [&progress](const std::string& step) {
            stop_if_interrupted();
            progress.show(step);
        };
        const int processes = part_.empty() ? jobs() : 1;
        nlohmann::ordered_json views = nlohmann::ordered_json::array();
        const int code = processes > 1 ? views_of_children(processes, between, views) : views_of_ours(between, views);
        progress.clear();
        if (!csv_.empty()) perf::write_file(csv_, cost::csv_of(views));
        if (json_) print_json(views);
        else print(cost::overview_text(views));
        return code;
    }

    int views_of_ours(const std::function<void(const std::string&)>& between, nlohmann::ordered_json& views) {
        const Part part = part_.empty() ? Part{} : parse_part(part_);
        between("starting");
        ViewCounter counter(request(between));
        const std::vector<std::string> cameras = all_cameras_ ? counter.cameras() : std::vector<std::string>{""};
        std::vector<CostView> wanted;
        for (const std::string& tier : tiers_.empty() ? std::vector<std::string>{""} : tiers_)
            for (const std::string& camera : cameras)
                wanted.push_back({camera, tier.empty() ? std::vector<std::string>{} : std::vector<std::string>{tier}});
        int code = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (!part.takes(i)) continue;
            const auto step = [&](const std::string& words) {
                between(fmt::format("view {} of {}: {}", i + 1, wanted.size(), words));
            };
            counter.between(step);
            const cost::FrameCost cost = counter.cost_of(wanted[i]);
            const std::optional<perf::BudgetTable> budget = judged(cost, loaded_budget_);
            if (budget) code = std::max(code, budget_verdict(*budget, cost.title() + ", " + name_of(cost.plan.tier)));
            views.push_back(json_of(cost, budget));
        }
        return code;
    }

    static std::string name_of(Tier tier) { return halfframe::name(tier); }

    int views_of_children(int processes, const std::function<void(const std::string&)>& between,
                          nlohmann::ordered_json& views) const {
        std::vector<std::vector<std::string>> children;
        for (int part = 1; part <= processes; ++part) {
            std::vector<std::string> words{"cost", input_, "--json", "--part", fmt::format("{}/{}", part, processes)};
            const std::vector<std::string> options = option_words(options_);
            words.insert(words.end(), options.begin(), options.end());
            if (!options_.cache.empty()) words.insert(words.end(), {"--cache", options_.cache});
            for (const std::string& profile : profiles_) words.insert(words.end(), {"--profile", profile});
            words.insert(words.end(), {"--budget", budget_});
            if (all_cameras_) words.emplace_back("--all-cameras");
            if (!tiers_.empty()) words.insert(words.end(), {"--tiers", fmt::format("{}", fmt::join(tiers_, ","))});
            children.push_back(std::move(words));
        }
        const ChildOutputs made = outputs_of_own(children, between);
        complain(made.errors);
        std::vector<nlohmann::ordered_json> parts;
        for (const std::string& output : made.outputs) parts.push_back(nlohmann::ordered_json::parse(output));
        // The first part has the first view, the second the second, and so on.
        for (std::size_t row = 0; row < parts.front().size(); ++row)
            for (const nlohmann::ordered_json& part : parts)
                if (row < part.size()) views.push_back(part[row]);
        return made.exceeded ? 1 : 0;
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

    int run_shader() {
        if (!why_.empty() && why_ != "shader")
            throw Error(Fault::usage, "--why " + why_ + ": a shader is one pass, called shader");
        if (!trace_.empty() || !html_.empty() || all_cameras_ || !tiers_.empty())
            throw Error(Fault::usage,
                        "--trace, --html, --all-cameras and --tiers are of a scene's frame; a shader has one pass");
        const std::string text(std::string_view(content::read_regular_file(input_, kMostShaderBytes, input_)));
        cost::UserShaderRequest request{.file = input_, .text = text, .profiles = loaded_};
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

    static constexpr const char* kDefaultBudget = "ps3_30fps";

    std::string input_;
    SceneOptions options_;
    std::vector<cost::Profile> loaded_;
    std::optional<Budget> loaded_budget_;
    std::string budget_ = kDefaultBudget;
    std::vector<std::string> tiers_;
    std::optional<int> jobs_;
    std::string part_;
    std::string html_;
    bool all_cameras_ = false;
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
