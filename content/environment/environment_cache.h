// Prefiltered environments kept on disk.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe::content {

/// What is kept of an environment: the map but for its name, and what was said about it.
struct StoredEnvironment {
    EnvironmentMap map;
    std::vector<std::string> notices;  ///< without the name of what they are about
};

/// Where a map made from `source` (the bytes of a file and its ending, or those of a built-in picture) lies. The name holds
/// all that decides the result: the source, the size, and the version of the filter; not what the file is called.
[[nodiscard]] std::filesystem::path cache_file(const std::filesystem::path& folder, std::string_view source, int size);

/// Nothing when there is no such file or it is not whole: it is then made anew.
[[nodiscard]] std::optional<StoredEnvironment> read_cache(const std::filesystem::path& file, int size);

/// Written beside and renamed, so that nobody reads half a file. Returns a notice when that failed.
[[nodiscard]] std::optional<std::string> write_cache(const std::filesystem::path& file,
                                                     const StoredEnvironment& stored);

}  // namespace halfframe::content
