// fork, exec and two pipes.
#include "perf/process/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/error.h"

namespace halfframe::process {
namespace {

constexpr int kNotFound = 127;  // what a shell says for a command it cannot find
constexpr int kWait_ms = 10;    // between two calls of `between`
/// More of an output than this is not kept [bytes]: a child that babbles must not fill our memory.
constexpr std::size_t kMostKept = 16u << 20;

/// A pipe that the child writes into and we read from.
class Pipe {
public:
    Pipe() {
        // Close-on-exec: a child started by another thread must not hold our write end open.
        if (pipe2(ends_.data(), O_CLOEXEC) != 0)
            throw Error(Fault::environment, "no pipe to a child process could be made; close other programs");
    }
    ~Pipe() {
        close_end(ends_[0]);
        close_end(ends_[1]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    [[nodiscard]] int read_end() const { return ends_[0]; }
    [[nodiscard]] int write_end() const { return ends_[1]; }
    void child_has_it() { close_end(ends_[1]); }
    /// Reads what is there; closes the end of a pipe that has ended.
    void read_into(std::string& text) {
        std::array<char, 65536> piece;
        const ssize_t count = read(ends_[0], piece.data(), piece.size());
        if (count > 0 && text.size() < kMostKept) text.append(piece.data(), static_cast<std::size_t>(count));
        if (count == 0 || (count < 0 && errno != EINTR)) close_end(ends_[0]);
    }

private:
    static void close_end(int& end) {
        if (end >= 0) close(end);
        end = -1;
    }
    std::array<int, 2> ends_{-1, -1};
};

/// The child with its group; both end with this at the latest.
class Child {
public:
    // Both sides make the group: whoever is first; the other's failure changes nothing.
    explicit Child(pid_t id) : id_(id) { setpgid(id, id); }
    ~Child() {
        if (id_ > 0) (void)end(true);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    [[nodiscard]] pid_t id() const { return id_; }
    /// Waits for the end, after killing where `by_force`; returns the status of waitpid().
    int end(bool by_force) {
        if (by_force) kill(-id_, SIGKILL);
        int status = 0;
        while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {}
        kill(-id_, SIGKILL);  // what it left behind
        id_ = -1;
        return status;
    }

private:
    pid_t id_;
};

std::vector<std::string> changed_environment(const ChildCommand& command) {
    std::map<std::string, std::string> values;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string text = *entry;
        const std::size_t equals = text.find('=');
        if (equals != std::string::npos) values[text.substr(0, equals)] = text.substr(equals + 1);
    }
    for (const auto& [variable, value] : command.environment) {
        if (value) values[variable] = *value;
        else values.erase(variable);
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

/// All that the child needs, allocated before fork: afterwards it may only call what is safe there.
struct Prepared {
    explicit Prepared(const ChildCommand& command)
        : arguments(command.arguments), environment(changed_environment(command)), folder(command.folder.string()) {
        if (command.standard_output) output_file = command.standard_output->string();
    }
    std::vector<std::string> arguments;
    std::vector<std::string> environment;
    std::vector<char*> argument_pointers = as_pointers(arguments);
    std::vector<char*> environment_pointers = as_pointers(environment);
    std::string folder;
    std::string output_file;
};

void limit(decltype(RLIMIT_FSIZE) what, const std::optional<std::size_t>& most) {
    if (!most) return;
    const rlimit value{*most, *most};
    setrlimit(what, &value);
}

[[noreturn]] void become(const ChildCommand& command, Prepared& prepared, const Pipe& output, const Pipe& errors) {
    setpgid(0, 0);
    const int empty = open("/dev/null", O_RDONLY);
    dup2(empty, STDIN_FILENO);
    const int file = prepared.output_file.empty()
                         ? output.write_end()
                         : open(prepared.output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    dup2(file, STDOUT_FILENO);
    dup2(errors.write_end(), STDERR_FILENO);
    limit(RLIMIT_FSIZE, command.file_size_limit);
    limit(RLIMIT_AS, command.memory_limit);
    if (file >= 0 && (prepared.folder.empty() || chdir(prepared.folder.c_str()) == 0))
        execvpe(prepared.argument_pointers[0], prepared.argument_pointers.data(), prepared.environment_pointers.data());
    _exit(kNotFound);
}

/// Collects both pipes until they end; false when the time limit came first.
bool collect(const ChildCommand& command, pid_t child, Pipe& output, Pipe& errors, ChildResult& result) {
    using Clock = std::chrono::steady_clock;
    const auto limit =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(command.limit_s));
    while (output.read_end() >= 0 || errors.read_end() >= 0) {
        const auto left_ms = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now()).count();
        if (left_ms <= 0) return false;
        if (command.between) command.between(child);
        // poll() passes over a negative descriptor, so that an ended pipe needs no case of its own.
        std::array<pollfd, 2> waits{{{output.read_end(), POLLIN, 0}, {errors.read_end(), POLLIN, 0}}};
        if (poll(waits.data(), waits.size(), static_cast<int>(std::min<long>(left_ms, kWait_ms))) <= 0) continue;
        if (waits[0].revents != 0) output.read_into(result.output);
        if (waits[1].revents != 0) errors.read_into(result.errors);
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
    Prepared prepared(command);
    Pipe output;
    Pipe errors;
    const pid_t id = fork();
    if (id < 0) throw Error(Fault::environment, "no child process could be started; close other programs");
    if (id == 0) become(command, prepared, output, errors);
    Child child(id);
    output.child_has_it();
    errors.child_has_it();
    ChildResult result;
    result.timed_out = !collect(command, id, output, errors, result);
    const int status = child.end(result.timed_out);
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

}  // namespace halfframe::process
