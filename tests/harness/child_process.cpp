// fork, exec and two pipes.
#include "tests/harness/child_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace halfframe::harness {
namespace {

constexpr int kNotFound = 127;  // what a shell says for a command it cannot find

std::system_error system_failure(const char* what) { return {errno, std::generic_category(), what}; }

/// Both ends of a pipe; closes what is still open.
struct Pipe {
    int read_end = -1;
    int write_end = -1;
    Pipe() {
        int ends[2];
        // Close-on-exec: a child started by another thread must not hold our write end open.
        if (pipe2(ends, O_CLOEXEC) != 0) throw system_failure("pipe2");
        read_end = ends[0];
        write_end = ends[1];
    }
    ~Pipe() {
        close_end(read_end);
        close_end(write_end);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    static void close_end(int& end) {
        if (end >= 0) close(end);
        end = -1;
    }
};

std::vector<std::string> changed_environment(const ChildCommand& command) {
    std::map<std::string, std::string> values;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string text = *entry;
        const std::size_t equals = text.find('=');
        if (equals != std::string::npos) values[text.substr(0, equals)] = text.substr(equals + 1);
    }
    for (const auto& [variable, value] : command.environment) {
        if (value) {
            values[variable] = *value;
        } else {
            values.erase(variable);
        }
    }
    std::vector<std::string> entries;
    entries.reserve(values.size());
    for (const auto& [variable, value] : values) entries.push_back(variable + "=" + value);
    return entries;
}

std::vector<char*> as_pointers(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    pointers.reserve(texts.size() + 1);
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Reads what is there; closes the end of a pipe that has ended.
void drain(int& end, std::string& into) {
    char piece[65536];
    const ssize_t count = read(end, piece, sizeof piece);
    if (count > 0) {
        into.append(piece, static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
        Pipe::close_end(end);
    }
}

/// Collects both pipes until they end; false when the time limit came first.
bool collect(Pipe& output, Pipe& errors, double limit_s, ChildResult& result) {
    using Clock = std::chrono::steady_clock;
    const auto limit =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s));
    while (output.read_end >= 0 || errors.read_end >= 0) {
        const auto left_ms = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now()).count();
        if (left_ms <= 0) return false;
        // poll ignores negative descriptors, so an ended pipe needs no special case.
        pollfd waits[2] = {{output.read_end, POLLIN, 0}, {errors.read_end, POLLIN, 0}};
        const int ready = poll(waits, 2, static_cast<int>(std::min<long>(left_ms, 1000)));
        if (ready <= 0) continue;
        if (waits[0].revents != 0) drain(output.read_end, result.output);
        if (waits[1].revents != 0) drain(errors.read_end, result.errors);
    }
    return true;
}

}  // namespace

std::string ChildResult::story() const {
    std::string text = timed_out     ? std::string("ran past its time limit")
                       : signal != 0 ? "ended by signal " + std::to_string(signal)
                                     : "exit code " + std::to_string(exit_code);
    return text + "\n--- standard output\n" + output + "\n--- standard error\n" + errors;
}

ChildResult run_child(const ChildCommand& command) {
    // All that allocates happens before fork: the child may only call what is safe after it.
    std::vector<std::string> arguments = command.arguments;
    std::vector<std::string> environment = changed_environment(command);
    std::vector<char*> argument_pointers = as_pointers(arguments);
    std::vector<char*> environment_pointers = as_pointers(environment);
    const std::string folder = command.folder.string();
    Pipe output;
    Pipe errors;

    const pid_t child = fork();
    if (child < 0) throw system_failure("fork");
    if (child == 0) {
        setpgid(0, 0);  // its own group, so that the time limit ends its children too
        dup2(output.write_end, STDOUT_FILENO);
        dup2(errors.write_end, STDERR_FILENO);
        if (folder.empty() || chdir(folder.c_str()) == 0) {
            execvpe(argument_pointers[0], argument_pointers.data(), environment_pointers.data());
        }
        _exit(kNotFound);
    }
    setpgid(child, child);  // both sides set it: whoever is first; the other's failure changes nothing
    Pipe::close_end(output.write_end);
    Pipe::close_end(errors.write_end);

    ChildResult result;
    result.timed_out = !collect(output, errors, command.limit_s, result);
    if (result.timed_out) kill(-child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) throw system_failure("waitpid");
    }
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

}  // namespace halfframe::harness
