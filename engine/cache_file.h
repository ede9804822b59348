// How a cache writes its files.
#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace halfframe {

/// Writes `content` beside `file` and renames it, so that no other process or thread reads half of it; makes the folder
/// where there is none. What went wrong is returned, with nothing left beside an older `file`.
[[nodiscard]] std::error_code write_cache_file(const std::filesystem::path& file, std::string_view content);

}  // namespace halfframe
