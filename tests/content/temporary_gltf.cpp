// Writing small glTF files.
#include "tests/content/temporary_gltf.h"

#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/error.h"

namespace halfframe::tests {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void append_u32(std::string& bytes, std::size_t value) {
    append(bytes, std::vector{static_cast<std::uint32_t>(value)});
}

std::string from_hex(std::string_view hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
    }
    return bytes;
}

}  // namespace

std::string base64(const std::string& bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            bits = (bits << 8) | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        }
        for (std::size_t j = 0; j < 4; ++j) {
            text += i + j <= bytes.size() ? kDigits[(bits >> (18 - 6 * j)) & 63u] : '=';
        }
    }
    return text;
}

std::string glb(const std::string& json, const std::string& binary) {
    std::string text = json;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string data = binary;
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    append_u32(bytes, 2);
    append_u32(bytes, 12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size()));
    append_u32(bytes, text.size());
    bytes += "JSON" + text;
    if (!data.empty()) {
        append_u32(bytes, data.size());
        bytes += std::string("BIN\0", 4) + data;
    }
    return bytes;
}

std::string two_pixel_png() {
    return from_hex(
        "89504e470d0a1a0a0000000d4948445200000002000000010806000000f4227f8a0000000f49444154789c63f8cfc0f0"
        "1f081b001079037e7d63ced70000000049454e44ae426082");
}

std::string sixteen_bit_png() {
    return from_hex(
        "89504e470d0a1a0a0000000d4948445200000001000000011002000000c0e78f9d0000000f49444154789c63103209ab"
        "98b507000627026b0eded57a0000000049454e44ae426082");
}

std::string triangle_bytes() {
    std::string bytes;
    append(bytes, std::vector<std::uint16_t>{0, 1, 2, 0});
    append(bytes, std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    return bytes;
}

nlohmann::json triangle_document() {
    nlohmann::json document = nlohmann::json::parse(R"({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}],
        "buffers": [{"byteLength": 44}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 6},
                        {"buffer": 0, "byteOffset": 8, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5123, "type": "SCALAR", "count": 3},
                      {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 3}]
    })");
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(triangle_bytes());
    return document;
}

std::size_t add_view(nlohmann::json& document, const std::string& bytes) {
    document["buffers"].push_back(
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    document["bufferViews"].push_back({{"buffer", document["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    return document["bufferViews"].size() - 1;
}

std::size_t add_accessor(nlohmann::json& document, std::size_t view, int component_type, const std::string& type,
                         std::size_t count, bool normalized) {
    document["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}});
    if (normalized) {
        document["accessors"].back()["normalized"] = true;
    }
    return document["accessors"].size() - 1;
}

std::string error_of(const std::filesystem::path& file) {
    try {
        (void)content::load_gltf(file);
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input) << error.what();
        return error.what();
    }
    return {};
}

}  // namespace halfframe::tests
