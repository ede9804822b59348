// A user's own fragment shader: ES 1.00 or 3.00, whatever file it is in.
#pragma once

#include <string>
#include <vector>

#include "perf/cost/counted_frame.h"

namespace halfframe::cost {

/// Which precision the text is read with.
enum class Precisions : std::uint8_t {
    as_written,
    half,  ///< every highp read as mediump
    full,  ///< every mediump and lowp read as highp
};
[[nodiscard]] const char* name(Precisions precisions);

/// Compiles the text of `file`. ES 1.00 (no #version, or 100) is checked as such and counted as its ES 3.00 twin.
/// Error(check) naming file and line for what does not compile; Error(input) for another #version.
[[nodiscard]] CountedStage count_user_shader(const std::string& file, const std::string& text, Precisions precisions);

/// "name=rgba16f" or "name=rgba8,trilinear".
struct UserTexture {
    std::string sampler;
    gl::PixelFormat format = gl::PixelFormat::rgba8;
    bool trilinear = false;
};
/// Error(usage) that lists the formats.
[[nodiscard]] UserTexture parse_user_texture(const std::string& words);
[[nodiscard]] gl::PixelFormat parse_color_format(const std::string& words, const std::string& option);

/// The shader as a pass over the screen. A texture that is named and not read: Error(usage) with those that are.
[[nodiscard]] PassWork user_pass(const ShaderCounts& counts, const std::vector<UserTexture>& textures,
                                 const TargetWork& target);

}  // namespace halfframe::cost
