// One small frame that uses most of the table: a textured triangle in a 16x16 target, read back.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/gl/entry_points.h"
#include "engine/gl/program.h"

namespace halfframe::gl {

inline constexpr int kSampleSize = 16;  ///< pixels, each way

/// The shader files of the sample; not those of the renderer.
[[nodiscard]] std::span<const ShaderFile> sample_files();
[[nodiscard]] ProgramDescription sample_program(Dialect dialect);

/// Draws in the passes "upload", "draw" and "read", makes every object anew and deletes it again.
/// Returns the RGBA8 pixel in the middle: 51, 102, 153, 255 where everything worked.
[[nodiscard]] std::array<std::uint8_t, 4> draw_sample_frame(EntryPoints& gl, const Caps& caps);

}  // namespace halfframe::gl
