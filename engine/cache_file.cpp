// Written beside its place, then renamed.
#include "engine/cache_file.h"

#include <cerrno>
#include <fstream>
#include <functional>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

namespace halfframe {

std::error_code write_cache_file(const std::filesystem::path& file, std::string_view content) {
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error) return error;
    std::filesystem::path beside = file;
    // Other processes, and other threads of this one, may be at the same file.
    beside += fmt::format(".{}.{:x}.part", ::getpid(), std::hash<std::thread::id>{}(std::this_thread::get_id()));
    errno = 0;
    std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
    stream << content;
    stream.close();
    if (!stream) error = {errno != 0 ? errno : EIO, std::generic_category()};
    if (!error) std::filesystem::rename(beside, file, error);
    std::error_code ignored;
    if (error) std::filesystem::remove(beside, ignored);
    return error;
}

}  // namespace halfframe
