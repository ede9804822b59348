// Files appear whole or not at all: written beside their place, then renamed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace halfframe::perf {

/// Writes `bytes` to PATH.partial.<process id> and renames it to `path`. A disk that is full, a folder that is missing
/// or may not be written: Error(environment) that names the path, the system's words and what to try; the partial file
/// is removed and an older `path` stays as it was.
/// Not for devices and pipes: a `path` that exists and is no regular file is refused.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// Fails early, before minutes of drawing: Error(environment) when no file can be made beside `path`.
void expect_can_write(const std::filesystem::path& path);

}  // namespace halfframe::perf
