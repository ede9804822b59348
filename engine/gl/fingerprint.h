// A 64-bit hash that is the same on every machine: for traces, cache keys and checks of files. Not for secrets.
#pragma once

#include <cstdint>
#include <string_view>

namespace halfframe::gl {

inline constexpr std::uint64_t kFingerprintStart = 0xcbf29ce484222325ULL;

/// FNV-1a. `start` continues an earlier fingerprint, or (any other number) gives a second, independent one.
[[nodiscard]] constexpr std::uint64_t fingerprint(std::string_view bytes, std::uint64_t start = kFingerprintStart) {
    std::uint64_t hash = start;
    for (const char byte : bytes) {
        hash ^= static_cast<unsigned char>(byte);
        hash *= 0x100000001b3ULL;
    }
    return hash;
}

}  // namespace halfframe::gl
