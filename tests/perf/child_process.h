// The command's tests in few words: run it, interrupt it, read what it wrote.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/harness/temporary_folder.h"

namespace halfframe::test {

using harness::TemporaryFolder;

struct ChildOptions {
    std::vector<std::pair<std::string, std::string>> environment;  ///< set on top of ours
    std::optional<std::string> standard_output;                    ///< a file instead of being kept, e.g. /dev/full
    std::optional<std::size_t> file_size_limit;                    ///< RLIMIT_FSIZE [bytes]
    /// Sent SIGINT this long after the child began to catch it [ms].
    std::optional<int> interrupt_after_ms;
};

struct ChildResult {
    int code = -1;  ///< exit code; 1000 + signal when a signal ended it
    std::string out;
    std::string err;
};

/// Runs `command` with `arguments`; waits for its end.
[[nodiscard]] ChildResult run_child(const std::string& command, const std::vector<std::string>& arguments,
                                    const ChildOptions& options = {});

[[nodiscard]] std::string file_text(const std::filesystem::path& path);

}  // namespace halfframe::test
