// Places whose depth is known, drawn by the vertex stages that write depth: one lane a pixel, seen by four cameras.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/effects/depth_prepass/depth_prepass_reference.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"
#include "engine/gl/pixel_format.h"
#include "engine/gl/program.h"
#include "perf/accuracy/function_list.h"

namespace halfframe::accuracy {

/// What the double side knows of a lane.
struct DepthTruth {
    reference::DepthRange range;
    double along_m = 0.0;  ///< before the eye, from the place as the shader gets it
};

/// Arguments of the vertex stage, by name: position and clip_from_local, the engine's matrix. Distances run from near
/// to far in even steps of their logarithm.
[[nodiscard]] std::vector<Argument> depth_arguments();
[[nodiscard]] const std::vector<DepthTruth>& depth_truths();

/// The two vertex stages that must agree.
enum class DepthStage : std::uint8_t { prepass, surface };
[[nodiscard]] gl::ProgramDescription description_of(DepthStage stage);

/// Draws every lane as a triangle inside its pixel, all three corners at the lane's distance.
class DepthCanvas {
public:
    /// All outlive the canvas; LaneCanvas::obstacle() is empty.
    DepthCanvas(gl::EntryPoints& gl, const gl::Caps& caps, std::span<const gl::ShaderFile> files = gl::shader_files());

    /// Window depth of every lane as the rasteriser has it, in fp32.
    [[nodiscard]] std::vector<double> rasterised(DepthStage stage);
    /// Window depth of every lane after a depth target of `format` held it.
    [[nodiscard]] std::vector<double> stored(DepthStage stage, gl::PixelFormat format);

private:
    /// The framebuffer stays bound while it lives.
    gl::Framebuffer draw(DepthStage stage, const char* fragment, const gl::Texture& color, const gl::Texture& depth);

    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    std::vector<gl::ShaderFile> files_;
    gl::ProgramCache programs_;
};

}  // namespace halfframe::accuracy
