// Runs a command as a child: changed environment, captured output, exit code, time limit.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace halfframe::harness {

struct ChildCommand {
    std::vector<std::string> arguments{};  ///< [0] is the program, looked up in PATH when it holds no slash
    /// Changes to our own environment: name and new value; no value takes the name away.
    std::vector<std::pair<std::string, std::optional<std::string>>> environment{};
    std::filesystem::path folder{};  ///< working folder; empty: ours
    double limit_s = 120.0;          ///< after this the child and its children are killed
};

struct ChildResult {
    int exit_code = -1;      ///< -1 when a signal ended it
    int signal = 0;          ///< the signal that ended it, or 0
    bool timed_out = false;  ///< the time limit ended it
    std::string output;      ///< standard output
    std::string errors;      ///< standard error
    /// Everything on one screen, for the message of a failed test.
    [[nodiscard]] std::string story() const;
};

/// Runs to the end and returns. A program that does not exist ends with exit code 127, as in a shell.
/// Throws std::system_error when no process can be made.
[[nodiscard]] ChildResult run_child(const ChildCommand& command);

}  // namespace halfframe::harness
