// Runs a command as a child process and keeps what it said.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace halfframe::test {

/// A folder of its own, gone with its contents when the test ends.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Names in the folder, sorted.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

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
