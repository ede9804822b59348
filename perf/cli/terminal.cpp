// Notices, progress, JSON and signals.
#include "perf/cli/terminal.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace halfframe::cli {
namespace {

// The one variable a signal handler can reach; set there, read between frames, never reset.
volatile sig_atomic_t interrupted = 0;

void on_signal(int) { interrupted = 1; }

}  // namespace

void notice(const std::string& sentence) { fmt::print(stderr, "notice: {}\n", sentence); }

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_json(const nlohmann::ordered_json& json) {
    print(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void expect_output_written() {
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw Error(Fault::environment, "cannot write standard output (" + std::generic_category().message(errno) +
                                            "); free some space or send it elsewhere");
    }
}

Progress::Progress() : on_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::show(const std::string& step) {
    if (on_terminal_) {
        fmt::print(stderr, "\r\033[K{} ...", step);
        std::fflush(stderr);
        shown_ = true;
    }
}

void Progress::clear() {
    if (shown_) {
        fmt::print(stderr, "\r\033[K");
        std::fflush(stderr);
        shown_ = false;
    }
}

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &ignore, nullptr);
}

void stop_if_interrupted() {
    if (interrupted != 0) {
        throw Interrupted{};
    }
}

}  // namespace halfframe::cli
