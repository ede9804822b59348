// halfframe stability: where half precision breaks, for every shader function and for functions of a user's own.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "perf/accuracy/lane_canvas.h"
#include "perf/cli/cache_folder.h"
#include "perf/cli/command.h"
#include "perf/cli/graphics_device.h"
#include "perf/cli/spelling.h"
#include "perf/cli/terminal.h"
#include "perf/report/atomic_file.h"
#include "perf/report/picture_file.h"
#include "perf/stability/argument_census.h"
#include "perf/stability/kept_results.h"
#include "perf/stability/ledger.h"
#include "perf/stability/stability_report.h"

namespace halfframe::cli {
namespace {

using stability::Declaration;

std::string folder_of(const Declaration& function) { return function.file.substr(0, function.file.find('/')); }

void make_folder(const std::string& folder) {
    std::error_code fault;
    std::filesystem::create_directories(folder, fault);
    if (fault) throw Error(Fault::environment, fmt::format("{} cannot be made: {}", folder, fault.message()));
}

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(Fault::input, fmt::format("{} cannot be read; give the path of a .glsl file", path));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

class StabilityCommand : public Command {
public:
    explicit StabilityCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "stability",
            "Tries shader functions with every half, every combination of hard cases and a search, in five precisions "
            "and on the context here, and holds them to what is declared beside each");
        command.add_option("WHAT", wanted_,
                           "Effects, functions, or one .glsl, .frag or .vert file of your own; without one, all of shaders_es and the "
                           "exhibit of listings that break");
        command.add_option("--function", function_, "Of your own file: the function to try; without it, all of them")
            ->type_name("NAME");
        command
            .add_option("--domain", domain_,
                        "Of that function: its inputs, as in \"x: 0..1; n: unit\"; replaces what the file declares")
            ->type_name("TEXT");
        command.add_flag("--full", full_,
                         "Up to ten million combinations of hard cases a function instead of 16384, and 262144 inputs "
                         "drawn instead of 8192: an hour or two. Once interrupted, the next --full goes on from there");
        command
            .add_option("--cache", cache_,
                        "Folder that keeps what an interrupted --full has found, or none. Default: "
                        "$XDG_CACHE_HOME/halfframe or ~/.cache/halfframe")
            ->type_name("DIR|none");
        command.add_flag(
            "--arguments", arguments_,
            "Instead, draw every built-in scene and record which arguments functions get there; one outside "
            "its declared domain is exit code 1");
        command.add_flag("--json", json_, "Standard output is one JSON value");
        command.add_option("--html", html_, "Also write a page that stands alone")->type_name("FILE");
        command
            .add_option("--pictures", pictures_,
                        "Also write the exhibit's pictures: each listing as printed, the form that holds, and where "
                        "they differ")
            ->type_name("DIR");
        command
            .add_option("--ledger", ledger_, "Compare the worst inputs with this ledger; differences are exit code 1")
            ->type_name("FILE");
        command.add_option("--write-ledger", write_ledger_, "Write the ledger of the worst inputs")->type_name("FILE");
        add_device_options(command, device_);
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "stability"; }

    int run() override {
        refuse_contradictions();
        if (arguments_) return show_arguments();
        stability::StabilityReport report;
        choose(report);
        std::optional<GraphicsDevice> device;
        std::optional<stability::Drawing> drawing;
        open(device, drawing, report);
        search_all(drawing ? &*drawing : nullptr, report);
        std::vector<std::string> changes = ledger_changes(report);
        if (!pictures_.empty()) write_pictures(report);
        if (!html_.empty()) perf::write_file(html_, stability::stability_page(report));
        if (json_) {
            print_json(stability::stability_json(report));
        } else {
            print(stability::stability_text(report));
        }
        for (const std::string& change : changes) complain("ledger: " + change + "\n");
        return report.violations().empty() && changes.empty() ? 0 : static_cast<int>(Fault::check);
    }

private:
    [[nodiscard]] bool own_file() const {
        return wanted_.size() == 1 && (wanted_[0].ends_with(".glsl") || wanted_[0].ends_with(".frag") ||
                                       wanted_[0].ends_with(".vert") || std::filesystem::is_regular_file(wanted_[0]));
    }

    /// What is wrong with a user's own text is no check that failed.
    [[nodiscard]] std::unique_ptr<const stability::Subject> subject_of(const Declaration& function,
                                                                       const std::string& variant) const {
        try {
            return std::make_unique<const stability::Subject>(function, variant, files_);
        } catch (const Error& error) {
            throw Error(own_file() ? Fault::input : error.fault(), error.what());
        }
    }

    int show_arguments() const {
        GraphicsDevice device(device_);
        if (!device.caps().renders[static_cast<std::size_t>(gl::PixelFormat::rgba32f)]) {
            throw Error(Fault::usage,
                        fmt::format("arguments are recorded in RGBA32F targets, which {} does not render; "
                                    "leave --device out or try another --context",
                                    device.caps().renderer));
        }
        Progress progress;
        const auto seen = stability::see_arguments(device.gl(), device.caps(), [&](const std::string& what) {
            stop_if_interrupted();
            progress.show(what);
        });
        progress.clear();
        print(stability::arguments_text(seen));
        const std::vector<std::string> violations = stability::violations_of(seen);
        for (const std::string& one : violations) print(one + "\n");
        return violations.empty() ? 0 : static_cast<int>(Fault::check);
    }

    void refuse_contradictions() const {
        if (arguments_ && (!wanted_.empty() || full_ || json_ || !(html_ + pictures_ + ledger_ + write_ledger_).empty()))
            throw Error(Fault::usage,
                        "--arguments draws scenes and searches nothing: it goes with --context and --device only");
        if (!own_file() && !(function_.empty() && domain_.empty()))
            throw Error(Fault::usage, "--function and --domain are for a .glsl file of your own; name one");
        if (!domain_.empty() && function_.empty())
            throw Error(Fault::usage, "--domain needs --function: it says over which inputs that one is tried");
        if (!(ledger_.empty() && write_ledger_.empty()) && (full_ || !wanted_.empty()))
            throw Error(Fault::usage,
                        "the ledger holds what the fast search finds in all of shaders_es; leave out "
                        "--full and the names");
        if (!pictures_.empty() && !wanted_.empty())
            throw Error(Fault::usage, "--pictures are of the exhibit, which is measured where nothing is named");
        if (!pictures_.empty()) make_folder(pictures_);
        for (const std::string& path : {html_, write_ledger_}) {
            if (!path.empty()) perf::expect_can_write(path);
        }
    }

    /// What is searched: into chosen_, report.not_run and report.gaps.
    void choose(stability::StabilityReport& report) {
        files_ = stability::files_with_exhibit();
        std::vector<Declaration> functions;
        if (own_file()) {
            text_ = read_text(wanted_[0]);
            files_.push_back({wanted_[0].c_str(), text_});
            functions = own_functions();
        } else {
            functions = stability::all_functions();
            report.in_shaders_es = wanted_.empty() ? functions.size() : 0;
            keep_wanted(functions);
        }
        for (Declaration& function : functions) {
            if (!function.not_run.empty()) report.not_run.push_back(function);
            else if (!stability::gap_in(function).empty()) report.gaps.push_back(function);
            else chosen_.push_back(function);
        }
    }

    std::vector<Declaration> own_functions() const {
        std::vector<Declaration> functions = stability::functions_of(wanted_[0], text_);
        std::vector<std::string> names;
        for (const Declaration& one : functions) names.push_back(one.name);
        if (functions.empty()) throw Error(Fault::input, wanted_[0] + " defines no function; write one, and a domain");
        if (function_.empty()) return functions;
        std::erase_if(functions, [&](const Declaration& one) { return one.name != function_; });
        if (functions.empty()) throw Error(Fault::usage, unknown("function", function_, names));
        try {
            if (!domain_.empty()) stability::declare_domain(functions[0], domain_);
        } catch (const Error& error) {
            throw Error(Fault::usage, std::string("--domain: ") + error.what());
        }
        functions[0].not_run.clear();
        return functions;
    }

    void keep_wanted(std::vector<Declaration>& functions) const {
        std::vector<std::string> names;
        for (const Declaration& one : functions) {
            for (const std::string& name : {folder_of(one), one.name}) {
                if (std::ranges::find(names, name) == names.end()) names.push_back(name);
            }
        }
        for (const std::string& wish : wanted_) {
            if (std::ranges::find(names, wish) == names.end())
                throw Error(Fault::usage, unknown("effect or function", wish, names));
        }
        if (wanted_.empty()) return;
        std::erase_if(functions, [&](const Declaration& one) {
            return std::ranges::find(wanted_, one.name) == wanted_.end() &&
                   std::ranges::find(wanted_, folder_of(one)) == wanted_.end();
        });
    }

    /// Opens the device, or says why its figures are missing. One asked for by name must start.
    void open(std::optional<GraphicsDevice>& device, std::optional<stability::Drawing>& drawing,
              stability::StabilityReport& report) const {
        try {
            device.emplace(device_);
        } catch (const platform::ContextError& error) {
            if (device_.context != "auto") throw;
            report.missing = error.what();
            return;
        }
        report.missing = accuracy::LaneCanvas::obstacle(device->caps());
        if (!report.missing.empty()) return;
        drawing.emplace(device->gl(), device->caps(), perf::probe_precision(device->gl(), device->caps()));
        report.driver = fmt::format("{}, {}; {}", device->caps().renderer, device->context().description(),
                                    drawing->probe.sentence);
    }

    void search_all(const stability::Drawing* drawing, stability::StabilityReport& report) const {
        Progress progress;
        const stability::Effort& effort = full_ ? stability::kFullEffort : stability::kFastEffort;
        const std::filesystem::path folder = full_ ? cache_folder(cache_) : std::filesystem::path();
        stability::KeptResults kept(folder.empty() ? folder : folder / "stability", report.driver);
        for (std::size_t i = 0; i < chosen_.size(); ++i) {
            for (const std::string& variant : chosen_[i].variants) {
                const std::unique_ptr<const stability::Subject> made = subject_of(chosen_[i], variant);
                const stability::Subject& subject = *made;
                if (const auto earlier = kept.find(subject, effort)) {
                    report.functions.push_back(*earlier);
                    ++report.from_earlier_run;
                    continue;
                }
                report.functions.push_back(
                    stability::search(subject, effort, drawing, [&](std::size_t done, std::size_t planned) {
                        stop_if_interrupted();
                        progress.show(fmt::format("{} of {}: {}, {} of {} inputs", i + 1, chosen_.size(),
                                                  subject.title(), done, planned));
                    }));
                kept.keep(report.functions.back(), subject, effort);
            }
        }
        kept.forget();
        if (!wanted_.empty()) return;
        for (const stability::ExhibitEntry& entry : stability::exhibit_list()) {
            stop_if_interrupted();
            progress.show(std::string("exhibit: ") + entry.name);
            report.exhibit.push_back(stability::measure(entry, stability::kFastEffort, drawing));
        }
    }

    /// The exhibit's pictures as files.
    void write_pictures(const stability::StabilityReport& report) const {
        for (const stability::ExhibitResult& one : report.exhibit) {
            const std::string name = std::filesystem::path(one.entry.file).stem().string();
            const std::filesystem::path folder(pictures_);
            for (const auto& [picture, form] : {std::pair{&one.picture_printed, "as_printed"},
                                                {&one.picture_mended, "mended"}, {&one.picture_difference, "difference"}}) {
                const std::vector<std::uint8_t> bytes = perf::png_bytes(*picture);
                perf::write_file((folder / fmt::format("{}_{}.png", name, form)).string(),
                                 std::string(bytes.begin(), bytes.end()));
            }
        }
    }

    std::vector<std::string> ledger_changes(const stability::StabilityReport& report) const {
        const std::vector<stability::LedgerRow> rows = stability::ledger_rows(report.functions);
        if (!write_ledger_.empty()) perf::write_file(write_ledger_, stability::ledger_text(rows));
        if (ledger_.empty()) return {};
        return stability::differences(stability::read_ledger(read_text(ledger_), ledger_), rows);
    }

    std::vector<std::string> wanted_;
    std::string function_, domain_, html_, pictures_, ledger_, write_ledger_;
    std::string cache_;
    bool full_ = false;
    bool arguments_ = false;
    bool json_ = false;
    DeviceOptions device_;
    std::string text_;
    std::vector<gl::ShaderFile> files_;
    std::vector<Declaration> chosen_;
};

}  // namespace

std::unique_ptr<Command> make_stability_command(CLI::App& app) { return std::make_unique<StabilityCommand>(app); }

}  // namespace halfframe::cli
