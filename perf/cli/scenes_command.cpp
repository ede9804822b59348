// halfframe scenes: the built-in ones.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "perf/cli/command.h"
#include "perf/cli/terminal.h"
#include "perf/report/text_table.h"

namespace halfframe::cli {
namespace {

class ScenesCommand : public Command {
public:
    explicit ScenesCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand("scenes", "Lists the built-in scenes, which need no file");
        command.add_flag("--json", json_, "Standard output is one JSON value");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "scenes"; }

    int run() override {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        perf::TextTable table({{"scene"}, {"purpose"}});
        for (const content::BuiltInScene& scene : content::built_in_scenes()) {
            all.push_back({{"name", scene.name}, {"purpose", scene.purpose}});
            table.add_row({std::string(scene.name), std::string(scene.purpose)});
        }
        if (json_) {
            print_json(all);
        } else {
            print(table.text());
        }
        return 0;
    }

private:
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_scenes_command(CLI::App& app) { return std::make_unique<ScenesCommand>(app); }

}  // namespace halfframe::cli
