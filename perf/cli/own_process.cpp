// A child through the shell: arguments come quoted for one.
#include "perf/cli/own_process.h"

#include <array>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <sys/wait.h>

#include "engine/error.h"
#include "perf/cli/scene_options.h"
#include "perf/cli/terminal.h"

namespace halfframe::cli {

std::string output_of_own(const std::string& arguments) {
    std::error_code unknown_path;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown_path);
    if (unknown_path)
        throw Error(Fault::environment, "/proc/self/exe cannot be read, so halfframe cannot run itself as a child");
    const std::string command = shell_quoted(self.string()) + " " + arguments + " 2>/dev/null";
    FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) throw Error(Fault::environment, "no child process can be started; free some memory");
    std::string output;
    std::array<char, 65536> buffer{};
    for (std::size_t read = 0; (read = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        output.append(buffer.data(), read);
    const int status = ::pclose(pipe);
    stop_if_interrupted();
    // 1 is a budget that is exceeded: its figures are whole.
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000;
    if (code > 1 || output.empty())
        throw Error(Fault::check, fmt::format("halfframe {} failed with code {}; run it to see why", arguments, code));
    return output;
}

}  // namespace halfframe::cli
