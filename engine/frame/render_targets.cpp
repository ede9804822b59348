// Allocates what a plan draws into, and reads it back.
#include "engine/frame/render_targets.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/draw_state.h"
#include "engine/gl/pixel_format.h"

namespace halfframe {

namespace {

/// Alpha of RGB10_A2 has two bits, colours ten.
void unpack_1010102(std::uint32_t word, float* rgba) {
    for (int c = 0; c < 3; ++c) rgba[c] = static_cast<float>((word >> (10 * c)) & 1023u) / 1023.0f;
    rgba[3] = static_cast<float>(word >> 30) / 3.0f;
}

/// GL's first row is the lowest, a picture's the highest.
template <class Value>
std::vector<Value> top_down(const std::vector<Value>& bottom_up, int width, int height) {
    const std::size_t row = static_cast<std::size_t>(width) * 4;
    std::vector<Value> turned(bottom_up.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        const std::size_t from = (static_cast<std::size_t>(height) - 1 - y) * row;
        std::copy_n(bottom_up.begin() + static_cast<std::ptrdiff_t>(from), row,
                    turned.begin() + static_cast<std::ptrdiff_t>(y * row));
    }
    return turned;
}

std::size_t channels(const Target& target) {
    return static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height) * 4;
}

using Parameter = std::pair<GLenum, GLint>;

/// A compared texture answers a shader how much of the four texels round a place is nearer than what it asks about.
gl::Texture make_texture_target(gl::EntryPoints& gl, const gl::Caps& caps, const Target& target) {
    gl::Texture texture = gl::create<gl::Kind::texture>(gl);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    const auto format = gl::transfer_format(target.format, !gl::is_depth(target.format) && !caps.sized_formats);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), target.width, target.height, 0,
                  format.format, format.type, nullptr);
    const auto set = [&gl](std::initializer_list<Parameter> parameters) {
        for (const auto& [parameter, value] : parameters) gl.TexParameteri(GL_TEXTURE_2D, parameter, value);
    };
    const GLint filter = target.filtered ? GL_LINEAR : GL_NEAREST;
    set({{GL_TEXTURE_MIN_FILTER, filter},
         {GL_TEXTURE_MAG_FILTER, filter},
         {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
         {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}});
    if (target.compared)
        set({{GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE}, {GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL}});
    gl::label(gl, texture, target.name.c_str());
    return texture;
}

/// What no shader samples: depth, and what is resolved first.
gl::Renderbuffer make_renderbuffer_target(gl::EntryPoints& gl, const Target& target) {
    gl::Renderbuffer renderbuffer = gl::create<gl::Kind::renderbuffer>(gl);
    gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer.name());
    const auto format = gl::transfer_format(target.format, false);
    if (target.samples > 1) {
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, target.samples, format.internal_format, target.width,
                                          target.height);
    } else {
        gl.RenderbufferStorage(GL_RENDERBUFFER, format.internal_format, target.width, target.height);
    }
    gl::label(gl, renderbuffer, target.name.c_str());
    return renderbuffer;
}

}  // namespace

void RenderTargets::allocate(const FramePlan& plan) {
    plan_ = &plan;
    for (const Target& target : plan.targets) {
        const bool sampled = target.compared || (!gl::is_depth(target.format) && target.samples == 1);
        textures_.push_back(sampled ? make_texture_target(gl_, caps_, target) : gl::Texture{});
        renderbuffers_.push_back(sampled ? gl::Renderbuffer{} : make_renderbuffer_target(gl_, target));
        if (const std::uint32_t error = gl_.GetError(); error != GL_NO_ERROR)
            refuse(target.name, gl::error_name(error));
    }
    for (const Pass& pass : plan.passes) {
        auto found = std::ranges::find_if(framebuffers_, [&](const Attachments& made) {
            return made.color == pass.color && made.depth == pass.depth;
        });
        if (found == framebuffers_.end()) {
            framebuffers_.push_back({pass.color, pass.depth, gl::create<gl::Kind::framebuffer>(gl_)});
            found = framebuffers_.end() - 1;
            attach(found->framebuffer, pass);
        }
        framebuffer_of_pass_.push_back(found->framebuffer.name());
    }
}

void RenderTargets::attach(const gl::Framebuffer& framebuffer, const Pass& pass) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    const auto attach_one = [&](GLenum point, int index) {
        if (const auto& buffer = renderbuffers_[static_cast<std::size_t>(index)])
            gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer.name());
        else gl_.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture(index), 0);
    };
    std::string names;
    if (pass.color) {
        attach_one(GL_COLOR_ATTACHMENT0, *pass.color);
        names = target(*pass.color).name;
    }
    if (pass.depth) {
        attach_one(GL_DEPTH_ATTACHMENT, *pass.depth);
        names += (names.empty() ? "" : " with ") + target(*pass.depth).name;
    }
    gl::label(gl_, framebuffer, pass.name.c_str());
    if (const std::uint32_t status = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
        refuse(names, fmt::format("framebuffer status 0x{:04X}", status));
}

void RenderTargets::refuse(const std::string& names, const std::string& reason) const {
    throw Error(
        Fault::context,
        fmt::format(
            "the target {} of {}x{} pixels cannot be allocated on {} ({}); use a smaller --size or another --storage",
            names, plan_->width, plan_->height, caps_.renderer, reason));
}

std::uint32_t RenderTargets::framebuffer_of_color(int target) const {
    const auto found = std::ranges::find(framebuffers_, std::optional(target), &Attachments::color);
    return found != framebuffers_.end() ? found->framebuffer.name() : 0;
}

Picture RenderTargets::read_bytes(int index) const {
    const Target& from = target(index);
    std::vector<std::uint8_t> bottom_up(channels(from));
    set_known_transfer_state(gl_, caps_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_of_color(index));
    gl_.ReadPixels(0, 0, from.width, from.height, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
    return {from.width, from.height, top_down(bottom_up, from.width, from.height)};
}

FloatPicture RenderTargets::read_floats(int index) const {
    const Target& from = target(index);
    expect(!gl::is_depth(from.format), "a depth target cannot be read back as floats");
    expect(from.samples == 1, "a multisampled target cannot be read back: read what it is resolved into");
    FloatPicture picture{.width = from.width, .height = from.height, .rgba = {}};
    if (from.format == gl::PixelFormat::rgba8) {
        const Picture bytes = read_bytes(index);
        std::ranges::transform(bytes.rgba, std::back_inserter(picture.rgba),
                               [](std::uint8_t byte) { return static_cast<float>(byte) / 255.0f; });
        return picture;
    }
    std::vector<float> bottom_up(channels(from));
    set_known_transfer_state(gl_, caps_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_of_color(index));
    if (from.format == gl::PixelFormat::rgb10_a2) {
        std::vector<std::uint32_t> words(bottom_up.size() / 4);
        gl_.ReadPixels(0, 0, from.width, from.height, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, words.data());
        for (std::size_t i = 0; i < words.size(); ++i) unpack_1010102(words[i], &bottom_up[i * 4]);
    } else {
        gl_.ReadPixels(0, 0, from.width, from.height, GL_RGBA, GL_FLOAT, bottom_up.data());
    }
    picture.rgba = top_down(bottom_up, from.width, from.height);
    return picture;
}

}  // namespace halfframe
