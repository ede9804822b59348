// halfframe export SCENE: a scene as a GLB file.
#include <CLI/CLI.hpp>

#include "perf/cli/command.h"
#include "perf/cli/glb_output.h"
#include "perf/cli/terminal.h"

namespace halfframe::cli {
namespace {

class ExportCommand : public Command {
public:
    explicit ExportCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand("export",
                                                "Writes a scene as one GLB file that loads back to the same frame, "
                                                "moving or at rest, with what glTF has no word for "
                                                "in extras");
        output_.add_options(command);
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "export"; }

    int run() override {
        output_.expect_can_write();
        const Scene scene = content::open_scene(output_.scene, output_.options);
        for (const std::string& sentence : scene.notices) notice(sentence);
        output_.write(scene);
        return 0;
    }

private:
    GlbOutput output_;
};

}  // namespace

std::unique_ptr<Command> make_export_command(CLI::App& app) { return std::make_unique<ExportCommand>(app); }

}  // namespace halfframe::cli
