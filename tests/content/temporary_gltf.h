// Small glTF files written by tests into a folder that goes away again.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/harness/temporary_folder.h"

namespace halfframe::tests {

using harness::TemporaryFolder;

template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
    const std::size_t at = bytes.size();
    bytes.resize(at + values.size() * sizeof(T));
    std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
}

[[nodiscard]] std::string base64(const std::string& bytes);
[[nodiscard]] std::string glb(const std::string& json, const std::string& binary);
/// A 2 x 1 PNG: one red and one half-transparent green pixel.
[[nodiscard]] std::string two_pixel_png();
/// A 1 x 1 PNG of 16 bits a channel: 0x1234, 0x5678, 0x9ABC.
[[nodiscard]] std::string sixteen_bit_png();

/// One triangle (0,0,0) (1,0,0) (0,1,0) with u16 indices 0 1 2, in one buffer of 44 bytes embedded as a data URI:
/// indices at byte 0 (view 0, accessor 0), positions at byte 8 (view 1, accessor 1).
[[nodiscard]] nlohmann::json triangle_document();
[[nodiscard]] std::string triangle_bytes();

/// Appends `bytes` as a buffer of its own with one view and returns the view's index.
std::size_t add_view(nlohmann::json& document, const std::string& bytes);
/// Appends an accessor over a whole view and returns its index.
std::size_t add_accessor(nlohmann::json& document, std::size_t view, int component_type, const std::string& type,
                         std::size_t count, bool normalized = false);

/// The message of the Error(input) that loading `file` throws; empty when it loads, and a failed test when it throws
/// something else.
[[nodiscard]] std::string error_of(const std::filesystem::path& file);

}  // namespace halfframe::tests
