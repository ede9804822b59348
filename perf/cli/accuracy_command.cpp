// halfframe accuracy: how far shader functions are from their references, what each arithmetic and each storage adds,
// and how far whole frames move when nothing should.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "perf/accuracy/accuracy_report.h"
#include "perf/accuracy/depth_accuracy.h"
#include "perf/accuracy/error_map.h"
#include "perf/accuracy/frame_accuracy.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/lane_canvas.h"
#include "perf/accuracy/measure.h"
#include "perf/accuracy/model_list.h"
#include "perf/accuracy/storage_accuracy.h"
#include "perf/cli/command.h"
#include "perf/cli/graphics_device.h"
#include "perf/cli/spelling.h"
#include "perf/cli/terminal.h"
#include "perf/measure/precision_probe.h"
#include "perf/report/lettering.h"
#include "perf/report/picture_file.h"

namespace halfframe::cli {
namespace {

bool holds(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// The functions of the effects named, of all when none is.
std::vector<accuracy::FunctionEntry> chosen(const std::vector<std::string>& effects) {
    std::vector<std::string> built;
    for (const EffectCard* card : all_effects()) built.emplace_back(card->name);
    for (const std::string& effect : effects) {
        if (!holds(built, effect)) throw Error(Fault::usage, unknown("effect", effect, built));
    }
    std::vector<accuracy::FunctionEntry> list;
    for (const accuracy::FunctionEntry& entry : accuracy::function_list()) {
        if (effects.empty() || holds(effects, entry.effect)) list.push_back(entry);
    }
    return list;
}

class AccuracyCommand : public Command {
public:
    explicit AccuracyCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "accuracy",
            "Measures shader functions: how far each is from its reference, what float, half, the ES minimum and the "
            "context here add, and what each storage of scene_color does to light. --frames: whole pictures instead");
        CLI::Option* effects = command.add_option("EFFECT", effects_, "Effects to measure; without one, all");
        command
            .add_flag("--frames", frames_,
                      "Draw the test room far from the origin, in other units, under other lights, from odd eyes and "
                      "in odd sizes, at every tier, and compare")
            ->excludes(effects);
        command
            .add_option("--scenes", scenes_,
                        "Of --frames: these scenes, built in or glTF files, or all that are built in, instead of the "
                        "test room's own longer list")
            ->type_name("NAME|FILE|all ...")
            ->needs("--frames");
        command.add_flag("--json", json_, "Standard output is one JSON value");
        command
            .add_option("--maps", maps_,
                        "Also write a .png with a map for each model: where it is too bright (red) or too dark (blue)")
            ->type_name("FILE");
        add_device_options(command, device_);
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "accuracy"; }

    int run() override {
        const std::vector<accuracy::FunctionEntry> entries = chosen(effects_);
        accuracy::AccuracyReport report;
        std::optional<GraphicsDevice> device;
        open(device, report.here);
        Progress progress;
        if (frames_) {
            measure_frames(*device, progress, report);
        } else {
            measure_functions(entries, device, progress, report);
            measure_models(progress, report);
        }
        progress.clear();
        if (!maps_.empty()) write_maps(report.models);
        if (json_) {
            print_json(accuracy::accuracy_json(report));
        } else {
            print(accuracy::accuracy_text(report));
        }
        return report.violations().empty() ? 0 : static_cast<int>(Fault::check);
    }

private:
    /// Opens the device, or says why its figures are missing. One asked for by name must start, and frames need one.
    void open(std::optional<GraphicsDevice>& device, accuracy::Here& here) const {
        try {
            device.emplace(device_);
        } catch (const platform::ContextError& error) {
            if (frames_ || device_.context != "auto") throw;
            here.missing = error.what();
            return;
        }
        const gl::Caps& caps = device->caps();
        here.driver = fmt::format("{}, {}; {}", caps.renderer, device->context().description(),
                                  perf::probe_precision(device->gl(), caps).sentence);
        here.missing = accuracy::LaneCanvas::obstacle(caps);
        if (frames_ && !here.missing.empty()) {
            throw Error(Fault::usage, "frames are counted in RGBA32F targets, and here " + here.missing +
                                          "; leave --device out or try another --context");
        }
    }

    void measure_models(Progress& progress, accuracy::AccuracyReport& report) const {
        for (const accuracy::ModelEntry& entry : accuracy::model_list()) {
            if (!effects_.empty() && !holds(effects_, entry.effect)) continue;
            stop_if_interrupted();
            progress.show(entry.effect + ", " + entry.model);
            report.models.push_back(accuracy::measure(entry));
        }
    }

    void write_maps(const std::vector<accuracy::ModelAccuracy>& models) const {
        if (models.empty()) {
            throw Error(Fault::usage,
                        "--maps: the effects named have no models to map; without a name, all are measured");
        }
        constexpr int kLetters_px = 16;
        perf::write_png(maps_, accuracy::error_maps(models, perf::Lettering(perf::find_font(), kLetters_px)));
    }

    [[nodiscard]] std::vector<accuracy::FrameCase> chosen_frames() const {
        if (scenes_.empty()) return accuracy::frame_cases();
        std::vector<std::string> names = scenes_;
        if (holds(scenes_, "all")) {
            names.clear();
            for (const content::BuiltInScene& scene : content::built_in_scenes()) names.emplace_back(scene.name);
        }
        std::vector<accuracy::FrameCase> pairs;
        for (const std::string& name : names) {
            const Scene scene = content::open_scene(name);
            if (scene.surfaces.empty()) continue;  // nothing to compare
            const std::vector<accuracy::FrameCase> more = accuracy::scene_cases(scene);
            pairs.insert(pairs.end(), more.begin(), more.end());
        }
        return pairs;
    }

    void measure_frames(GraphicsDevice& device, Progress& progress, accuracy::AccuracyReport& report) const {
        accuracy::FrameBench bench(device.gl(), device.caps());
        for (const accuracy::FrameCase& pair : chosen_frames()) {
            for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
                for (const Arithmetic arithmetic : {Arithmetic::full, Arithmetic::half}) {
                    stop_if_interrupted();
                    progress.show(
                        fmt::format("{}, {} {}", pair.change, halfframe::name(tier), halfframe::name(arithmetic)));
                    report.frames.push_back(bench.measure(pair, tier, arithmetic));
                }
            }
        }
    }

    void measure_functions(const std::vector<accuracy::FunctionEntry>& entries, std::optional<GraphicsDevice>& device,
                           Progress& progress, accuracy::AccuracyReport& report) const {
        const bool draws = device && report.here.missing.empty();
        const perf::PrecisionProbe probe =
            draws ? perf::probe_precision(device->gl(), device->caps()) : perf::PrecisionProbe{};
        for (const accuracy::FunctionEntry& entry : entries) {
            stop_if_interrupted();
            progress.show(entry.effect + "." + entry.function);
            report.functions.push_back(accuracy::measure(entry));
            if (draws) accuracy::measure_here(report.functions.back(), device->gl(), device->caps(), probe);
        }
        if (!draws) return;
        stop_if_interrupted();
        progress.show("storage");
        const auto measured = [&](const char* effect) {
            return find_effect(effect) != nullptr && (effects_.empty() || holds(effects_, effect));
        };
        if (effects_.empty()) {
            report.storage = accuracy::measure_storage(device->gl(), device->caps());
        } else if (measured("transparent")) {  // what light itself loses in storage belongs to no effect
            constexpr std::array kPanes{accuracy::StoredSource::panes};
            report.storage = accuracy::measure_storage(device->gl(), device->caps(), kPanes);
        }
        if (measured("depth_prepass")) report.depth = accuracy::measure_depth(device->gl(), device->caps());
    }

    std::vector<std::string> effects_;
    bool frames_ = false;
    std::vector<std::string> scenes_;
    bool json_ = false;
    DeviceOptions device_;
    std::string maps_;
};

}  // namespace

std::unique_ptr<Command> make_accuracy_command(CLI::App& app) { return std::make_unique<AccuracyCommand>(app); }

}  // namespace halfframe::cli
