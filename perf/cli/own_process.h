// Runs halfframe once more, as a child: what is counted and what is timed need drivers set up differently.
#pragma once

#include <string>

namespace halfframe::cli {

/// Standard output of `halfframe ARGUMENTS`, in this process's environment; its notices and progress are dropped.
/// Error(check) with its last words when it fails.
[[nodiscard]] std::string output_of_own(const std::string& arguments);

}  // namespace halfframe::cli
