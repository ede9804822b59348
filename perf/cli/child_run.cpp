// fork, exec and two pipes.
#include "perf/cli/child_run.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>

#include "engine/error.h"

namespace halfframe::cli {
namespace {

constexpr const char* kThisProgram = "/proc/self/exe";
constexpr int kWait_ms = 100;
/// More of an output than this is not kept [bytes]: a child that babbles must not fill our memory.
constexpr std::size_t kMostKept = 16u << 20;

/// A pipe to read what the child writes.
class Pipe {
public:
    Pipe() {
        if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
            throw Error(Fault::environment, "no pipe to a child process could be made; close other programs");
        }
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
    void read_into(std::string& text) {
        std::array<char, 65536> piece{};
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
    explicit Child(pid_t id) : id_(id) { setpgid(id, id); }
    ~Child() {
        if (id_ > 0) (void)end(true);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
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

}  // namespace

ChildRun run_self(const std::vector<std::string>& words, double limit_s, const std::function<void()>& between) {
    using Clock = std::chrono::steady_clock;
    // All that allocates happens before fork: the child may only call what is safe after it.
    std::vector<char*> arguments{const_cast<char*>("halfframe")};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    Pipe out;
    Pipe err;
    const pid_t id = fork();
    if (id < 0) throw Error(Fault::environment, "no child process could be started; close other programs");
    if (id == 0) {
        setpgid(0, 0);
        dup2(out.write_end(), STDOUT_FILENO);
        dup2(err.write_end(), STDERR_FILENO);
        execv(kThisProgram, arguments.data());
        _exit(127);
    }
    Child child(id);
    out.child_has_it();
    err.child_has_it();
    ChildRun run;
    const auto limit = Clock::now() + std::chrono::duration<double>(limit_s);
    while (!run.timed_out && (out.read_end() >= 0 || err.read_end() >= 0)) {
        between();
        // poll() passes over a negative descriptor, so that an ended pipe needs no case of its own.
        std::array<pollfd, 2> waits{{{out.read_end(), POLLIN, 0}, {err.read_end(), POLLIN, 0}}};
        if (poll(waits.data(), waits.size(), kWait_ms) > 0) {
            if (waits[0].revents != 0) out.read_into(run.out);
            if (waits[1].revents != 0) err.read_into(run.err);
        }
        run.timed_out = Clock::now() > limit;
    }
    const int status = child.end(run.timed_out);
    if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
    return run;
}

}  // namespace halfframe::cli
