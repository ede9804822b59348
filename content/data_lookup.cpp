// Data files by name (compiled in) or by path.
#include "content/data_lookup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "content/data_files.h"
#include "content/nearest.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

// A device or a budget has a few kilobytes.
constexpr std::uint64_t kMostBytes = 1u << 20;

/// "es2-minimum" of "devices/es2-minimum.json" when it lies in `folder`, else nothing.
std::string_view name_in(std::string_view folder, std::string_view path) {
    constexpr std::string_view kEnding = ".json";
    if (path.size() > folder.size() + 1 + kEnding.size() && path.starts_with(folder) && path[folder.size()] == '/' &&
        path.ends_with(kEnding)) {
        return path.substr(folder.size() + 1, path.size() - folder.size() - 1 - kEnding.size());
    }
    return {};
}

}  // namespace

std::vector<std::string> data_names(std::string_view folder) {
    std::vector<std::string> names;
    for (const DataFile& file : data_files()) {
        if (const std::string_view name = name_in(folder, file.path); !name.empty()) {
            names.emplace_back(name);
        }
    }
    return names;
}

DataDocument open_data(std::string_view folder, const std::string& name_or_path, const std::vector<std::string>& also,
                       const std::string& advice) {
    for (const DataFile& file : data_files()) {
        if (name_in(folder, file.path) == name_or_path && !name_or_path.empty()) {
            DataDocument result{{fmt::format("content/{}", file.path), advice}, {}};
            result.json = parse_json(file.text, result.source);
            return result;
        }
    }
    if (!name_or_path.ends_with(".json")) {
        std::vector<std::string> names = also;
        const std::vector<std::string> built_in = data_names(folder);
        names.insert(names.end(), built_in.begin(), built_in.end());
        throw Error(Fault::input,
                    fmt::format("{}: not a name in {}{}; there are {}, or give the path of a .json file", name_or_path,
                                folder, did_you_mean(name_or_path, names), fmt::join(names, ", ")));
    }
    DataDocument result{{name_or_path, advice}, {}};
    result.json = parse_json(read_regular_file(name_or_path, kMostBytes, name_or_path), result.source);
    return result;
}

}  // namespace halfframe::content
