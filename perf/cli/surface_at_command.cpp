// halfframe surface-at SCENE X Z: what lies under a place, and how wet it is.
#include <cmath>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/effects/wet_surface/surface_at.h"
#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/scene_settings.h"
#include "perf/cli/terminal.h"

namespace halfframe::cli {
namespace {

class SurfaceAtCommand : public Command {
public:
    explicit SurfaceAtCommand(CLI::App& app) {
        CLI::App& command =
            *app.add_subcommand("surface-at",
                                "Says what a foot would step on at X, Z: material, height, dry, wet or puddle and how "
                                "deep; draws nothing");
        command.add_option("SCENE", scene_, "A .gltf or .glb file, or a built-in scene (halfframe scenes)")->required();
        command.add_option("X", x_, "Metres along the world's X")->required();
        command.add_option("Z", z_, "Metres along the world's Z")->required();
        command.add_option("--below", below_, "Only what lies below this height [m]; default: the highest")
            ->type_name("Y");
        command
            .add_option("--set", settings_, "Change the scene first; repeatable: wet.level=N, puddles.level=N (0 to 1)")
            ->type_name("KEY=VALUE")
            ->allow_extra_args(false);
        command.add_flag("--json", json_, "Standard output is one JSON value");
        command.footer(kExitCodes);

    }

    [[nodiscard]] std::string name() const override { return "surface-at"; }

    int run() override {
        std::vector<Setting> settings;
        for (const std::string& text : settings_) settings.push_back(parse_setting(text));
        const float x = parse_number(x_, "X"), z = parse_number(z_, "Z");
        const float below = below_.empty() ? 1e30f : parse_number(below_, "--below");
        Scene scene = content::open_scene(scene_);
        View view;
        Wishes wishes;
        for (const Setting& setting : settings) apply(setting, scene, view, wishes);
        const GroundQuery query(scene);
        const std::optional<SurfaceAt> found = query.surface_at({x, below, z});
        if (json_) {
            print_json(found ? json_of(scene, *found) : nlohmann::ordered_json(nullptr));
        } else if (!found) {
            print("nothing lies there\n");
        } else {
            print(text_of(scene, *found));
        }
        return 0;
    }

private:
    static const std::string& material_name(const Scene& scene, const SurfaceAt& at) {
        return scene.materials[static_cast<std::size_t>(at.material)].name;
    }

    static nlohmann::ordered_json json_of(const Scene& scene, const SurfaceAt& at) {
        return {{"footing", halfframe::name(at.footing)},
                {"material", material_name(scene, at)},
                {"surface", scene.surfaces[static_cast<std::size_t>(at.surface)].name},
                {"height_m", at.height_m},
                {"puddle_depth_m", at.puddle_depth_m},
                {"open", at.open},
                {"wetness", at.wetness},
                {"puddle", at.puddle}};
    }

    static std::string text_of(const Scene& scene, const SurfaceAt& at) {
        std::string text = fmt::format("{} at {:.3f} m: {}", material_name(scene, at), at.height_m,
                                       halfframe::name(at.footing));
        if (at.footing == Footing::puddle) text += fmt::format(", {:.1f} mm deep", 1000.0f * at.puddle_depth_m);
        return text + fmt::format(" (wetness {:.2f}, open water {:.2f}, open to the rain {:.2f})\n", at.wetness,
                                  at.puddle, at.open);
    }

    std::string scene_;
    std::string x_, z_;  ///< text: numbers may be negative
    std::string below_;
    std::vector<std::string> settings_;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_surface_at_command(CLI::App& app) { return std::make_unique<SurfaceAtCommand>(app); }

}  // namespace halfframe::cli
