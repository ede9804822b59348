// Child processes, pipes, and /proc.
#include "perf/peers/peer_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::peers {
namespace {

/// What /proc/PID/stat says: the parent, and user plus system time in ticks.
struct ProcessTimes {
    pid_t parent = 0;
    double ticks = 0.0;
};

std::optional<ProcessTimes> times_of(const std::filesystem::path& stat_file) {
    std::ifstream stream(stat_file);
    std::string line;
    if (!std::getline(stream, line)) return std::nullopt;       // it ended meanwhile
    std::istringstream rest(line.substr(line.rfind(')') + 1));  // a name may hold blanks and brackets
    std::string field;
    ProcessTimes times;
    for (int i = 3; i <= 15 && rest >> field; ++i) {
        if (i == 4) times.parent = std::stoi(field);
        if (i == 14 || i == 15) times.ticks += std::stod(field);
    }
    return times;
}

double seconds(double ticks) { return ticks / static_cast<double>(sysconf(_SC_CLK_TCK)); }

[[noreturn]] void become(const std::vector<std::string>& command, int in, int out, const std::string& log) {
    setpgid(0, 0);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    if (const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644); file >= 0) dup2(file, STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

}  // namespace

PeerProcess::PeerProcess(std::string name, const std::vector<std::string>& command, const std::string& log)
    : name_(std::move(name)), log_(log) {
    std::array<int, 2> orders{}, answers{};
    if (pipe2(orders.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0) {
        throw Error(Fault::environment, "no pipe could be made to talk to " + name_);
    }
    process_ = fork();
    if (process_ < 0) throw Error(Fault::environment, "no process could be started for " + name_);
    if (process_ == 0) become(command, orders[0], answers[1], log_);
    setpgid(process_, process_);  // here too: whichever comes first
    close(orders[0]);
    close(answers[1]);
    to_peer_ = orders[1];
    from_peer_ = answers[0];
}

PeerProcess::~PeerProcess() {
    close(to_peer_);  // the end of its orders is the order to stop
    close(from_peer_);
    for (int tenth = 0; tenth < 30; ++tenth) {
        if (waitpid(process_, nullptr, WNOHANG) == process_) {
            kill(-process_, SIGKILL);  // what it left behind
            return;
        }
        usleep(100'000);
    }
    kill(-process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

std::string PeerProcess::read_line(int timeout_s) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(timeout_s);
    for (;;) {
        if (const std::size_t at = unread_.find('\n'); at != std::string::npos) {
            std::string line = unread_.substr(0, at);
            unread_.erase(0, at + 1);
            return line;
        }
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        pollfd waiting{.fd = from_peer_, .events = POLLIN, .revents = 0};
        if (left.count() <= 0 || poll(&waiting, 1, static_cast<int>(left.count())) == 0) {
            throw Error(Fault::check,
                        fmt::format("{} gave no answer in {} s; its words are in {}", name_, timeout_s, log_));
        }
        std::array<char, 4096> bytes{};
        const ssize_t count = read(from_peer_, bytes.data(), bytes.size());
        if (count == 0) throw Error(Fault::check, fmt::format("{} ended; its words are in {}", name_, log_));
        if (count > 0) unread_.append(bytes.data(), static_cast<std::size_t>(count));
    }
}

nlohmann::json PeerProcess::ask(const nlohmann::json& order, int timeout_s) {
    const std::string text = order.dump() + "\n";
    if (write(to_peer_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
        throw Error(Fault::check, fmt::format("{} takes no orders; its words are in {}", name_, log_));
    }
    for (;;) {
        const auto answer = nlohmann::json::parse(read_line(timeout_s), nullptr, false);
        if (!answer.is_object()) continue;  // a library that writes to standard output
        if (answer.contains("error")) {
            throw Error(Fault::check,
                        fmt::format("{}: {}; more may be in {}", name_, answer["error"].get<std::string>(), log_));
        }
        return answer;
    }
}

double PeerProcess::processor_s() const {
    std::map<pid_t, ProcessTimes> all;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string id = entry.path().filename();
        if (id.find_first_not_of("0123456789") != std::string::npos) continue;
        if (const auto times = times_of(entry.path() / "stat")) all[std::stoi(id)] = *times;
    }
    double ticks = 0.0;
    for (const auto& [id, times] : all) {
        pid_t ancestor = id;
        while (ancestor != process_ && all.contains(ancestor)) ancestor = all[ancestor].parent;
        if (ancestor == process_) ticks += times.ticks;
    }
    return seconds(ticks);
}

int run_program(const std::vector<std::string>& command, const std::string& log) {
    const pid_t process = fork();
    if (process < 0) throw Error(Fault::environment, "no process could be started for " + command.front());
    if (process == 0) {
        const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        become(command, STDIN_FILENO, file >= 0 ? file : STDERR_FILENO, log);
    }
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

double busy_s() {
    std::ifstream stream("/proc/stat");
    std::string word;
    stream >> word;                 // "cpu", all processors together
    std::array<double, 8> ticks{};  // user nice system idle iowait irq softirq steal
    for (double& value : ticks) stream >> value;
    return seconds(ticks[0] + ticks[1] + ticks[2] + ticks[5] + ticks[6] + ticks[7]);
}

}  // namespace halfframe::peers
