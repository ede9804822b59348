// The trace: readable lines, and the same bytes in every run and in every process.
#include <gtest/gtest.h>

#include "engine/error.h"
#include "perf/process/child_process.h"
#include "tests/gl/ground.h"
#include "tests/gl/sample_frame.h"

namespace halfframe::gl {
namespace {

class CallTraceTest : public GroundTest {
protected:
    /// The trace of what `act` calls.
    template <typename Act>
    std::string trace_of(Act act) {
        gl().start_trace();
        act();
        std::string trace = gl().trace_json();
        gl().stop_trace();
        return trace;
    }
    static void expect_line(const std::string& trace, const std::string& line) {
        EXPECT_NE(trace.find("\n" + line), std::string::npos) << line << "\nis not in:\n" << trace;
    }
};

TEST_F(CallTraceTest, IsTheSameInTwoRunsOfOneProcess) {
    gl().restrict_to(caps());
    const auto frame = [&] { EXPECT_EQ(draw_sample_frame(gl(), caps())[0], 51); };
    const std::string first = trace_of(frame);
    EXPECT_GT(first.size(), 2000u);
    // The driver's own names go on rising: the trace has its own.
    EXPECT_EQ(first, trace_of(frame));
}

TEST(CallTraceProcesses, AreTheSameToTheByte) {
    const process::ChildResult first = process::run_child({.arguments = {HALFFRAME_TRACE_SAMPLE}});
    if (first.exit_code != 0) GTEST_SKIP() << "the sample found no context: " << first.errors;
    const process::ChildResult second = process::run_child({.arguments = {HALFFRAME_TRACE_SAMPLE}});
    EXPECT_NE(first.output.find("glDrawElements"), std::string::npos) << first.output;
    EXPECT_EQ(first.output, second.output);
}

TEST_F(CallTraceTest, ArgumentsAreReadable) {
    const std::string trace = trace_of([&] {
        EXPECT_EQ(draw_sample_frame(gl(), caps())[0], 51);
        gl().BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ZERO);
        gl().DepthMask(GL_FALSE);
        gl().Enable(0xFFFF);
        EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_INVALID_ENUM));
    });
    expect_line(trace, R"(["draw","glDrawElements",["GL_TRIANGLES",3,"GL_UNSIGNED_SHORT",0]])");
    expect_line(trace, R"(["draw","glUniform4fv",[)");
    EXPECT_NE(trace.find("[0.2,0.4,0.6,1]"), std::string::npos) << trace;
    expect_line(trace, R"(["draw","glClear",["GL_COLOR_BUFFER_BIT|GL_DEPTH_BUFFER_BIT"]])");
    expect_line(trace, R"(["draw","glActiveTexture",["GL_TEXTURE2"]])");
    expect_line(trace, R"(["upload","glTexParameteri",["GL_TEXTURE_2D","GL_TEXTURE_MIN_FILTER","GL_NEAREST"]])");
    // FNV-1a of four bytes 0xFF, worked out apart from the engine.
    expect_line(trace, R"(["upload","glTexImage2D",["GL_TEXTURE_2D",0,"GL_RGBA",1,1,0,"GL_RGBA","GL_UNSIGNED_BYTE",)"
                       R"({"bytes":4,"hash":"994f76653e2a3951"}]])");
    expect_line(trace, R"(["read","glReadPixels",[8,8,1,1,"GL_RGBA","GL_UNSIGNED_BYTE",{"bytes":4}]])");
    expect_line(trace, R"(["set-up","glCreateShader",["GL_VERTEX_SHADER"],)");
    expect_line(trace, R"(["set-up","glShaderSource",[)");
    expect_line(trace,
                R"(["set-up","glBlendFuncSeparate",["GL_SRC_ALPHA","GL_ONE_MINUS_SRC_ALPHA","GL_ONE","GL_ZERO"]])");
    expect_line(trace, R"(["set-up","glDepthMask",[false]])");
    expect_line(trace, R"(["set-up","glEnable",["0xFFFF"]])");
    expect_line(trace, R"(["set-up","glGetError",[]])");
    EXPECT_EQ(trace.find("0x7f"), std::string::npos) << "an address";
    EXPECT_TRUE(trace.starts_with("[\n[") && trace.ends_with("]\n]\n")) << "a JSON array, one call a line";
}

TEST_F(CallTraceTest, ObjectsHaveTheNumbersOfTheTrace) {
    GLuint names[2] = {0, 0};
    const std::string trace = trace_of([&] {
        gl().GenBuffers(2, names);
        gl().DeleteBuffers(2, names);
    });
    EXPECT_EQ(trace, "[\n[\"set-up\",\"glGenBuffers\",[2,[1,2]]],\n[\"set-up\",\"glDeleteBuffers\",[2,[1,2]]]\n]\n");
}

TEST_F(CallTraceTest, FencesAreNumbered) {
    if (!caps().fence_sync) GTEST_SKIP() << "this context has no fences";
    const std::string trace = trace_of([&] {
        for (int i = 0; i < 2; ++i) {
            GLsync sync = gl().FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
            (void)gl().ClientWaitSync(sync, GL_SYNC_FLUSH_COMMANDS_BIT, 1000);
            gl().DeleteSync(sync);
        }
    });
    expect_line(trace, R"(["set-up","glFenceSync",["GL_SYNC_GPU_COMMANDS_COMPLETE",0],1])");
    expect_line(trace, R"(["set-up","glClientWaitSync",[1,"GL_SYNC_FLUSH_COMMANDS_BIT",1000]])");
}

TEST_F(CallTraceTest, TextIsEscaped) {
    if (!caps().debug_labels) GTEST_SKIP() << "this context has no KHR_debug";
    gl().restrict_to(caps());
    const std::string trace = trace_of([&] {
        gl().begin_pass("a \"quoted\"\tpass");
        gl().end_pass();
    });
    expect_line(trace, R"(["a \"quoted\"\u0009pass","glPushDebugGroup",["GL_DEBUG_SOURCE_APPLICATION_KHR",0,-1,)"
                       R"("a \"quoted\"\u0009pass"]])");
}

TEST_F(CallTraceTest, ThereIsNoneUntilItIsOpened) {
    EXPECT_THROW((void)gl().trace_json(), Mistake);
    EXPECT_EQ(trace_of([] {}), "[\n]\n");
    EXPECT_THROW((void)gl().trace_json(), Mistake);
}

}  // namespace
}  // namespace halfframe::gl
