// Optimised stages in files, found again by the text they came from: a text is compiled once on a machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/program.h"
#include "perf/shader_ir/module.h"

namespace halfframe::shader_ir {

/// Files that cannot be read, are cut short or of another text are none; those that cannot be written are not missed.
/// Several processes may share a folder.
class StageCache {
public:
    /// `salt` tells builds apart whose compilers may differ: what one keeps, another does not find. It becomes a folder
    /// of `folder`, where the four that were made last stay. An empty `folder`: nothing is kept.
    explicit StageCache(const std::filesystem::path& folder = {}, std::string_view salt = {});

    struct Kept {
        std::vector<std::uint32_t> inlined;  ///< before the unroller forgets precisions
        std::vector<std::uint32_t> optimised;
    };
    [[nodiscard]] std::optional<Kept> find(const std::string& key) const;
    void keep(const std::string& key, const Kept& kept) const;
    /// 32 hexadecimal digits over all that decides the words.
    [[nodiscard]] static std::string key_of(const gl::StageText& text, gl::Stage stage);

private:
    std::filesystem::path folder_;
};

/// compile(text, stage, Cleaning::optimised), or the same from the cache.
[[nodiscard]] Module compile_kept(const gl::StageText& text, gl::Stage stage, const StageCache& cache);

}  // namespace halfframe::shader_ir
