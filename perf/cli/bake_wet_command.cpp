// halfframe bake-wet SCENE: a scene whose wetness is written into its textures, as a GLB file.
#include <algorithm>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "content/content.h"
#include "engine/effects/wet_surface/wet_bake.h"
#include "engine/effects/wet_surface/wet_surface.h"
#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/scene_settings.h"
#include "perf/cli/terminal.h"
#include "perf/report/atomic_file.h"

namespace halfframe::cli {
namespace {

class BakeWetCommand : public Command {
public:
    explicit BakeWetCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "bake-wet",
            "Writes a scene as a GLB file whose wetness is in its textures, so that it costs a frame nothing; what has "
            "its mask in vertices stays live");
        command.add_option("SCENE", scene_, "A .gltf or .glb file, or a built-in scene (halfframe scenes)")->required();
        command.add_option("-o,--output", output_, "The file to write; its name ends in .glb")
            ->type_name("FILE")
            ->required();
        command
            .add_option("--set", settings_,
                        "Change the scene first; repeatable: wet.level=N (0 to 1), puddles.level=N, wet.rain_ended_s=N "
                        "and the other keys of render. Drying is written as it stands")
            ->type_name("KEY=VALUE")
            ->allow_extra_args(false);
        command.add_option("--gltf-scene", options_.scene, "Scene of a file that has several, by name or number")
            ->type_name("NAME|N");
        command
            .add_option("--variant", options_.variant, "Material variant of a file that has some, by name or number")
            ->type_name("NAME|N");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "bake-wet"; }

    int run() override {
        if (!output_.ends_with(".glb")) throw Error(Fault::usage, fmt::format("-o {}: the name must end in .glb", output_));
        std::vector<Setting> settings;
        for (const std::string& text : settings_) settings.push_back(parse_setting(text));
        perf::expect_can_write(output_);
        Scene scene = content::open_scene(scene_, options_);
        View view;
        Wishes wishes;
        for (const Setting& setting : settings) apply(setting, scene, view, wishes);
        for (const std::string& sentence : scene.notices) notice(sentence);
        const WetLevels levels = wet_levels(scene);
        if (levels.diffuse <= 0.0f && levels.specular <= 0.0f) {
            throw Error(Fault::usage,
                        fmt::format("{} is dry; say how wet it is with --set wet.level=0.5 (0 to 1)", scene_));
        }
        scene.wetness->is_static = true;
        const int written = tell_paths(scene);
        const Scene baked = with_written_wetness(scene);
        for (const std::string& sentence : content::not_exported(baked)) notice(sentence);
        perf::write_file(output_, content::gltf_binary(baked));
        print(fmt::format("{}: wetness {:.2f} is in the textures of {} material{}, {} new images\n", output_,
                          levels.diffuse, written, written == 1 ? "" : "s",
                          baked.images.size() - scene.images.size()));
        return 0;
    }

private:
    /// A notice for each material that stays live; returns how many are written.
    static int tell_paths(const Scene& scene) {
        int written = 0;
        for (const Material& material : scene.materials) {
            const WaterDecision decision = water_decision(scene, material);
            written += decision.path == WaterPath::written;
            if (decision.path == WaterPath::live)
                notice(fmt::format("{} stays live because {}", material.name, decision.why));
        }
        return written;
    }

    std::string scene_;
    std::string output_;
    std::vector<std::string> settings_;
    content::LoadOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_bake_wet_command(CLI::App& app) { return std::make_unique<BakeWetCommand>(app); }

}  // namespace halfframe::cli
