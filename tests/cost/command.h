// The command as a child process, for the tests of what it prints.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "perf/process/child_process.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::cost {

struct Answer {
    int code = 0;
    std::string out;
    std::string err;
};

using Environment = std::vector<std::pair<std::string, std::optional<std::string>>>;

inline Answer halfframe(std::vector<std::string> arguments, const Environment& environment = {}) {
    arguments.insert(arguments.begin(), HALFFRAME_COMMAND);
    process::ChildResult result = process::run_child({.arguments = arguments, .environment = environment});
    return {result.exit_code, std::move(result.output), std::move(result.errors)};
}

/// A file in a folder of this process's own: tests run beside each other.
inline std::string temporary(const std::string& name, const std::string& text) {
    static const harness::TemporaryFolder folder;
    return folder.write(name, text).string();
}

inline void expect_in(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks " << part;
}

}  // namespace halfframe::cost
