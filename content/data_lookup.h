// Opens a data file by its built-in name or by a path.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "content/json_place.h"

namespace halfframe::content {

/// A parsed data file and where it came from.
struct DataDocument {
    JsonSource source;
    JsonDocument json;
};

/// The built-in names in a folder of content/: "devices" gives es2-mali400-class, es2-minimum, es3-minimum.
[[nodiscard]] std::vector<std::string> data_names(std::string_view folder);

/// `name_or_path` is a built-in name of the folder, or else a path that ends in .json. Otherwise Error(input) that
/// lists the names; `also` are names that the caller knows itself. `advice` ends every complaint about the content.
[[nodiscard]] DataDocument open_data(std::string_view folder, const std::string& name_or_path,
                                     const std::vector<std::string>& also, const std::string& advice);

}  // namespace halfframe::content
