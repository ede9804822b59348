// halfframe contact-sheet DIR|SCENE...: one picture of many scenes, each drawn by a process of its own.
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/terminal.h"
#include "perf/process/child_process.h"
#include "perf/report/atomic_file.h"
#include "perf/report/contact_sheet.h"
#include "perf/report/picture_file.h"
#include "perf/report/text_table.h"

namespace halfframe::cli {
namespace {

namespace fs = std::filesystem;

/// Letters on a sheet [pixels]; the smallest that is read without effort.
constexpr int kLetters_px = 14;
/// A sheet's longest side [pixels]: a PNG of that square takes 1 GiB while it is written.
constexpr int kLargestSheet = 16384;

/// Exit codes that say nothing about a scene: usage, no context, environment.
const std::set<std::string> kNotTheScene{"2", "4", "5"};

bool is_gltf(const fs::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".gltf" || ending == ".glb";
}

/// The .gltf and .glb files in and below a folder, sorted by path.
std::vector<std::string> scenes_below(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
        if (entry.is_regular_file() && is_gltf(entry.path())) files.push_back(entry.path().string());
    }
    if (files.empty()) {
        throw Error(Fault::input, fmt::format("{}: no .gltf or .glb file lies in this folder or below", folder));
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// A folder that goes away with what is in it.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string pattern = (fs::temp_directory_path() / "halfframe_sheet_XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) {
            throw Error(Fault::environment, pattern + " cannot be made; set TMPDIR to a folder that can be written");
        }
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;  // what stays behind is only waste
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

private:
    fs::path path_;
};

/// The sentence that the child ended with, without the name of the command and the folder of the scene.
std::string complaint(const process::ChildResult& run, const std::string& scene) {
    constexpr std::string_view kStart = "halfframe: ";
    std::string words = run.errors;
    if (const std::size_t at = words.rfind(kStart); at != std::string::npos) words.erase(0, at + kStart.size());
    const std::string folder = fs::path(scene).parent_path().string();
    for (std::size_t at = folder.empty() ? std::string::npos : words.find(folder + "/"); at != std::string::npos;
         at = words.find(folder + "/", at)) {
        words.erase(at, folder.size() + 1);
    }
    std::replace(words.begin(), words.end(), '\n', ' ');
    return words;
}

std::optional<double> frame_ms(const std::string& report) {
    const auto json = nlohmann::json::parse(report, nullptr, false);
    const nlohmann::json::json_pointer place("/measurement/frame/median_ms");
    if (json.is_discarded() || !json.contains(place) || !json.at(place).is_number()) return std::nullopt;
    return json.at(place).get<double>();
}

class ContactSheetCommand : public Command {
public:
    explicit ContactSheetCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "contact-sheet",
            "Draws many scenes into one picture, each with its name, exit code and milliseconds; one that fails or "
            "crashes leaves a grey cell with its reason");
        command
            .add_option("SCENE", wished_,
                        "Folders, which are searched for .gltf and .glb files; such files; built-in scenes")
            ->required();
        command.add_option("-o,--output", output_, "The sheet, a .png file")->type_name("FILE")->required();
        options_.size = "320x180";
        add_scene_options(command, options_);
        command.remove_option(command.get_option("--size"));
        command.add_option("--cell", options_.size, "Width and height of each picture [pixels]")
            ->type_name("WxH")
            ->capture_default_str();
        command.add_option("--columns", layout_.columns, "Pictures side by side; 0: as many as make the sheet 16:9")
            ->type_name("N")
            ->check(CLI::Range(0, 1000).description(""))
            ->capture_default_str();
        command.add_option("--measure", measured_frames_, "Frames to time for each scene, 0 to 1000; 0: time nothing")
            ->type_name("N")
            ->check(CLI::Range(0, 1000).description(""))
            ->capture_default_str();
        command.add_option("--limit", limit_s_, "Seconds that one scene may take before it is given up")
            ->type_name("S")
            ->check(CLI::Range(1.0, 86400.0).description(""))
            ->capture_default_str();
        command
            .add_option("--font", font_, "TrueType font of the names. Default: DejaVu Sans, else another of Debian's")
            ->type_name("FILE");
        command.footer(std::string("Exit code 3: some scene was not drawn; the sheet is written all the same.\n") +
                       kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "contact-sheet"; }

    int run() override {
        try {
            check_options(options_);
        } catch (const Error& error) {  // what is --size there is --cell here
            std::string words = error.what();
            if (words.starts_with("--size")) words.replace(0, 6, "--cell");
            throw Error(error.fault(), words);
        }
        if (!output_.ends_with(".png")) {
            throw Error(Fault::usage, fmt::format("-o {}: the name must end in .png", output_));
        }
        perf::expect_can_write(output_);
        const perf::Lettering lettering(perf::find_font(font_), kLetters_px);
        const std::vector<std::string> scenes = all_scenes();
        set_layout(scenes.size(), lettering);
        const std::vector<perf::SheetCell> cells = draw(scenes);
        perf::write_png(output_, perf::contact_sheet(cells, layout_, lettering));
        return report(scenes, cells);
    }

private:
    [[nodiscard]] std::vector<std::string> all_scenes() const {
        std::vector<std::string> scenes;
        for (const std::string& wished : wished_) {
            std::error_code ignored;
            if (fs::is_directory(wished, ignored)) {
                const std::vector<std::string> found = scenes_below(wished);
                scenes.insert(scenes.end(), found.begin(), found.end());
            } else {
                scenes.push_back(wished);
            }
        }
        return scenes;
    }

    void set_layout(std::size_t count, const perf::Lettering& lettering) {
        const std::size_t cross = options_.size.find('x');  // check_options() has seen that it is WxH
        layout_.cell_width = std::stoi(options_.size.substr(0, cross));
        layout_.cell_height = std::stoi(options_.size.substr(cross + 1));
        const int caption = 3 * lettering.height();
        const int columns = perf::sheet_columns(count, layout_, caption);
        const auto rows = (count + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
        if (columns * (layout_.cell_width + 8) > kLargestSheet ||
            rows * static_cast<std::size_t>(layout_.cell_height + caption) > kLargestSheet) {
            throw Error(Fault::usage,
                        fmt::format("{} cells of {} make a sheet of more than {} pixels; choose a smaller "
                                    "--cell, other --columns, or fewer scenes",
                                    count, options_.size, kLargestSheet));
        }
    }

    /// What stands under each picture: the file's name, with its folder where two files share one.
    static std::vector<std::string> names_of(const std::vector<std::string>& scenes) {
        std::multiset<std::string> stems;
        for (const std::string& scene : scenes) stems.insert(fs::path(scene).stem().string());
        std::vector<std::string> names;
        for (const std::string& scene : scenes) {
            const std::string stem = fs::path(scene).stem().string();
            names.push_back(stems.count(stem) > 1 && is_gltf(scene) ? scene : stem);
        }
        return names;
    }

    [[nodiscard]] std::vector<perf::SheetCell> draw(const std::vector<std::string>& scenes) const {
        const ScratchFolder scratch;
        const std::vector<std::string> names = names_of(scenes);
        Progress progress;
        std::vector<perf::SheetCell> cells;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            progress.show(fmt::format("{} of {}: {}", i + 1, scenes.size(), names[i]));
            const std::string picture = scratch.file(fmt::format("{}.png", i));
            cells.push_back(draw_one(scenes[i], names[i], picture));
        }
        return cells;
    }

    [[nodiscard]] perf::SheetCell draw_one(const std::string& scene, const std::string& label,
                                           const std::string& picture) const {
        process::ChildCommand command{.arguments = {"/proc/self/exe", "render", "--json", "-o", picture, "--measure",
                                                    std::to_string(measured_frames_)},
                                      .limit_s = limit_s_,
                                      .between = [](int) { stop_if_interrupted(); }};
        std::vector<std::string>& words = command.arguments;
        for (const std::string& word : option_words(options_)) words.push_back(word);
        words.push_back(scene.starts_with('-') ? "./" + scene : scene);
        const process::ChildResult run = process::run_child(command);
        perf::SheetCell cell;
        cell.name = label;
        cell.verdict = run.timed_out     ? "timeout"
                       : run.signal != 0 ? fmt::format("signal {}", run.signal)
                                         : std::to_string(run.exit_code);
        std::error_code ignored;
        // A failed check (1) draws its picture; after a crash a file may be there and is not to be trusted.
        if (run.exit_code >= 0 && fs::exists(picture, ignored)) {
            cell.picture = perf::read_png(picture);
            cell.ms = frame_ms(run.output);
            fs::remove(picture, ignored);
            return cell;
        }
        cell.words = run.timed_out     ? fmt::format("given up after {} s", limit_s_)
                     : run.signal != 0 ? fmt::format("ended by signal {}", run.signal)
                                       : complaint(run, scene);
        return cell;
    }

    /// The table, and a line on standard error for each that was not drawn.
    [[nodiscard]] int report(const std::vector<std::string>& scenes, const std::vector<perf::SheetCell>& cells) const {
        perf::TextTable table({{"scene"}, {"exit"}, {"ms", perf::Align::right}});
        std::set<std::string> failures;
        std::size_t drawn = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            table.add_row({cells[i].name, cells[i].verdict, cells[i].ms ? perf::ms_text(*cells[i].ms) : "-"});
            if (cells[i].picture) {
                ++drawn;
            } else {
                failures.insert(cells[i].verdict);
                complain(fmt::format("not drawn: {}: {}\n", scenes[i], cells[i].words));
            }
        }
        print(table.text() + "written: " + output_ + "\n");
        // Where nothing at all could be drawn for want of a context, a device or room, that is what failed.
        if (drawn == 0 && failures.size() == 1 && kNotTheScene.contains(*failures.begin())) {
            return std::stoi(*failures.begin());
        }
        return failures.empty() ? 0 : static_cast<int>(Fault::input);
    }

    std::vector<std::string> wished_;
    std::string output_;
    SceneOptions options_;
    perf::SheetLayout layout_;
    int measured_frames_ = 3;
    double limit_s_ = 120.0;
    std::string font_;
};

}  // namespace

std::unique_ptr<Command> make_contact_sheet_command(CLI::App& app) {
    return std::make_unique<ContactSheetCommand>(app);
}

}  // namespace halfframe::cli
