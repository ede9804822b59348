// Runs a command as a child process, on fork and exec: limits and signals belong to it alone.
#include "tests/perf/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace halfframe::test {
namespace {

[[noreturn]] void become(const std::string& command, const std::vector<std::string>& arguments,
                         const ChildOptions& options, const std::string& out, const std::string& err) {
    for (const auto& [name, value] : options.environment) {
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    const int out_file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int in_file = ::open("/dev/null", O_RDONLY);
    ::dup2(in_file, STDIN_FILENO);
    ::dup2(out_file, STDOUT_FILENO);
    ::dup2(err_file, STDERR_FILENO);
    if (options.file_size_limit) {
        const rlimit limit{*options.file_size_limit, *options.file_size_limit};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> words;
    words.push_back(const_cast<char*>(command.c_str()));
    for (const std::string& argument : arguments) {
        words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    ::execv(command.c_str(), words.data());
    ::_exit(127);
}

/// Does the process have a handler for SIGINT? (SigCgt of /proc/PID/status; bit n-1 is signal n.)
bool catches_interrupt(pid_t child) {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    std::string line;
    while (std::getline(status, line)) {
        if (line.starts_with("SigCgt:")) {
            return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1u) != 0;
        }
    }
    return false;
}

void interrupt(pid_t child, int after_ms) {
    for (int tries = 0; tries < 20000 && !catches_interrupt(child); ++tries) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
    ::kill(child, SIGINT);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "halfframe_test_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error("cannot make a temporary folder like " + pattern);
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string file_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

ChildResult run_child(const std::string& command, const std::vector<std::string>& arguments,
                      const ChildOptions& options) {
    const TemporaryFolder folder;
    const std::string out = options.standard_output.value_or((folder / "out").string());
    const std::string err = (folder / "err").string();
    const pid_t child = ::fork();
    if (child < 0) {
        throw std::runtime_error("fork failed");
    }
    if (child == 0) {
        become(command, arguments, options, out, err);
    }
    if (options.interrupt_after_ms) {
        interrupt(child, *options.interrupt_after_ms);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ChildResult result;
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    result.out = options.standard_output ? "" : file_text(out);
    result.err = file_text(err);
    return result;
}

}  // namespace halfframe::test
