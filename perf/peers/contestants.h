// Who is compared: the peers that this machine has, and halfframe's tiers and floors.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace halfframe::peers {

struct Contestant {
    std::string name;                  ///< "three.js", "console+full"
    std::vector<std::string> command;  ///< starts its process
    bool ours = false;                 ///< halfframe itself
    std::string floor;                 ///< name of the floor it stands on; empty: none
    double share_of_three = 0.0;       ///< what it is to reach; 0: shown for information
};

struct Places {
    std::filesystem::path programs;      ///< folder of halfframe_peer and halfframe_filament_peer
    std::filesystem::path three_script;  ///< peer.mjs
    std::filesystem::path three_folder;  ///< holds node_modules/three
};

inline constexpr const char* kThree = "three.js";
inline constexpr const char* kFilament = "Filament";
inline constexpr const char* kConsole = "console+full";

/// Those that can start here. What is missing, and what to install, is said in `notices`.
[[nodiscard]] std::vector<Contestant> contestants(const Places& places, std::vector<std::string>& notices);

/// Full path of a program in PATH.
[[nodiscard]] std::optional<std::filesystem::path> program(const std::string& name);

}  // namespace halfframe::peers
