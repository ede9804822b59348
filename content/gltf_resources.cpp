// The bytes behind buffers and images: data URIs, files beside the asset, the GLB's binary chunk.
#include "content/gltf_document.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::content {
namespace {

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percent_decoded(const JsonPlace& place, const std::string& uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            result += uri[i];
            continue;
        }
        const int high = i + 2 < uri.size() ? hex_value(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hex_value(uri[i + 2]) : -1;
        if (high < 0 || low < 0) {
            place.fail("has a '%' that is not followed by two hexadecimal digits");
        }
        result += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return result;
}

/// "http:" and the like: a letter, then letters, digits, + - . up to a colon (RFC 3986).
bool has_scheme(const std::string& uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string::npos && colon > 0 && std::isalpha(static_cast<unsigned char>(uri[0])) != 0 &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
           });
}

/// A link inside the folder may not lead out of it: an asset from somewhere else may bring one to any file.
void expect_inside(const GltfDocument& document, const JsonPlace& place, const std::filesystem::path& path,
                   const std::string& advice) {
    std::error_code code;
    const std::filesystem::path parent = document.file.parent_path();
    const std::filesystem::path folder = std::filesystem::weakly_canonical(parent.empty() ? "." : parent, code);
    const std::filesystem::path target = code ? path : std::filesystem::weakly_canonical(path, code);
    if (code) {
        place.fail(fmt::format("cannot be followed ({})", code.message()), advice);
    }
    const auto [end_of_folder, in_target] = std::mismatch(folder.begin(), folder.end(), target.begin(), target.end());
    if (end_of_folder != folder.end()) {
        place.fail(fmt::format("leads out of the asset's folder, to {}", target.string()), advice);
    }
}

/// The path of a relative URI inside the asset's folder.
std::filesystem::path path_of(const GltfDocument& document, const JsonPlace& place, const std::string& uri) {
    const std::string advice = "put the file into the folder of the glTF file and name it relative to that";
    if (has_scheme(uri)) {
        place.fail(fmt::format("'{}' is not a relative path", uri), advice);
    }
    const std::string decoded = percent_decoded(place, uri);
    const std::filesystem::path relative(decoded);
    if (decoded.empty() || decoded.find('\0') != std::string::npos) {
        place.fail("names no file", advice);
    }
    if (relative.is_absolute()) {
        place.fail(fmt::format("'{}' is an absolute path", decoded), advice);
    }
    if (std::any_of(relative.begin(), relative.end(), [](const auto& part) { return part == ".."; })) {
        place.fail(fmt::format("'{}' leads out of the asset's folder", decoded), advice);
    }
    const std::filesystem::path path = document.file.parent_path() / relative;
    expect_inside(document, place, path, advice);
    return path;
}

Bytes base64_decoded(const JsonPlace& place, std::string_view text) {
    static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value{};
    value.fill(-1);
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
        value[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);
    }
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    Bytes result(text.size() / 4 * 3 + 3);
    std::size_t written = 0;
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int digit = value[static_cast<unsigned char>(text[i])];
        if (digit < 0) {
            place.fail(fmt::format("is not base64 at character {} of its data", i));
        }
        bits = (bits << 6) | static_cast<std::uint32_t>(digit);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            result.data()[written++] = static_cast<char>((bits >> bit_count) & 0xFFu);
        }
    }
    if (text.size() % 4 == 1) {
        place.fail("is base64 that was cut off");
    }
    result.keep(0, written);
    return result;
}

Bytes data_of_uri(const JsonPlace& place, const std::string& uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
        place.fail("is a data URI without ';base64,'");
    }
    return base64_decoded(place, std::string_view(uri).substr(comma + 1));
}

/// `list` and `index`: "images", 3: where the URI stands.
Bytes bytes_of_uri(const GltfDocument& document, const JsonPlace& place, const char* list, std::size_t index) {
    const std::string& uri = place.text();
    if (uri.starts_with("data:")) {
        return data_of_uri(place, uri);
    }
    const std::filesystem::path path = path_of(document, place, uri);
    return read_regular_file(path, kMostFileBytes, fmt::format("{}: /{}/{}/uri", document.source.file, list, index));
}

GltfBuffer bytes_of_buffer(GltfDocument& document, const JsonPlace& buffer, std::size_t index) {
    const auto byte_length = static_cast<std::size_t>(buffer.at("byteLength").whole());
    GltfBuffer bytes;
    if (buffer.has("uri")) {
        bytes = GltfBuffer(bytes_of_uri(document, buffer.at("uri"), "buffers", index));
    } else if (index == 0 && document.binary_chunk) {
        bytes = std::move(*document.binary_chunk);
        document.binary_chunk.reset();
    } else {
        return {};
    }
    if (bytes.size() < byte_length) {
        buffer.at("byteLength").fail(fmt::format("is {} but its data has only {} bytes", byte_length, bytes.size()));
    }
    bytes.keep(0, byte_length);
    return bytes;
}

}  // namespace

GltfResources read_gltf_resources(GltfDocument& document) {
    GltfResources resources;
    std::uint64_t image_file_bytes = 0;
    for_each_object(document.root(), "buffers", [&](const JsonPlace& buffer, std::size_t index) {
        resources.buffers.push_back(bytes_of_buffer(document, buffer, index));
    });
    for_each_object(document.root(), "images", [&](const JsonPlace& image, std::size_t index) {
        resources.images.push_back(image.has("uri") ? bytes_of_uri(document, image.at("uri"), "images", index)
                                                    : Bytes());
        image_file_bytes += resources.images.back().size();
        if (image.has("uri") && resources.images.back().empty()) {
            image.at("uri").fail("names an empty file");
        }
        if (image_file_bytes > kMostFileBytes) {
            image.fail(fmt::format("all image files up to here have over {} bytes", kMostFileBytes),
                       "make them smaller");
        }
    });
    return resources;
}

}  // namespace halfframe::content
