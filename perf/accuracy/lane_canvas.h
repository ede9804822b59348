// A square of pixels on a real context, one lane each: float textures in, a target out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"
#include "engine/gl/pixel_format.h"
#include "engine/gl/program.h"
#include "perf/shader_ir/evaluate.h"

namespace halfframe::accuracy {

class LaneCanvas {
public:
    /// Why this device cannot carry lanes, as half a sentence; empty when it can. It takes texelFetch and RGBA32F
    /// targets.
    [[nodiscard]] static std::string obstacle(const gl::Caps& caps);

    /// `gl` and `caps` outlive the canvas. Its buffers stay bound until it goes.
    LaneCanvas(gl::EntryPoints& gl, const gl::Caps& caps, std::size_t lanes);
    ~LaneCanvas();
    LaneCanvas(const LaneCanvas&) = delete;
    LaneCanvas& operator=(const LaneCanvas&) = delete;

    /// The values of up to four columns as an RGBA32F texture; what a column does not give is 0.
    [[nodiscard]] gl::Texture texture(const shader_ir::Columns& columns);
    [[nodiscard]] gl::Texture target(gl::PixelFormat format);

    /// Clears `target` and runs the program in use over all lanes. It stays bound for reading.
    void draw_to(const gl::Texture& target);
    /// Runs it over what `target` holds, blended as translucent surfaces are.
    void blend_to(const gl::Texture& target);
    /// RGBA of every lane of the target drawn last: of a float target, and of an RGBA8 one [0..1].
    [[nodiscard]] std::vector<float> read();
    [[nodiscard]] std::vector<float> read_bytes();

    /// Attribute locations of programs that run here; their vertex stage is probe/precision.vert or tone_map.vert.
    static std::vector<std::pair<std::string, int>> attributes() { return {{"position", 0}}; }

private:
    [[nodiscard]] gl::Texture texture(gl::PixelFormat format, const void* texels);
    void bind(const gl::Texture& target);

    gl::EntryPoints& gl_;
    int side_;
    std::size_t lanes_;
    gl::VertexArray vertices_;
    gl::Buffer corners_;
    gl::Framebuffer framebuffer_;
};

}  // namespace halfframe::accuracy
