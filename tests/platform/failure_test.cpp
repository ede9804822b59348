// What the sentences say when a library or a driver is missing. Each case is a child process with a spoilt environment.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "perf/process/child_process.h"

namespace {

using halfframe::process::ChildCommand;
using halfframe::process::ChildResult;
using halfframe::process::run_child;
using Changes = std::vector<std::pair<std::string, std::optional<std::string>>>;

struct Outcome {
    int exit_code = -1;
    std::string text;
    [[nodiscard]] bool says(const std::string& words) const { return text.find(words) != std::string::npos; }
};

/// Runs try_context without a display and with `changes` to the environment.
Outcome try_context(const Changes& changes, const char* backend, const char* api = "es") {
    ChildCommand command{.arguments = {HALFFRAME_TRY_CONTEXT, backend, api},
                         .environment = {{"DISPLAY", std::nullopt}, {"WAYLAND_DISPLAY", std::nullopt}}};
    command.environment.insert(command.environment.end(), changes.begin(), changes.end());
    const ChildResult result = run_child(command);
    return {result.exit_code, result.output};
}

/// A folder of empty files with the names of libraries: the loader finds them first and cannot use them.
class Failure : public testing::Test {
protected:
    ~Failure() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Changes without(std::initializer_list<const char*> libraries) {
        std::filesystem::create_directories(folder_);
        for (const char* library : libraries) std::ofstream(folder_ / library).flush();
        return {{"LD_LIBRARY_PATH", folder_.string()}};
    }

private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        (std::string("halfframe_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
         std::to_string(getpid()));
};

/// EGL's library is there, and finds no driver behind it.
Changes no_egl_driver() { return {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}}; }

TEST_F(Failure, child_works_unspoilt) {
    const Outcome outcome = try_context({}, "auto");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_TRUE(outcome.says("egl\nEGL 1.")) << outcome.text;
    EXPECT_FALSE(outcome.says("tried:")) << outcome.text;
}

TEST_F(Failure, egl_library_missing) {
    const Outcome outcome = try_context(without({"libEGL.so.1", "libEGL.so"}), "egl");
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_TRUE(outcome.says("EGL cannot start: libEGL.so.1 cannot be opened")) << outcome.text;
    EXPECT_TRUE(outcome.says("install the Debian package libegl1\n")) << outcome.text;
}

TEST_F(Failure, egl_driver_missing) {
    for (const char* api : {"es", "desktop"}) {
        const Outcome outcome = try_context(no_egl_driver(), "egl", api);
        EXPECT_EQ(outcome.exit_code, 4);
        EXPECT_TRUE(outcome.says("EGL cannot start: no driver gives a context (")) << outcome.text;
        EXPECT_TRUE(outcome.says("install the Debian packages libegl-mesa0 and libgl1-mesa-dri\n")) << outcome.text;
    }
}

TEST_F(Failure, osmesa_library_missing) {
    const Outcome outcome = try_context(without({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}), "osmesa");
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_TRUE(outcome.says("OSMesa cannot start: libOSMesa.so.8 cannot be opened")) << outcome.text;
    EXPECT_TRUE(outcome.says("install the Debian package libosmesa6")) << outcome.text;
}

TEST_F(Failure, glfw_library_missing) {
    const Outcome outcome = try_context(without({"libglfw.so.3", "libglfw.so"}), "glfw");
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_TRUE(outcome.says("GLFW cannot start: libglfw.so.3 cannot be opened")) << outcome.text;
    EXPECT_TRUE(outcome.says("install the Debian package libglfw3\n")) << outcome.text;
}

TEST_F(Failure, glfw_without_a_display) {
    const Outcome outcome = try_context({}, "glfw");
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_TRUE(outcome.says("GLFW cannot start: ")) << outcome.text;
    EXPECT_TRUE(outcome.says("DISPLAY")) << "GLFW's own reason: " << outcome.text;
    EXPECT_TRUE(outcome.says("xvfb-run (Debian package xvfb)\n")) << outcome.text;
}

TEST_F(Failure, automatic_goes_on_to_osmesa) {
    for (const Changes& spoilt : {no_egl_driver(), without({"libEGL.so.1", "libEGL.so"})}) {
        const Outcome outcome = try_context(spoilt, "auto");
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_TRUE(outcome.says("osmesa\nOSMesa, OpenGL 4.5")) << outcome.text;
        EXPECT_TRUE(outcome.says("tried: EGL cannot start: ")) << outcome.text;
    }
}

TEST_F(Failure, automatic_without_any_says_each) {
    const Outcome outcome = try_context(without({"libEGL.so.1", "libEGL.so", "libOSMesa.so.8", "libOSMesa.so.6",
                                                 "libOSMesa.so", "libglfw.so.3", "libglfw.so"}),
                                        "auto");
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_TRUE(outcome.says("no graphics context could be made:\n  EGL cannot start: ")) << outcome.text;
    EXPECT_TRUE(outcome.says("\n  OSMesa cannot start: ")) << outcome.text;
    EXPECT_TRUE(outcome.says("\n  GLFW cannot start: ")) << outcome.text;
}

TEST_F(Failure, es2_is_taken_where_there_is_no_es3) {
    const Outcome outcome = try_context({{"MESA_GLES_VERSION_OVERRIDE", "2.0"}}, "egl");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(outcome.says("OpenGL ES 2.0")) << outcome.text;
}

}  // namespace
