// What the user sees while the command works: notices, progress, JSON. Only results go to standard output.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace halfframe::cli {

/// Writes to standard error and never fails: where nobody reads, there is nobody to tell.
void complain(const std::string& text);
/// "notice: ..." on standard error.
void notice(const std::string& sentence);

/// Writes to standard output.
void print(const std::string& text);
/// Indented JSON and a newline; text that is no UTF-8 is replaced, not refused.
void print_json(const nlohmann::ordered_json& json);
/// Everything printed has left this process: Error(environment) when the disk behind standard output is full.
void expect_output_written();

/// One line on standard error that is overwritten by the next step; silent when standard error is no terminal.
class Progress {
public:
    Progress();
    ~Progress();  ///< clears the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(const std::string& step);
    void clear();

private:
    bool on_terminal_;
    bool shown_ = false;
};

/// SIGINT or SIGTERM was seen at a place where it is safe to stop. The command ends with exit code 130.
struct Interrupted {};

/// From now on SIGINT and SIGTERM only set a flag, and writing past a file size limit is an error instead of the end.
void catch_signals();
/// Throws Interrupted when a signal has come. Called between steps and frames.
void stop_if_interrupted();

}  // namespace halfframe::cli
