// Draws counted one by one on a context: the count of each is that of its own pixels, however many came before.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/object.h"
#include "perf/cost/draw_recorder.h"
#include "platform/context.h"

namespace halfframe::cost {
namespace {

constexpr int kSize = 4096;
/// llvmpipe writes where a count starts and ends into the lists of all 4096 tiles, which next to nothing else is in,
/// and draws what it has where 36 MiB of lists are full: here within the end of the 175th count, and again 174 counts
/// later.
constexpr int kDraws = 400;
constexpr int kSquare = 32;

/// A square in two corners of the target, whose tiles are the first and the last: twelve vertices out of nothing.
constexpr const char* kVertex = R"(#version 300 es
void main() {
    int corner = gl_VertexID % 6;
    vec2 place = vec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5) / 64.0;
    gl_Position = vec4(gl_VertexID < 6 ? place - 1.0 : 1.0 - place, 0.0, 1.0);
}
)";
constexpr const char* kFragment = R"(#version 300 es
layout(location = 0) out mediump vec4 color;
void main() { color = vec4(1.0); }
)";

GLuint program_of(gl::EntryPoints& gl) {
    const GLuint program = gl.CreateProgram();
    for (const auto& [kind, text] : {std::pair{GL_VERTEX_SHADER, kVertex}, std::pair{GL_FRAGMENT_SHADER, kFragment}}) {
        const GLuint shader = gl.CreateShader(static_cast<GLenum>(kind));
        gl.ShaderSource(shader, 1, &text, nullptr);
        gl.CompileShader(shader);
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader);
    }
    gl.LinkProgram(program);
    return program;
}

TEST(DrawRecorder, CountsNoDrawForAnother) {
    std::unique_ptr<platform::Context> context;
    try {
        context = std::make_unique<platform::Context>(
            platform::Context::create({.backend = platform::Backend::egl, .api = platform::Api::desktop}));
    } catch (const platform::ContextError& error) {
        GTEST_SKIP() << error.what();
    }
    DrawRecorder recorder(context->loader());
    gl::EntryPoints gl(recorder.loader());
    const gl::VertexArray vertices = gl::create<gl::Kind::vertex_array>(gl);
    const gl::Renderbuffer target = gl::create<gl::Kind::renderbuffer>(gl);
    const gl::Framebuffer framebuffer = gl::create<gl::Kind::framebuffer>(gl);
    gl.BindVertexArray(vertices.name());
    gl.BindRenderbuffer(GL_RENDERBUFFER, target.name());
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_R8, kSize, kSize);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target.name());
    gl.Viewport(0, 0, kSize, kSize);
    const GLuint program = program_of(gl);
    gl.UseProgram(program);

    recorder.start([] { return std::string("squares"); }, [](std::uint32_t) { return false; });
    for (int i = 0; i < kDraws; ++i) gl.DrawArrays(GL_TRIANGLES, 0, 12);
    const std::vector<RecordedDraw> draws = recorder.finish();
    ASSERT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    ASSERT_EQ(draws.size(), static_cast<std::size_t>(kDraws));
    for (int i = 0; i < kDraws; ++i)
        EXPECT_EQ(draws[static_cast<std::size_t>(i)].samples_written, 2u * kSquare * kSquare) << "draw " << i;
    gl.UseProgram(0);
    gl.DeleteProgram(program);
}

}  // namespace
}  // namespace halfframe::cost
