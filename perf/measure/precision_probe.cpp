// What mediump really is, by drawing. Each of two operations chained: drivers may run a single mediump operation
// between 32-bit values in 32 bits. Verdicts come back as colours, so that ES 2.0 targets can carry them.
#include "perf/measure/precision_probe.h"

#include <array>
#include <cstdint>

#include "engine/error.h"
#include "engine/gl/object.h"
#include "engine/gl/pixel_format.h"
#include "engine/gl/program.h"

namespace halfframe::perf {
namespace {

/// A one-pixel RGBA8 target and a triangle over it.
class PixelTarget {
public:
    PixelTarget(gl::EntryPoints& gl, const gl::Caps& caps) : gl_(gl) {
        if (caps.core_profile) {
            vertices_ = gl::create<gl::Kind::vertex_array>(gl);
            gl.BindVertexArray(vertices_.name());
        }
        texture_ = gl::create<gl::Kind::texture>(gl);
        gl.BindTexture(GL_TEXTURE_2D, texture_.name());
        const gl::TransferFormat format = gl::transfer_format(gl::PixelFormat::rgba8, !caps.sized_formats);
        gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), 1, 1, 0, format.format, format.type,
                      nullptr);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        framebuffer_ = gl::create<gl::Kind::framebuffer>(gl);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
        if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
            throw Error(Fault::context,
                        "this context cannot draw to a 1x1 RGBA8 texture, which every ES 2.0 can; try "
                        "another --context");
        }
        corners_ = gl::create<gl::Kind::buffer>(gl);
        gl.BindBuffer(GL_ARRAY_BUFFER, corners_.name());
        constexpr std::array<float, 6> kCorners{-1.0f, -1.0f, 3.0f, -1.0f, -1.0f, 3.0f};
        gl.BufferData(GL_ARRAY_BUFFER, sizeof(kCorners), kCorners.data(), GL_STATIC_DRAW);
        gl.EnableVertexAttribArray(0);
        gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        gl.Viewport(0, 0, 1, 1);
    }
    ~PixelTarget() {
        gl_.DisableVertexAttribArray(0);
        gl_.BindBuffer(GL_ARRAY_BUFFER, 0);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
        gl_.BindTexture(GL_TEXTURE_2D, 0);
        gl_.UseProgram(0);
        if (vertices_) {
            gl_.BindVertexArray(0);
        }
    }
    PixelTarget(const PixelTarget&) = delete;
    PixelTarget& operator=(const PixelTarget&) = delete;

    [[nodiscard]] std::array<std::uint8_t, 4> drawn() {
        gl_.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
        gl_.Clear(GL_COLOR_BUFFER_BIT);
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
        std::array<std::uint8_t, 4> pixel{};
        gl_.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
        return pixel;
    }

private:
    gl::EntryPoints& gl_;
    gl::VertexArray vertices_;
    gl::Texture texture_;
    gl::Framebuffer framebuffer_;
    gl::Buffer corners_;
};

ArithmeticProbe probe(gl::EntryPoints& gl, const gl::Caps& caps, gl::ProgramCache& programs, PixelTarget& target,
                      gl::Arithmetic arithmetic) {
    gl::ProgramDescription description;
    description.name = "precision_probe";
    description.vertex = "probe/precision.vert";
    description.fragment = "probe/precision.frag";
    description.dialect = caps.es_version >= 30 ? gl::Dialect::es300 : gl::Dialect::es100;
    description.arithmetic = arithmetic;
    description.fragment_highp = caps.fragment_highp;
    description.attributes = {{"position", 0}};
    gl::Program& program = programs.get(description);
    gl.UseProgram(program.name());
    // Uniforms, since a compiler would fold constants in its own precision.
    constexpr std::array<float, 4> kSmall{0x1p-12f, 0x1p-14f, 0x1p-5f, 0x1p10f};
    constexpr std::array<float, 4> kLarge{300.0f, 0.001f, 1.0f, 0.0f};
    gl.Uniform4fv(program.uniform("small"), 1, kSmall.data());
    gl.Uniform4fv(program.uniform("large"), 1, kLarge.data());
    program.expect_all_uniforms_claimed();

    const std::array<std::uint8_t, 4> pixel = target.drawn();
    ArithmeticProbe seen;
    seen.drawn = pixel[3] == 255;
    seen.overflow = pixel[0] > 192 ? Overflow::to_infinity : pixel[0] > 64 ? Overflow::clamps : Overflow::none;
    seen.loses_small_steps = pixel[1] > 128;
    seen.keeps_subnormals = pixel[2] > 128;
    return seen;
}

std::string sentence_of(const PrecisionProbe& probe, bool has_highp) {
    if (!probe.mediump.drawn || !probe.highp.drawn) {
        return "the probe was not drawn, so nothing is known of mediump here";
    }
    if (!probe.mediump.is_half()) {
        return "mediump runs in single precision here: half arithmetic can be asked for and changes nothing";
    }
    std::string text = "mediump is half precision";
    text += probe.mediump.overflow == Overflow::to_infinity ? ": it overflows to inf"
            : probe.mediump.overflow == Overflow::clamps    ? ": it clamps above 65504"
                                                            : ", but its range is wider";
    text += probe.mediump.keeps_subnormals ? " and keeps subnormals" : " and flushes subnormals to 0";
    if (!has_highp) {
        text += ", and fragments have nothing better";
    } else if (probe.highp.is_half()) {
        text += "; highp is no better here";
    }
    return text;
}

}  // namespace

PrecisionProbe probe_precision(gl::EntryPoints& gl, const gl::Caps& caps) {
    const gl::PassScope pass(gl, "precision_probe");
    PixelTarget target(gl, caps);
    gl::ProgramCache programs(gl, caps, {});
    PrecisionProbe result;
    result.mediump = probe(gl, caps, programs, target, gl::Arithmetic::half);
    result.highp = caps.fragment_highp ? probe(gl, caps, programs, target, gl::Arithmetic::full) : result.mediump;
    result.sentence = sentence_of(result, caps.fragment_highp);
    return result;
}

}  // namespace halfframe::perf
