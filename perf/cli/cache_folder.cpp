// The cache folder of the user.
#include "perf/cli/cache_folder.h"

#include <cstdlib>

namespace halfframe::cli {

std::filesystem::path cache_folder(const std::string& wished) {
    if (wished == "none") return {};
    if (!wished.empty()) return wished;
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value != nullptr ? value : "");
    };
    if (const auto cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "halfframe";
    if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "halfframe";
    return {};
}

}  // namespace halfframe::cli
