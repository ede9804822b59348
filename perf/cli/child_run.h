// This command again as a child process: what crashes there does not crash here.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace halfframe::cli {

struct ChildRun {
    int exit_code = -1;      ///< -1 when a signal ended it
    int signal = 0;          ///< the signal that ended it, or 0
    bool timed_out = false;  ///< it ran past the limit and was killed
    std::string out;
    std::string err;
};

/// Runs this very program with `words` to its end, at most `limit_s` seconds. `between` is called some times a second
/// and throws to stop; the child and what it started then end too. No process or no pipe: Error(environment).
[[nodiscard]] ChildRun run_self(const std::vector<std::string>& words, double limit_s,
                                const std::function<void()>& between);

}  // namespace halfframe::cli
