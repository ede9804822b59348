// A peer as a child process that takes orders and gives answers, one JSON object a line, and its processor time.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>
#include <nlohmann/json.hpp>

namespace halfframe::peers {

/// Starts the peer in a process group of its own, kills the whole group when destroyed.
class PeerProcess {
public:
    /// `log`: file that takes the peer's standard error.
    PeerProcess(std::string name, const std::vector<std::string>& command, const std::string& log);
    ~PeerProcess();
    PeerProcess(const PeerProcess&) = delete;
    PeerProcess& operator=(const PeerProcess&) = delete;

    /// Sends `order` and waits for the answer. An answer with "error", no answer in `timeout_s`, or an end of the
    /// process: Error(check) with the peer's name, its words and the place of its log.
    nlohmann::json ask(const nlohmann::json& order, int timeout_s);

    /// User and system time of the peer and of every process it started and still has [s], to 10 ms.
    [[nodiscard]] double processor_s() const;
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    [[nodiscard]] std::string read_line(int timeout_s);

    std::string name_;
    std::string log_;
    pid_t process_ = -1;
    int to_peer_ = -1;
    int from_peer_ = -1;
    std::string unread_;
};

/// Runs a program to its end, both outputs into `log`: its exit code, or 128 and more where a signal ended it.
int run_program(const std::vector<std::string>& command, const std::string& log);

/// Time all processors of the machine together were busy since it started, for whomever [s]; stolen time counts.
[[nodiscard]] double busy_s();

}  // namespace halfframe::peers
