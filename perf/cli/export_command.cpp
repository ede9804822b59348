// halfframe export SCENE: a scene as a GLB file.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/terminal.h"
#include "perf/report/atomic_file.h"

namespace halfframe::cli {
namespace {

class ExportCommand : public Command {
public:
    explicit ExportCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "export",
            "Writes a scene as one GLB file that loads back to the same frame, moving or at rest, with what glTF has no word for "
            "in extras");
        command.add_option("SCENE", scene_, "A .gltf or .glb file, or a built-in scene (halfframe scenes)")->required();
        command.add_option("-o,--output", output_, "The file to write; its name ends in .glb")
            ->type_name("FILE")
            ->required();
        command.add_option("--gltf-scene", options_.scene, "Scene of a file that has several, by name or number")
            ->type_name("NAME|N");
        command
            .add_option("--variant", options_.variant, "Material variant of a file that has some, by name or number")
            ->type_name("NAME|N");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "export"; }

    int run() override {
        if (!output_.ends_with(".glb")) {
            throw Error(Fault::usage, fmt::format("-o {}: the name must end in .glb", output_));
        }
        perf::expect_can_write(output_);
        const Scene scene = content::open_scene(scene_, options_);
        for (const std::string& sentence : scene.notices) notice(sentence);
        for (const std::string& sentence : content::not_exported(scene)) notice(sentence);
        perf::write_file(output_, content::gltf_binary(scene));
        return 0;
    }

private:
    std::string scene_;
    std::string output_;
    content::LoadOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_export_command(CLI::App& app) { return std::make_unique<ExportCommand>(app); }

}  // namespace halfframe::cli
