// A folder of a test's own that goes away again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace halfframe::harness {

class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Names in the folder, sorted.
    [[nodiscard]] std::vector<std::string> names() const;
    /// Writes bytes, makes the folders of `name`, and returns the whole path.
    std::filesystem::path write(const std::string& name, const std::string& bytes) const;

private:
    std::filesystem::path path_;
};

}  // namespace halfframe::harness
