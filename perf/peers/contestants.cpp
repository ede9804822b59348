// Finds the peers.
#include "perf/peers/contestants.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace halfframe::peers {
namespace {

std::optional<Contestant> three(const Places& places, std::string& why_not) {
    const auto node = program("node");
    const auto chromium = program("chromium");
    const auto module = places.three_folder / "node_modules/three/build/three.module.js";
    if (!node || !chromium) {
        why_not = "three.js is left out: it needs node and chromium in PATH (Debian packages nodejs, chromium)";
        return std::nullopt;
    }
    if (!std::filesystem::exists(module)) {
        why_not = "three.js is left out: " + module.string() + " is not there; ./peers installs it from npm";
        return std::nullopt;
    }
    return Contestant{
        .name = kThree, .command = {*node, places.three_script, places.three_folder, *chromium}, .floor = {}};
}

std::optional<Contestant> filament(const Places& places, std::string& why_not) {
    const auto display = program("xvfb-run");
    const auto prefilter = program("cmgen");
    const auto peer = places.programs / "halfframe_filament_peer";
    if (!display || !prefilter) {
        why_not =
            "Filament is left out: it needs xvfb-run and cmgen in PATH (Debian packages xvfb, xauth, "
            "libfilament-tools)";
        return std::nullopt;
    }
    if (!std::filesystem::exists(peer)) {
        why_not = "Filament is left out: " + peer.string() +
                  " was not built (Debian package libfilament-dev; then configure anew)";
        return std::nullopt;
    }
    return Contestant{.name = kFilament, .command = {*display, "-a", "-s", "-screen 0 640x480x24", peer}, .floor = {}};
}

}  // namespace

std::optional<std::filesystem::path> program(const std::string& name) {
    std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const auto file = std::filesystem::path(folder) / name;
        if (access(file.c_str(), X_OK) == 0) return file;
    }
    return std::nullopt;
}

std::vector<Contestant> contestants(const Places& places, std::vector<std::string>& notices) {
    std::vector<Contestant> list;
    for (const auto find : {three, filament}) {
        std::string why_not;
        if (auto found = find(places, why_not)) {
            list.push_back(std::move(*found));
        } else {
            notices.push_back(why_not);
        }
    }
    const auto add = [&](const char* name, const char* tier, const char* arithmetic, const char* work,
                         const char* floor, double share, const char* storage = "") {
        list.push_back({.name = name,
                        .command = {places.programs / "halfframe_peer", tier, arithmetic, work, storage},
                        .ours = true,
                        .floor = floor,
                        .share_of_three = share});
    };
    // The shares are the aims of this renderer: half of three.js at console, a quarter at low, on full arithmetic.
    add(kConsole, "console", "full", "surface", "console fetches", 0.5);
    add("low+full", "low", "full", "surface", "low fetches", 0.25);
    add("console+half", "console", "half", "surface", "console fetches", 0.0);
    // What a scene pays that needs light stored: a float target, and the pass that maps it.
    add("console+full+rgba16f", "console", "full", "surface", "console fetches", 0.0, "rgba16f");
    add("console fetches", "console", "full", "fetches", "", 0.0);
    add("console constant", "console", "full", "constant", "", 0.0);
    add("low fetches", "low", "full", "fetches", "", 0.0);
    add("low constant", "low", "full", "constant", "", 0.0);
    return list;
}

}  // namespace halfframe::peers
