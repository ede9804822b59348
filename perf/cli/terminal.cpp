// Notices, progress, JSON and signals.
#include "perf/cli/terminal.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace halfframe::cli {
namespace {

// The one variable a signal handler can reach; set there, read between frames, never reset.
volatile sig_atomic_t interrupted = 0;

void on_signal(int) { interrupted = 1; }

[[noreturn]] void refuse_output(int error) {
    const std::string reason = error != 0 ? std::generic_category().message(error) : "an earlier part was lost";
    throw Error(Fault::environment,
                "cannot write standard output (" + reason + "); free some space or send it elsewhere");
}

}  // namespace

void complain(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void notice(const std::string& sentence) { complain("notice: " + sentence + "\n"); }

void print(const std::string& text) {
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
        refuse_output(errno);
    }
}

void print_json(const nlohmann::ordered_json& json) {
    print(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void expect_output_written() {
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        refuse_output(errno);
    }
}

Progress::Progress() : on_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::show(const std::string& step) {
    if (on_terminal_) {
        complain("\r\033[K" + step + " ...");
        std::fflush(stderr);
        shown_ = true;
    }
}

void Progress::clear() {
    if (shown_) {
        complain("\r\033[K");
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
