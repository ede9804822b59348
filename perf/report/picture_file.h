// Pictures as files: PNG for what a display shows, EXR for linear light.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/frame/image.h"

namespace halfframe::perf {

/// 8-bit RGB PNG of a display picture; alpha is dropped. The bytes depend on the pixels alone: no date, no names.
[[nodiscard]] std::vector<std::uint8_t> png_bytes(const Picture& picture);

/// 32-bit float RGBA OpenEXR, ZIP compressed, scan lines. Values go through untouched, NaN and inf included.
[[nodiscard]] std::vector<std::uint8_t> exr_bytes(const FloatPicture& picture);

/// An 8-bit picture file as RGBA. One that is missing or broken: Error(input).
[[nodiscard]] Picture read_png(const std::filesystem::path& path);

/// The file appears whole or not at all; errors as in write_file() of perf/report/atomic_file.h.
void write_png(const std::filesystem::path& path, const Picture& picture);
void write_exr(const std::filesystem::path& path, const FloatPicture& picture);

}  // namespace halfframe::perf
