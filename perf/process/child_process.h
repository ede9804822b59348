// Runs a command as a child: changed environment, captured output, exit code, limits. What crashes there does not crash
// here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace halfframe::process {

struct ChildCommand {
    std::vector<std::string> arguments{};  ///< [0] is the program, looked up in PATH when it holds no slash
    /// Changes to our own environment: name and new value; no value takes the name away.
    std::vector<std::pair<std::string, std::optional<std::string>>> environment{};
    std::filesystem::path folder{};                          ///< working folder; empty: ours
    double limit_s = 120.0;                                  ///< after this the child and its children are killed
    std::optional<std::filesystem::path> standard_output{};  ///< written there instead of being kept, e.g. /dev/full
    std::optional<std::size_t> file_size_limit{};            ///< of any file it writes (RLIMIT_FSIZE) [bytes]
    std::optional<std::size_t> memory_limit{};               ///< of its address space (RLIMIT_AS) [bytes]
    /// Called every few milliseconds while the child runs; throws to stop: the child and what it started then end too.
    std::function<void(int process)> between{};
};

struct ChildResult {
    int exit_code = -1;      ///< -1 when a signal ended it
    int signal = 0;          ///< the signal that ended it, or 0
    bool timed_out = false;  ///< the time limit ended it
    std::string output;      ///< standard output; of more than 16 MiB the beginning
    std::string errors;      ///< standard error; the same
    /// Everything on one screen, for the message of a failed test.
    [[nodiscard]] std::string story() const;
};

/// Runs to the end and returns; what the child leaves running is killed. Its standard input is empty. A program that
/// does not exist ends with exit code 127, as in a shell. No process or no pipe: Error(environment).
[[nodiscard]] ChildResult run_child(const ChildCommand& command);

}  // namespace halfframe::process
