// From a file to parsed JSON: GLB header and chunks, version, extensions.
#include "content/gltf_document.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "content/gltf_extensions.h"
#include "content/gltf_extras.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

constexpr const char* kAdvice = "check the file with the glTF validator or export it again";

std::uint32_t little_endian_32(std::string_view bytes, std::size_t at) {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        result |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    }
    return result;
}

[[noreturn]] void bad_glb(const GltfDocument& document, std::size_t byte, const std::string& what) {
    throw Error(Fault::input,
                fmt::format("{}: byte {}: {}; {}", document.source.file, byte, what, document.source.advice));
}

[[noreturn]] void is_version_1(const GltfDocument& document, const std::string& place) {
    throw Error(Fault::input, fmt::format("{}: {}: this is glTF 1.0 and only glTF 2.0 is read; convert it, for example "
                                          "with gltf-pipeline or by exporting it again",
                                          document.source.file, place));
}

/// Length of the GLB after comparing it with the length of the file.
std::size_t checked_glb_length(GltfDocument& document, const GltfBuffer& bytes) {
    if (bytes.size() < kGlbHeaderBytes) {
        bad_glb(document, bytes.size(), "the GLB header is cut off");
    }
    const std::string_view header = bytes.part(0, kGlbHeaderBytes);
    const std::uint32_t version = little_endian_32(header, 4);
    if (version == 1) {
        is_version_1(document, "byte 4");
    }
    if (version != 2) {
        bad_glb(document, 4, fmt::format("the GLB has version {} and only version 2 is read", version));
    }
    const std::size_t length = little_endian_32(header, 8);
    if (length > bytes.size()) {
        bad_glb(document, 8, fmt::format("the GLB says it has {} bytes but the file has {}", length, bytes.size()));
    }
    if (length < kGlbHeaderBytes + kChunkHeaderBytes) {
        bad_glb(document, 8, fmt::format("the GLB says it has {} bytes, too few for one chunk", length));
    }
    if (length < bytes.size()) {
        document.notices.push_back(
            fmt::format("{} bytes after the end of the GLB were left out.", bytes.size() - length));
    }
    return length;
}

/// Where the JSON text and the binary chunk of a GLB are.
struct Range {
    std::size_t start = 0;
    std::size_t size = 0;
};
struct GlbChunks {
    Range json;
    std::optional<Range> binary;
};

GlbChunks split_glb(GltfDocument& document, const GltfBuffer& bytes) {
    const std::size_t length = checked_glb_length(document, bytes);
    GlbChunks chunks;
    std::size_t at = kGlbHeaderBytes;
    for (int chunk = 0; at < length; ++chunk) {
        if (length - at < kChunkHeaderBytes) {
            bad_glb(document, at, "the header of a chunk is cut off");
        }
        const std::string_view header = bytes.part(at, kChunkHeaderBytes);
        const std::size_t chunk_bytes = little_endian_32(header, 0);
        const std::uint32_t type = little_endian_32(header, 4);
        if (chunk_bytes > length - at - kChunkHeaderBytes) {
            bad_glb(document, at,
                    fmt::format("chunk {} says it has {} bytes but {} are left", chunk, chunk_bytes,
                                length - at - kChunkHeaderBytes));
        }
        if (chunk_bytes % 4 != 0) {
            bad_glb(document, at, fmt::format("chunk {} has {} bytes, not a multiple of 4", chunk, chunk_bytes));
        }
        const Range content{at + kChunkHeaderBytes, chunk_bytes};
        if ((chunk == 0) != (type == kJsonChunk)) {
            bad_glb(document, at + 4, chunk == 0 ? "the first chunk is not JSON" : "there is a second JSON chunk");
        }
        if (chunk == 0) {
            chunks.json = content;
        } else if (type == kBinaryChunk) {
            if (chunk != 1) {
                bad_glb(document, at + 4, "the binary chunk is not the second one");
            }
            chunks.binary = content;
        }
        at += kChunkHeaderBytes + chunk_bytes;
    }
    return chunks;
}

struct Version {
    int major = 0;
    int minor = 0;
    auto operator<=>(const Version&) const = default;
};

Version version_at(const JsonPlace& place) {
    const std::string& text = place.text();
    const std::size_t dot = text.find('.');
    const auto all_digits = [](const std::string& digits) {
        return !digits.empty() && digits.size() <= 4 &&
               std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    if (dot == std::string::npos || !all_digits(text.substr(0, dot)) || !all_digits(text.substr(dot + 1))) {
        place.fail(fmt::format("'{}' is not a version such as 2.0", text));
    }
    return {std::stoi(text.substr(0, dot)), std::stoi(text.substr(dot + 1))};
}

/// glTF 1.0 keeps its things in objects by name, glTF 2.0 in arrays. Its `asset` was optional and its version a number
/// at first.
bool looks_like_version_1(const JsonPlace& root) {
    return (root.has("meshes") && root.at("meshes").value().is_object()) ||
           (root.has("nodes") && root.at("nodes").value().is_object());
}

void check_version(GltfDocument& document) {
    const JsonPlace root = document.root();
    root.expect_object();
    if (looks_like_version_1(root)) {
        is_version_1(document, "/meshes");
    }
    const JsonPlace asset = root.at("asset");
    const Version version = version_at(asset.at("version"));
    if (version.major == 1) {
        is_version_1(document, "/asset/version");
    }
    if (version.major != 2) {
        asset.at("version").fail(
            fmt::format("version {}.{} is not known, glTF 2.0 is read", version.major, version.minor));
    }
    if (asset.has("minVersion")) {
        const Version lowest = version_at(asset.at("minVersion"));
        if (lowest > version) {
            asset.at("minVersion").fail("is above the asset's own version");
        }
        if (lowest > Version{2, 0}) {
            asset.at("minVersion").fail(fmt::format("asks for glTF {}.{} and 2.0 is read", lowest.major, lowest.minor));
        }
    }
    if (version.minor > 0) {
        document.notices.push_back(fmt::format("The asset is glTF 2.{}; it was read as 2.0.", version.minor));
    }
}

bool is_supported(std::string_view extension) {
    return std::ranges::find(supported_extensions(), extension) != supported_extensions().end();
}

void check_extensions(GltfDocument& document) {
    const JsonPlace root = document.root();
    for (std::size_t i = 0; i < count_of(root, "extensionsRequired"); ++i) {
        const JsonPlace required = root.at("extensionsRequired").at(i);
        if (!is_supported(required.text())) {
            required.fail(fmt::format("the file requires the extension {}, which is not supported", required.text()),
                          "export it without that extension");
        }
    }
    for (std::size_t i = 0; i < count_of(root, "extensionsUsed"); ++i) {
        const std::string& used = root.at("extensionsUsed").at(i).text();
        if (!is_supported(used)) {
            document.notices.push_back(fmt::format("The extension {} is not supported: drawn without it.", used));
        }
    }
}

}  // namespace

bool GltfDocument::uses_extension(std::string_view name) const {
    const JsonValue* used = json.root().find("extensionsUsed");
    return used != nullptr && used->is_array() && std::ranges::any_of(used->elements(), [&](const JsonValue& each) {
               return each.is_text() && each.text() == name;
           });
}

std::string name_of(const JsonPlace& object) {
    const JsonValue* name = object.value().find("name");
    return name != nullptr && name->is_text() ? name->text() : std::string();
}

std::optional<std::size_t> index_in(const JsonPlace& owner, std::string_view key, std::size_t count,
                                    std::string_view what) {
    const std::optional<JsonPlace> place = owner.find(key);
    if (!place) {
        return std::nullopt;
    }
    const std::uint64_t index = place->whole();
    if (index >= count) {
        place->fail(fmt::format("points at number {} of {} {}", index, count, what));
    }
    return static_cast<std::size_t>(index);
}

GltfDocument read_gltf_document(const std::filesystem::path& file) {
    GltfDocument document{
        .file = file, .source = {file.string(), kAdvice}, .json = {}, .binary_chunk = {}, .notices = {}};
    GltfBuffer bytes(RegularFile(file, kMostFileBytes, file.string()));
    const bool binary = bytes.size() >= 4 && bytes.part(0, 4) == "glTF";
    if (!binary && file.extension() == ".glb") {
        bad_glb(document, 0, "a GLB starts with the letters glTF and this file does not");
    }
    const GlbChunks chunks = binary ? split_glb(document, bytes) : GlbChunks{{0, bytes.size()}, std::nullopt};
    if (chunks.json.size > kMostJsonBytes) {
        throw Error(Fault::input,
                    fmt::format("{}: the JSON has {} bytes, more than the {} that are read; move its data to "
                                "separate files",
                                document.source.file, chunks.json.size, kMostJsonBytes));
    }
    document.json = parse_json(bytes.copy(chunks.json.start, chunks.json.size), document.source);
    if (chunks.binary) {
        bytes.keep(chunks.binary->start, chunks.binary->size);
        document.binary_chunk = std::move(bytes);
    }
    return document;
}

void check_gltf(GltfDocument& document) {
    check_version(document);
    check_extensions(document);
    check_gltf_data(document);
    check_gltf_scenes(document);
    check_gltf_motion(document);
    check_gltf_extensions(document);
    check_gltf_extras(document);
}

}  // namespace halfframe::content
