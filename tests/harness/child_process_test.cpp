// What the command tests rely on: both streams, the exit code, the environment, and the time limit.
#include "perf/process/child_process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>

namespace halfframe::harness {
namespace {

process::ChildResult shell(const std::string& script, process::ChildCommand command = {}) {
    command.arguments = {"sh", "-c", script};
    return process::run_child(command);
}

TEST(ChildProcess, BothStreamsAndTheExitCodeComeBack) {
    const process::ChildResult result = shell("echo out; echo err >&2; exit 3");
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(result.output, "out\n");
    EXPECT_EQ(result.errors, "err\n");
    EXPECT_FALSE(result.timed_out);
    EXPECT_NE(result.story().find("exit code 3"), std::string::npos);
}

TEST(ChildProcess, TheEnvironmentIsOursWithChanges) {
    ASSERT_EQ(setenv("HALFFRAME_CHILD_KEPT", "kept", 1), 0);
    ASSERT_EQ(setenv("HALFFRAME_CHILD_GONE", "gone", 1), 0);
    const process::ChildResult result =
        shell("echo \"$HALFFRAME_CHILD_KEPT $HALFFRAME_CHILD_NEW ${HALFFRAME_CHILD_GONE-unset}\"",
              {.environment = {{"HALFFRAME_CHILD_NEW", "a b=c"}, {"HALFFRAME_CHILD_GONE", std::nullopt}}});
    EXPECT_EQ(result.output, "kept a b=c unset\n");
}

TEST(ChildProcess, MuchOutputOnBothStreamsDoesNotBlock) {
    // 300 kB on each: several times a pipe's 64 kB.
    const process::ChildResult result = shell("head -c 300000 /dev/zero; head -c 300000 /dev/zero >&2");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.output.size(), 300000u);
    EXPECT_EQ(result.errors.size(), 300000u);
}

TEST(ChildProcess, TheTimeLimitEndsTheChildAndItsChildren) {
    const process::ChildResult result = shell("echo begun; sleep 600 & sleep 600; echo never", {.limit_s = 0.5});
    EXPECT_TRUE(result.timed_out);
    EXPECT_EQ(result.signal, SIGKILL);
    EXPECT_EQ(result.output, "begun\n");
}

TEST(ChildProcess, ASignalIsToldApartFromAnExitCode) {
    const process::ChildResult result = shell("kill -TERM $$");
    EXPECT_EQ(result.signal, SIGTERM);
    EXPECT_EQ(result.exit_code, -1);
}

TEST(ChildProcess, AProgramThatDoesNotExistEndsWith127) {
    EXPECT_EQ(process::run_child({.arguments = {"/no/such/program"}}).exit_code, 127);
    EXPECT_EQ(shell("true", {.folder = "/no/such/folder"}).exit_code, 127);
}

TEST(ChildProcess, TheFolderIsTheChildsAlone) {
    EXPECT_EQ(shell("pwd", {.folder = "/usr"}).output, "/usr\n");
    EXPECT_NE(shell("pwd").output, "/usr\n");
}

}  // namespace
}  // namespace halfframe::harness
