// One file an environment: a header, the payload's fingerprint, the payload. Read only where it was written, so numbers
// are in the machine's own byte order.
#include "content/environment/environment_cache.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "content/environment/lobe_powers.h"
#include "engine/cache_file.h"
#include "engine/gl/fingerprint.h"

namespace halfframe::content {
namespace {

/// Raise the number whenever the same source would give other texels, or the layout below changes.
constexpr std::string_view kVersion = "halfframe environment 3\n";

template <typename T>
void put(std::string& bytes, const T* values, std::size_t count) {
    if (count > 0) bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// Takes values off the front of `bytes`; false when there are not enough.
template <typename T>
bool take(std::string_view& bytes, T* values, std::size_t count) {
    if (bytes.size() / sizeof(T) < count) return false;
    if (count > 0) std::memcpy(values, bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
    return true;
}

void put_text(std::string& bytes, const std::string& text) {
    const auto size = static_cast<std::uint32_t>(text.size());
    put(bytes, &size, 1);
    bytes += text;
}

bool take_text(std::string_view& bytes, std::string& text) {
    std::uint32_t size = 0;
    if (!take(bytes, &size, 1) || size > bytes.size()) return false;
    text = bytes.substr(0, size);
    bytes.remove_prefix(size);
    return true;
}

std::string payload_of(const StoredEnvironment& stored) {
    std::string bytes;
    put(bytes, &stored.map.size, 1);
    for (const std::vector<glm::vec3>& level : stored.map.levels) put(bytes, level.data(), level.size());
    put(bytes, stored.map.powers.data(), stored.map.powers.size());
    put(bytes, stored.map.irradiance.data(), stored.map.irradiance.size());
    for (const std::string& notice : stored.notices) put_text(bytes, notice);
    return bytes;
}

std::optional<StoredEnvironment> parse_payload(std::string_view bytes, int size) {
    StoredEnvironment stored;
    if (!take(bytes, &stored.map.size, 1) || stored.map.size != size) return {};
    for (int side = size; side >= 1; side /= 2) {
        stored.map.levels.emplace_back(static_cast<std::size_t>(6 * side * side));
        if (!take(bytes, stored.map.levels.back().data(), stored.map.levels.back().size())) return {};
    }
    stored.map.roughest_level = roughest_level(size);
    stored.map.powers.resize(stored.map.levels.size());
    if (!take(bytes, stored.map.powers.data(), stored.map.powers.size())) return {};
    if (!take(bytes, stored.map.irradiance.data(), stored.map.irradiance.size())) return {};
    while (!bytes.empty()) {
        if (!take_text(bytes, stored.notices.emplace_back())) return {};
    }
    return stored;
}

}  // namespace

std::filesystem::path cache_file(const std::filesystem::path& folder, std::string_view source, int size) {
    // Two independent fingerprints of 64 bits, as the program cache has them.
    constexpr std::uint64_t kSecondStart = 0x9e3779b97f4a7c15ULL;
    const std::string also = fmt::format("{}{}", kVersion, size);
    const std::uint64_t first = gl::fingerprint(source, gl::fingerprint(also));
    const std::uint64_t second = gl::fingerprint(source, gl::fingerprint(also, kSecondStart));
    return folder / fmt::format("{:016x}{:016x}.environment", first, second);
}

std::optional<StoredEnvironment> read_cache(const std::filesystem::path& file, int size) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return {};
    std::ifstream stream(file, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(stream), {}};
    std::string_view bytes = content;
    std::uint64_t sum = 0;
    if (!bytes.starts_with(kVersion)) return {};
    bytes.remove_prefix(kVersion.size());
    if (!take(bytes, &sum, 1) || sum != gl::fingerprint(bytes)) return {};
    return parse_payload(bytes, size);
}

std::optional<std::string> write_cache(const std::filesystem::path& file, const StoredEnvironment& stored) {
    const std::string payload = payload_of(stored);
    const std::uint64_t sum = gl::fingerprint(payload);
    std::string content(kVersion);
    put(content, &sum, 1);
    content += payload;

    const std::error_code error = write_cache_file(file, content);
    if (!error) return {};
    return fmt::format(
        "the environment cache folder {} cannot be written ({}): environments are filtered anew in every "
        "run; give another folder or make this one writable",
        file.parent_path().string(), error.message());
}

}  // namespace halfframe::content
