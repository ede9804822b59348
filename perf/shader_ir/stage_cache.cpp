// Files of two arrays of words, with a check sum behind them.
#include "perf/shader_ir/stage_cache.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "engine/cache_file.h"
#include "engine/gl/fingerprint.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::shader_ir {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "HFSTAGE1";
constexpr const char* kFolderPrefix = "stages-";
constexpr std::size_t kFoldersKept = 4;

std::string_view bytes_of(const std::vector<std::uint32_t>& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::uint32_t)};
}

/// Takes `count` words from the front of `content`.
std::vector<std::uint32_t> taken(std::string_view& content, std::uint64_t count) {
    std::vector<std::uint32_t> words(count);
    std::memcpy(words.data(), content.data(), count * sizeof(std::uint32_t));
    content.remove_prefix(count * sizeof(std::uint32_t));
    return words;
}

void drop_old_folders(const fs::path& parent) {
    std::error_code failed;
    std::vector<std::pair<fs::file_time_type, fs::path>> folders;
    for (const fs::directory_entry& entry : fs::directory_iterator(parent, failed)) {
        if (!entry.path().filename().string().starts_with(kFolderPrefix)) continue;
        folders.emplace_back(entry.last_write_time(failed), entry.path());
    }
    std::ranges::sort(folders, std::ranges::greater{});
    for (std::size_t i = kFoldersKept; i < folders.size(); ++i) fs::remove_all(folders[i].second, failed);
}

}  // namespace

StageCache::StageCache(const fs::path& folder, std::string_view salt) {
    if (folder.empty()) return;
    const fs::path own = folder / (kFolderPrefix + fmt::format("{:016x}", gl::fingerprint(salt)));
    std::error_code failed;
    const bool made = fs::create_directories(own, failed);
    if (failed) return;
    if (made) drop_old_folders(folder);
    folder_ = own;
}

std::string StageCache::key_of(const gl::StageText& text, gl::Stage stage) {
    std::string all = fmt::format("{}\n{}\n{}\n", compiler_versions(), static_cast<int>(stage), text.text);
    for (const std::string& file : text.files) all += file + '\n';
    constexpr std::uint64_t kSecondStart = 0x9e3779b97f4a7c15ULL;
    return fmt::format("{:016x}{:016x}", gl::fingerprint(all), gl::fingerprint(all, kSecondStart));
}

std::optional<StageCache::Kept> StageCache::find(const std::string& key) const {
    if (folder_.empty()) return std::nullopt;
    std::ifstream stream(folder_ / key, std::ios::binary);
    const std::string file{std::istreambuf_iterator<char>(stream), {}};
    std::array<std::uint64_t, 3> header{};  // words before, words after, check sum of both
    constexpr std::size_t kHeaderBytes = kMagic.size() + sizeof header;
    if (file.size() < kHeaderBytes || !file.starts_with(kMagic)) return std::nullopt;
    std::memcpy(header.data(), file.data() + kMagic.size(), sizeof header);
    std::string_view content(file);
    content.remove_prefix(kHeaderBytes);
    const auto most = content.size() / sizeof(std::uint32_t);
    if (header[0] > most || header[1] > most || (header[0] + header[1]) * sizeof(std::uint32_t) != content.size() ||
        header[2] != gl::fingerprint(content))
        return std::nullopt;
    Kept kept;
    kept.inlined = taken(content, header[0]);
    kept.optimised = taken(content, header[1]);
    return kept;
}

void StageCache::keep(const std::string& key, const Kept& kept) const {
    if (folder_.empty()) return;
    const std::uint64_t sum = gl::fingerprint(bytes_of(kept.optimised), gl::fingerprint(bytes_of(kept.inlined)));
    const std::array<std::uint64_t, 3> header{kept.inlined.size(), kept.optimised.size(), sum};
    std::string content(kMagic);
    content += std::string_view(reinterpret_cast<const char*>(header.data()), sizeof header);
    content += bytes_of(kept.inlined);
    content += bytes_of(kept.optimised);
    static_cast<void>(write_cache_file(folder_ / key, content));  // else it is compiled again
}

}  // namespace halfframe::shader_ir
