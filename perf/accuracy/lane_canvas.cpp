// Lanes as pixels.
#include "perf/accuracy/lane_canvas.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/draw_state.h"

namespace halfframe::accuracy {

std::string LaneCanvas::obstacle(const gl::Caps& caps) {
    if (caps.es_version < 30) {
        return fmt::format("texelFetch needs ES 3.0, and {} is ES {}.{}", caps.device, caps.es_version / 10,
                           caps.es_version % 10);
    }
    if (!caps.renders[static_cast<std::size_t>(gl::PixelFormat::rgba32f)])
        return fmt::format("{} does not render RGBA32F", caps.renderer);
    return {};
}

LaneCanvas::LaneCanvas(gl::EntryPoints& gl, const gl::Caps& caps, std::size_t lanes)
    : gl_(gl), side_(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(lanes))))), lanes_(lanes) {
    expect(lanes > 0 && side_ <= caps.max_texture_size, "a canvas has lanes, and no more than a texture has texels");
    if (caps.core_profile) {
        vertices_ = gl::create<gl::Kind::vertex_array>(gl_);
        gl_.BindVertexArray(vertices_.name());
    }
    corners_ = gl::create<gl::Kind::buffer>(gl_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, corners_.name());
    constexpr std::array<float, 6> kCorners{-1.0f, -1.0f, 3.0f, -1.0f, -1.0f, 3.0f};
    gl_.BufferData(GL_ARRAY_BUFFER, sizeof(kCorners), kCorners.data(), GL_STATIC_DRAW);
    gl_.EnableVertexAttribArray(0);
    gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    framebuffer_ = gl::create<gl::Kind::framebuffer>(gl_);
}

LaneCanvas::~LaneCanvas() {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.DisableVertexAttribArray(0);
    gl_.BindBuffer(GL_ARRAY_BUFFER, 0);
    gl_.UseProgram(0);
    if (vertices_) gl_.BindVertexArray(0);
}

gl::Texture LaneCanvas::texture(const shader_ir::Columns& columns) {
    expect(columns.size() <= 4, "a texel holds four scalars");
    std::vector<float> texels(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * 4, 0.0f);
    for (std::size_t s = 0; s < columns.size(); ++s) {
        expect(columns[s].size() == lanes_, "a column has a number for every lane");
        for (std::size_t lane = 0; lane < lanes_; ++lane) texels[lane * 4 + s] = static_cast<float>(columns[s][lane]);
    }
    return texture(gl::PixelFormat::rgba32f, texels.data());
}

gl::Texture LaneCanvas::target(gl::PixelFormat format) { return texture(format, nullptr); }

gl::Texture LaneCanvas::texture(gl::PixelFormat pixel_format, const void* texels) {
    gl::Texture result = gl::create<gl::Kind::texture>(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, result.name());
    const gl::TransferFormat format = gl::transfer_format(pixel_format, false);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), side_, side_, 0, format.format,
                   format.type, texels);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return result;
}

void LaneCanvas::bind(const gl::Texture& target) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.name(), 0);
    const std::uint32_t status = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(Fault::context, fmt::format("a target of {0}x{0} lanes cannot be drawn to (framebuffer status "
                                                "0x{1:04X}); try another --context",
                                                side_, status));
    }
    gl_.Viewport(0, 0, side_, side_);
}

void LaneCanvas::draw_to(const gl::Texture& target) {
    bind(target);
    gl_.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void LaneCanvas::blend_to(const gl::Texture& target) {
    bind(target);
    DrawState state(gl_);
    state.set_blend(Blend::alpha);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    state.set_blend(Blend::none);
}

std::vector<float> LaneCanvas::read() {
    std::vector<float> pixels(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * 4);
    gl_.ReadPixels(0, 0, side_, side_, GL_RGBA, GL_FLOAT, pixels.data());
    pixels.resize(lanes_ * 4);
    return pixels;
}

std::vector<float> LaneCanvas::read_bytes() {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * 4);
    gl_.ReadPixels(0, 0, side_, side_, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    std::vector<float> pixels;
    for (std::size_t i = 0; i < lanes_ * 4; ++i) pixels.push_back(static_cast<float>(bytes[i]) / 255.0f);
    return pixels;
}

}  // namespace halfframe::accuracy
