// The few GL calls that prove a context draws: clear, draw a shader, count samples, read back. Made from its loader
// alone.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <GLES3/gl3.h>

#include "platform/context.h"

namespace halfframe::platform::test {

using Pixel = std::array<std::uint8_t, 4>;

/// Draws to a 64x64 RGBA8 renderbuffer of its own. The context is current on every call.
class Probe {
public:
    static constexpr int kSize = 64;

    explicit Probe(const Context& context) : context_(context) {
        GLuint name = 0;
        if (desktop()) {  // a core profile draws nothing without one
            call<decltype(&glGenVertexArrays)>("glGenVertexArrays")(1, &name);
            call<decltype(&glBindVertexArray)>("glBindVertexArray")(name);
        }
        call<decltype(&glGenRenderbuffers)>("glGenRenderbuffers")(1, &name);
        call<decltype(&glBindRenderbuffer)>("glBindRenderbuffer")(GL_RENDERBUFFER, name);
        call<decltype(&glRenderbufferStorage)>("glRenderbufferStorage")(GL_RENDERBUFFER, GL_RGBA8, kSize, kSize);
        GLuint framebuffer = 0;
        call<decltype(&glGenFramebuffers)>("glGenFramebuffers")(1, &framebuffer);
        call<decltype(&glBindFramebuffer)>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer);
        call<decltype(&glFramebufferRenderbuffer)>("glFramebufferRenderbuffer")(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                                                                GL_RENDERBUFFER, name);
        call<decltype(&glViewport)>("glViewport")(0, 0, kSize, kSize);
        if (call<decltype(&glCheckFramebufferStatus)>("glCheckFramebufferStatus")(GL_FRAMEBUFFER) !=
            GL_FRAMEBUFFER_COMPLETE) {
            throw std::runtime_error("the framebuffer is not complete");
        }
    }

    [[nodiscard]] std::string version() const { return text(GL_VERSION); }
    [[nodiscard]] bool desktop() const { return !version().starts_with("OpenGL ES"); }
    [[nodiscard]] bool enabled(GLenum capability) const {
        return call<decltype(&glIsEnabled)>("glIsEnabled")(capability) == GL_TRUE;
    }
    [[nodiscard]] GLenum error() const { return call<decltype(&glGetError)>("glGetError")(); }

    void clear(float red, float green, float blue) const {
        call<decltype(&glClearColor)>("glClearColor")(red, green, blue, 1.0f);
        call<decltype(&glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    }

    [[nodiscard]] Pixel read(int x, int y) const {
        Pixel pixel{};
        call<decltype(&glReadPixels)>("glReadPixels")(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
        return pixel;
    }

    /// Links the two texts and uses them; throws with the driver's log.
    void use(const std::string& vertex, const std::string& fragment) const {
        const GLuint program = call<decltype(&glCreateProgram)>("glCreateProgram")();
        attach(program, GL_VERTEX_SHADER, vertex);
        attach(program, GL_FRAGMENT_SHADER, fragment);
        call<decltype(&glBindAttribLocation)>("glBindAttribLocation")(program, 0, "position");
        call<decltype(&glLinkProgram)>("glLinkProgram")(program);
        GLint linked = 0;
        call<decltype(&glGetProgramiv)>("glGetProgramiv")(program, GL_LINK_STATUS, &linked);
        if (linked == 0) throw std::runtime_error("the program does not link");
        call<decltype(&glUseProgram)>("glUseProgram")(program);
    }

    /// Draws the left half of the target, two triangles, with the program in use.
    void draw_left_half() const {
        constexpr float kCorners[] = {-1, -1, 0, -1, -1, 1, 0, 1};
        GLuint buffer = 0;
        call<decltype(&glGenBuffers)>("glGenBuffers")(1, &buffer);
        call<decltype(&glBindBuffer)>("glBindBuffer")(GL_ARRAY_BUFFER, buffer);
        call<decltype(&glBufferData)>("glBufferData")(GL_ARRAY_BUFFER, sizeof kCorners, kCorners, GL_STATIC_DRAW);
        call<decltype(&glEnableVertexAttribArray)>("glEnableVertexAttribArray")(0);
        call<decltype(&glVertexAttribPointer)>("glVertexAttribPointer")(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        call<decltype(&glDrawArrays)>("glDrawArrays")(GL_TRIANGLE_STRIP, 0, 4);
    }

    /// Samples that pass while the left half is drawn; desktop contexts only.
    [[nodiscard]] GLuint samples_of_left_half() const {
        constexpr GLenum kSamplesPassed = 0x8914;  // desktop GL
        GLuint query = 0;
        call<decltype(&glGenQueries)>("glGenQueries")(1, &query);
        call<decltype(&glBeginQuery)>("glBeginQuery")(kSamplesPassed, query);
        draw_left_half();
        call<decltype(&glEndQuery)>("glEndQuery")(kSamplesPassed);
        GLuint samples = 0;
        call<decltype(&glGetQueryObjectuiv)>("glGetQueryObjectuiv")(query, GL_QUERY_RESULT, &samples);
        return samples;
    }

private:
    template <typename Function>
    [[nodiscard]] Function call(const char* name) const {
        void* address = context_.function(name);
        if (address == nullptr) throw std::runtime_error(std::string("no function ") + name);
        return reinterpret_cast<Function>(address);
    }

    [[nodiscard]] std::string text(GLenum what) const {
        const auto* bytes = call<decltype(&glGetString)>("glGetString")(what);
        return bytes == nullptr ? "" : reinterpret_cast<const char*>(bytes);
    }

    void attach(GLuint program, GLenum stage, const std::string& source) const {
        const GLuint shader = call<decltype(&glCreateShader)>("glCreateShader")(stage);
        const char* pointer = source.c_str();
        call<decltype(&glShaderSource)>("glShaderSource")(shader, 1, &pointer, nullptr);
        call<decltype(&glCompileShader)>("glCompileShader")(shader);
        GLint compiled = 0;
        call<decltype(&glGetShaderiv)>("glGetShaderiv")(shader, GL_COMPILE_STATUS, &compiled);
        if (compiled == 0) {
            std::array<char, 1024> log{};
            call<decltype(&glGetShaderInfoLog)>("glGetShaderInfoLog")(shader, static_cast<GLsizei>(log.size()), nullptr,
                                                                      log.data());
            throw std::runtime_error(log.data());
        }
        call<decltype(&glAttachShader)>("glAttachShader")(program, shader);
    }

    const Context& context_;
};

// Orange from both languages, in values that 8 bits hold exactly.
inline constexpr const char* kVertex100 =
    "#version 100\nattribute vec2 position;\nvoid main() { gl_Position = vec4(position, 0.0, 1.0); }\n";
inline constexpr const char* kFragment100 =
    "#version 100\nprecision mediump float;\nvoid main() { gl_FragColor = vec4(1.0, 0.6, 0.2, 1.0); }\n";
inline constexpr const char* kVertex300 =
    "#version 300 es\nin vec2 position;\nvoid main() { gl_Position = vec4(position, 0.0, 1.0); }\n";
inline constexpr const char* kFragment300 =
    "#version 300 es\nprecision highp float;\nout vec4 color;\nvoid main() { color = vec4(0.2, 0.6, 1.0, 1.0); }\n";
inline constexpr Pixel kOrange{255, 153, 51, 255};
inline constexpr Pixel kBlue{51, 153, 255, 255};

}  // namespace halfframe::platform::test
