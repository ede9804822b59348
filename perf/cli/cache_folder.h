// Where the command keeps what it would otherwise make anew in every run.
#pragma once

#include <filesystem>
#include <string>

namespace halfframe::cli {

/// `wished` (the value of --cache); "none": nothing is kept; empty: $XDG_CACHE_HOME/halfframe, else ~/.cache/halfframe,
/// else nothing, because a user without a home keeps nothing.
[[nodiscard]] std::filesystem::path cache_folder(const std::string& wished);

}  // namespace halfframe::cli
