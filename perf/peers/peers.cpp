// The peers command: halfframe, three.js and Filament on the same driver, side by side.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "engine/error.h"
#include "perf/peers/compare.h"
#include "perf/peers/peer_process.h"
#include "perf/peers/peers_report.h"
#include "perf/report/atomic_file.h"

namespace halfframe::peers {
namespace {

struct Options {
    CompareRequest request;
    std::string size = "1280x720";
    std::filesystem::path three = HALFFRAME_PEERS_THREE_FOLDER;
    std::vector<std::string> models;
    std::vector<std::string> only;
};

void parse_size(const std::string& text, CompareRequest& request) {
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &request.width, &request.height, &rest) != 2 || request.width < 16 ||
        request.height < 16 || request.width > 4096 || request.height > 4096) {
        throw Error(Fault::usage, fmt::format("--size {} is no size; write 1280x720 (16 to 4096 each)", text));
    }
}

/// The environment that is asked for, or the first .hdr of HALFFRAME_ASSETS/environments.
std::filesystem::path environment_file(const std::filesystem::path& asked) {
    if (!asked.empty()) {
        if (!std::filesystem::exists(asked)) throw Error(Fault::input, asked.string() + " does not exist");
        return std::filesystem::absolute(asked);
    }
    const char* assets = std::getenv("HALFFRAME_ASSETS");
    const auto folder = std::filesystem::path(assets ? assets : ".") / "environments";
    if (assets != nullptr && std::filesystem::is_directory(folder)) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() == ".hdr") return std::filesystem::absolute(entry.path());
        }
    }
    throw Error(Fault::input,
                "an environment is needed to light the models: give an equirectangular .hdr file with "
                "--environment, or set HALFFRAME_ASSETS to a folder with environments/*.hdr");
}

/// Filament's own prefilter, with its default of 256 texels a side; three.js prefilters while it loads.
void prefilter_for_filament(const CompareRequest& request) {
    const auto cmgen = program("cmgen");
    if (!cmgen) return;
    request.say("Filament's cmgen prefilters the environment");
    const auto folder = request.folder / "environment";  // cmgen names its files after the folder
    const std::string log = (request.folder / "cmgen.log").string();
    if (run_program({*cmgen, "--quiet", "--format=ktx", "--size=256", "--deploy=" + folder.string(),
                     request.environment.string()},
                    log) != 0) {
        throw Error(Fault::check, "cmgen failed; its words are in " + log);
    }
}

template <typename Item>
std::vector<Item> chosen(std::vector<Item> items, const std::vector<std::string>& names, const char* option) {
    for (const std::string& wished : names) {
        if (std::ranges::none_of(items, [&](const Item& item) { return item.name == wished; })) {
            std::string there_are;
            for (const Item& item : items) there_are += (there_are.empty() ? "" : ", ") + item.name;
            throw Error(Fault::usage, fmt::format("{} {} is none of those at hand: {}", option, wished, there_are));
        }
    }
    if (names.empty()) return items;
    std::erase_if(items, [&](const Item& item) { return std::ranges::find(names, item.name) == names.end(); });
    return items;
}

int run(Options options) {
    CompareRequest& request = options.request;
    parse_size(options.size, request);
    request.environment = environment_file(request.environment);
    request.folder = std::filesystem::absolute(request.folder);
    std::filesystem::create_directories(request.folder);
    request.say = [](const std::string& step) { fmt::print(stderr, "{}\n", step); };
    Setting setting{.machine = machine_text(), .request = request, .notices = {}};
    const Places places{.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path(),
                        .three_script = HALFFRAME_PEERS_THREE_SCRIPT,
                        .three_folder = std::filesystem::absolute(options.three)};
    const auto who = chosen(contestants(places, setting.notices), options.only, "--only");
    const auto what = chosen(models(request.folder, setting.notices), options.models, "--model");
    if (std::ranges::any_of(who, [](const Contestant& each) { return each.name == kFilament; })) {
        prefilter_for_filament(request);
    }
    std::vector<Comparison> comparisons;
    for (const Model& model : what) comparisons.push_back(compare(model, who, request));
    fmt::print("{}", text_report(setting, comparisons));
    perf::write_file(request.folder / "peers.json", json_report(setting, comparisons).dump(2) + "\n");
    fmt::print("pictures and peers.json are in {}\n", request.folder.string());
    const bool all_drew = std::ranges::all_of(comparisons, [](const Comparison& comparison) {
        return std::ranges::none_of(comparison.results,
                                    [](const Result& result) { return result.refused.has_value(); });
    });
    return all_drew ? 0 : static_cast<int>(Fault::check);
}

}  // namespace
}  // namespace halfframe::peers

int main(int argument_count, char** arguments) {
    using namespace halfframe;
    std::signal(SIGPIPE, SIG_IGN);  // a peer that ended is an error with words, not a silent end
    // All peers: the same software driver, no wait for a display's refresh.
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("vblank_mode", "0", 1);
    // glibc gives the top of the heap back and takes it again whenever a buffer of llvmpipe's vertex stage happens to
    // lie there: page faults that cost 0 or 7 ms a frame of 100 000 triangles, by the luck of each process. Nobody has
    // them.
    for (const char* threshold : {"MALLOC_TRIM_THRESHOLD_", "MALLOC_MMAP_THRESHOLD_"}) {
        setenv(threshold, "1073741824", 1);
    }
    setenv("MALLOC_TOP_PAD_", "67108864", 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // the second run compiles what the first one did
    peers::Options options;
    CLI::App app("Times halfframe, three.js and Filament on Mesa's llvmpipe: same models, same light, interleaved.");
    app.add_option("--model", options.models, "Only these models")->delimiter(',')->type_name("NAME,...");
    app.add_option("--only", options.only, "Only these renderers")->delimiter(',')->type_name("NAME,...");
    app.add_option("--rounds", options.request.rounds, "Times that everybody draws")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_option("--batch-ms", options.request.batch_ms, "Milliseconds that one renderer draws at a stretch")
        ->check(CLI::Range(10.0, 60000.0))
        ->capture_default_str();
    app.add_option("--size", options.size, "Pixels")->type_name("WxH")->capture_default_str();
    app.add_option("--environment", options.request.environment,
                   "Equirectangular .hdr file; else the first of HALFFRAME_ASSETS/environments")
        ->type_name("FILE");
    app.add_option("--three", options.three, "Folder that holds node_modules/three")
        ->type_name("DIR")
        ->capture_default_str();
    options.request.folder = "out/peers";
    app.add_option("-o,--output", options.request.folder, "Folder for pictures, logs and peers.json")
        ->type_name("DIR")
        ->capture_default_str()
        ->take_last();  // ./peers names one, and a user may name another
    try {
        app.parse(argument_count, arguments);
    } catch (const CLI::Success& done) {
        return app.exit(done);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "peers: {}; see --help\n", error.what());
        return static_cast<int>(Fault::usage);
    }
    try {
        return peers::run(std::move(options));
    } catch (const Error& error) {
        fmt::print(stderr, "peers: {}\n", error.what());
        return error.exit_code();
    } catch (const std::filesystem::filesystem_error& error) {
        fmt::print(stderr, "peers: {}\n", error.what());
        return static_cast<int>(Fault::environment);
    } catch (const std::exception& error) {
        fmt::print(stderr, "peers: internal error: {}\n", error.what());
        return static_cast<int>(Fault::check);
    }
}
