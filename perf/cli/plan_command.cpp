// halfframe plan SCENE: the frame as data, without drawing it.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/frame/effect_card.h"
#include "perf/cli/command.h"
#include "perf/cli/scene_fit.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/terminal.h"
#include "perf/report/json_report.h"
#include "perf/report/text_report.h"
#include "perf/report/text_table.h"

namespace halfframe::cli {
namespace {

class PlanCommand : public Command {
public:
    explicit PlanCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand("plan",
                                                "Shows the passes, targets and memory of a frame, what it is estimated "
                                                "to cost, and why each effect is in or out; "
                                                "draws nothing");
        command.add_option("SCENE", scene_, "A .gltf or .glb file, or a built-in scene (halfframe scenes)")->required();
        add_scene_options(command, options_);
        command.add_flag(
            "--json", json_,
            "Standard output is one JSON value (content/schemas/plan.schema.json); everything else goes to "
            "standard error");
        command.footer(
            std::string("A context is needed all the same, to read what the device can do. Exit code 1: the plan "
                        "breaks a rule.\n") +
            kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "plan"; }

    int run() override {
        check_options(options_);
        GraphicsDevice device(options_.device);
        Progress progress;
        const auto between = [&](const std::string& step) {
            stop_if_interrupted();
            progress.show(step);
        };
        const OpenedScene opened = open_with_options(scene_, options_, device.caps(), between);
        progress.clear();
        const FramePlan plan = plan_frame(opened.scene, opened.view, opened.wishes, device.caps(), all_effects());
        const std::optional<std::string> broken = broken_rule(plan, device.caps());
        const CostTable table = content::cost_table();
        stop_if_interrupted();
        for (const std::vector<std::string>* notices : {&opened.scene.notices, &plan.notices}) {
            for (const std::string& sentence : *notices) {
                notice(sentence);
            }
        }
        if (json_) {
            nlohmann::ordered_json json = perf::plan_json(plan);
            json["device"] = device.caps().device;
            json["renderer"] = device.caps().renderer;
            json["animations"] = nlohmann::ordered_json::array();
            for (const Animation& animation : opened.scene.animations) {
                json["animations"].push_back({{"name", animation.name}, {"duration_s", animation.duration_s}});
            }
            json["estimate"] = estimate_json(plan, table, priced());
            json["broken_rule"] = broken ? nlohmann::ordered_json(*broken) : nlohmann::ordered_json(nullptr);
            print_json(json);
        } else {
            print(perf::plan_text(plan) + "\n" + estimate_text(plan, table, priced()) + "\n" +
                  animations_text(opened.scene) + (broken ? "broken rule: " + *broken : "no rule is broken") + "\n");
        }
        return broken ? 1 : 0;
    }

private:
    /// Half unless full was asked for, whatever runs fast here.
    [[nodiscard]] Arithmetic priced() const {
        return options_.arithmetic == "full" ? Arithmetic::full : Arithmetic::half;
    }

    static std::string animations_text(const Scene& scene) {
        if (scene.animations.empty()) {
            return {};
        }
        perf::TextTable table({{"animation"}, {"name"}, {"s"}});
        for (std::size_t i = 0; i < scene.animations.size(); ++i) {
            table.add_row(
                {std::to_string(i), scene.animations[i].name, fmt::format("{:.3f}", scene.animations[i].duration_s)});
        }
        return table.text() + "\n";
    }

    std::string scene_;
    SceneOptions options_;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_plan_command(CLI::App& app) { return std::make_unique<PlanCommand>(app); }

}  // namespace halfframe::cli
