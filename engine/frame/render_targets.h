// Textures, renderbuffers and framebuffers that a plan draws into.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/frame/frame_plan.h"
#include "engine/frame/image.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"

namespace halfframe {

class RenderTargets {
public:
    RenderTargets(gl::EntryPoints& gl, const gl::Caps& caps) : gl_(gl), caps_(caps) {}

    /// Makes every target of `plan`, and one framebuffer for each pair that a pass binds. `plan` must outlive this.
    /// Throws Error(context) when one cannot be allocated, naming it and its size.
    void allocate(const FramePlan& plan);

    [[nodiscard]] std::uint32_t framebuffer_of_pass(std::size_t pass) const { return framebuffer_of_pass_[pass]; }
    [[nodiscard]] std::uint32_t framebuffer_of_color(int target) const;
    [[nodiscard]] std::uint32_t texture(int target) const { return textures_[static_cast<std::size_t>(target)].name(); }

    [[nodiscard]] Picture read_bytes(int target) const;        ///< of an 8-bit target
    [[nodiscard]] FloatPicture read_floats(int target) const;  ///< of any colour target that is not multisampled

private:
    struct Attachments {
        std::optional<int> color;
        std::optional<int> depth;
        gl::Framebuffer framebuffer;
    };
    void attach(const gl::Framebuffer& framebuffer, const Pass& pass);
    [[noreturn]] void refuse(const std::string& names, const std::string& reason) const;
    [[nodiscard]] const Target& target(int index) const { return plan_->targets.at(static_cast<std::size_t>(index)); }

    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    const FramePlan* plan_ = nullptr;
    std::vector<gl::Texture> textures_;            ///< by target; empty for what is in a renderbuffer
    std::vector<gl::Renderbuffer> renderbuffers_;  ///< by target; empty for what is in a texture
    std::vector<Attachments> framebuffers_;
    std::vector<std::uint32_t> framebuffer_of_pass_;
};

}  // namespace halfframe
