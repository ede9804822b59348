// The JSON files of content/, compiled into the library: an installed halfframe needs no files.
#pragma once

#include <span>
#include <string_view>

namespace halfframe::content {

struct DataFile {
    const char* path;  ///< relative to content/, e.g. "devices/es2-minimum.json"
    std::string_view text;
};

[[nodiscard]] std::span<const DataFile> data_files();

}  // namespace halfframe::content
