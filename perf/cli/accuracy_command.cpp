// halfframe accuracy: how far shader functions are from their references, and what each arithmetic adds.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "perf/accuracy/accuracy_report.h"
#include "perf/accuracy/error_map.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/measure.h"
#include "perf/accuracy/model_list.h"
#include "perf/cli/command.h"
#include "perf/cli/spelling.h"
#include "perf/cli/terminal.h"
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
    std::vector<std::string> measured;
    std::vector<accuracy::FunctionEntry> list;
    for (const accuracy::FunctionEntry& entry : accuracy::function_list()) {
        if (!holds(measured, entry.effect)) measured.push_back(entry.effect);
        if (effects.empty() || holds(effects, entry.effect)) list.push_back(entry);
    }
    for (const std::string& effect : effects) {
        if (!holds(built, effect)) throw Error(Fault::usage, unknown("effect", effect, built));
        if (!holds(measured, effect)) {
            throw Error(Fault::usage, fmt::format("effect '{}' has no plain shader function to measure; these have: {}",
                                                  effect, fmt::join(measured, ", ")));
        }
    }
    return list;
}

class AccuracyCommand : public Command {
public:
    explicit AccuracyCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "accuracy",
            "Measures shader functions on the CPU: how far each is from its reference, and what float, half and the ES "
            "minimum add");
        command.add_option("EFFECT", effects_, "Effects to measure; without one, all that have such functions");
        command.add_flag("--json", json_, "Standard output is one JSON value");
        command.add_option("--maps", maps_,
                           "Also write a .png with a map for each model: where it is too bright (red) or too dark "
                           "(blue)");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "accuracy"; }

    int run() override {
        const std::vector<accuracy::FunctionEntry> entries = chosen(effects_);
        std::vector<accuracy::FunctionAccuracy> functions;
        bool sound = true;
        Progress progress;
        for (const accuracy::FunctionEntry& entry : entries) {
            stop_if_interrupted();
            progress.show(entry.effect + "." + entry.function);
            functions.push_back(accuracy::measure(entry));
            sound = sound && functions.back().violations.empty();
        }
        std::vector<accuracy::ModelAccuracy> models;
        for (const accuracy::ModelEntry& entry : accuracy::model_list()) {
            if (!effects_.empty() && !holds(effects_, entry.effect)) continue;
            stop_if_interrupted();
            progress.show(entry.effect + ", " + entry.model);
            models.push_back(accuracy::measure(entry));
            sound = sound && models.back().violations.empty();
        }
        progress.clear();
        if (!maps_.empty()) write_maps(models);
        if (json_) {
            print_json(accuracy::accuracy_json(functions, models));
        } else {
            print(accuracy::accuracy_text(functions));
            print(accuracy::models_text(models));
        }
        return sound ? 0 : static_cast<int>(Fault::check);
    }

private:
    void write_maps(const std::vector<accuracy::ModelAccuracy>& models) const {
        if (models.empty()) {
            throw Error(Fault::usage,
                        "--maps: the effects named have no models to map; without a name, all are measured");
        }
        perf::write_png(maps_, accuracy::error_maps(models));
    }

    std::vector<std::string> effects_;
    bool json_ = false;
    std::string maps_;
};

}  // namespace

std::unique_ptr<Command> make_accuracy_command(CLI::App& app) { return std::make_unique<AccuracyCommand>(app); }

}  // namespace halfframe::cli
