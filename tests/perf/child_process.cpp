// A child process of the kind that the command's tests start.
#include "tests/perf/child_process.h"

#include <signal.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "perf/process/child_process.h"

namespace halfframe::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Does the process have a handler for SIGINT? (SigCgt of /proc/PID/status; bit n-1 is signal n.)
bool catches_interrupt(int child) {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    std::string line;
    while (std::getline(status, line)) {
        if (line.starts_with("SigCgt:")) {
            return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1u) != 0;
        }
    }
    return false;
}

/// Sends SIGINT once, `after` the child began to catch it.
std::function<void(int)> interruption(std::chrono::milliseconds after) {
    return [after, caught = std::optional<Clock::time_point>(), sent = false](int child) mutable {
        if (!caught && catches_interrupt(child)) caught = Clock::now();
        if (!caught || sent || Clock::now() < *caught + after) return;
        ::kill(child, SIGINT);
        sent = true;
    };
}

}  // namespace

std::string file_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

ChildResult run_child(const std::string& command, const std::vector<std::string>& arguments,
                      const ChildOptions& options) {
    process::ChildCommand child{.arguments = {command}, .limit_s = 600.0};
    child.arguments.insert(child.arguments.end(), arguments.begin(), arguments.end());
    child.environment.assign(options.environment.begin(), options.environment.end());
    if (options.standard_output) child.standard_output = *options.standard_output;
    child.file_size_limit = options.file_size_limit;
    if (options.interrupt_after_ms)
        child.between = interruption(std::chrono::milliseconds(*options.interrupt_after_ms));
    const process::ChildResult ended = process::run_child(child);
    return {
        .code = ended.signal != 0 ? 1000 + ended.signal : ended.exit_code, .out = ended.output, .err = ended.errors};
}

}  // namespace halfframe::test
