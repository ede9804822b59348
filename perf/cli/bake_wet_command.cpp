// halfframe bake-wet SCENE: a scene whose wetness is written into its textures, as a GLB file.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "engine/effects/wet_surface/wet_bake.h"
#include "engine/effects/wet_surface/wet_surface.h"
#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/glb_output.h"
#include "perf/cli/scene_settings.h"
#include "perf/cli/terminal.h"

namespace halfframe::cli {
namespace {

class BakeWetCommand : public Command {
public:
    explicit BakeWetCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "bake-wet",
            "Writes a scene as a GLB file whose wetness is in its textures, so that it costs a frame nothing; what has "
            "its mask in vertices stays live");
        output_.add_options(command);
        command
            .add_option("--set", settings_,
                        "Change the scene first; repeatable: wet.level=N (0 to 1), puddles.level=N, wet.rain_ended_s=N "
                        "and the other keys of render. Drying is written as it stands")
            ->type_name("KEY=VALUE")
            ->allow_extra_args(false);
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "bake-wet"; }

    int run() override {
        std::vector<Setting> settings;
        for (const std::string& text : settings_) settings.push_back(parse_setting(text));
        output_.expect_can_write();
        Scene scene = content::open_scene(output_.scene, output_.options);
        View view;
        Wishes wishes;
        for (const Setting& setting : settings) apply(setting, scene, view, wishes);
        for (const std::string& sentence : scene.notices) notice(sentence);
        const WetLevels levels = wet_levels(scene);
        if (levels.diffuse <= 0.0f && levels.specular <= 0.0f) {
            throw Error(Fault::usage,
                        fmt::format("{} is dry; say how wet it is with --set wet.level=0.5 (0 to 1)", output_.scene));
        }
        scene.wetness->is_static = true;
        const int written = tell_paths(scene);
        const Scene baked = with_written_wetness(scene);
        output_.write(baked);
        print(fmt::format("{}: wetness {:.2f} is in the textures of {} material{}, {} new images\n", output_.file,
                          levels.diffuse, written, written == 1 ? "" : "s", baked.images.size() - scene.images.size()));
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

    GlbOutput output_;
    std::vector<std::string> settings_;
};

}  // namespace

std::unique_ptr<Command> make_bake_wet_command(CLI::App& app) { return std::make_unique<BakeWetCommand>(app); }

}  // namespace halfframe::cli
