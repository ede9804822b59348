// Chunks, checksums and stored blocks.
#include "content/png_file.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace halfframe::content {
namespace {

void append_big(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> shift) & 0xFFu);
}

std::uint32_t crc_of(std::string_view bytes) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> made{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t c = i;
            for (int bit = 0; bit < 8; ++bit) c = (c & 1u) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
            made[i] = c;
        }
        return made;
    }();
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char c : bytes) crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xFFu] ^ (crc >> 8);
    return crc ^ 0xFFFFFFFFu;
}

void append_chunk(std::string& png, const std::string& type, const std::string& content) {
    append_big(png, static_cast<std::uint32_t>(content.size()));
    png += type + content;
    append_big(png, crc_of(type + content));
}

std::uint32_t adler_of(std::string_view bytes) {
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % 65521u;
        b = (b + a) % 65521u;
    }
    return (b << 16) | a;
}

std::string stored(std::string_view bytes) {
    std::string stream("\x78\x01", 2);
    constexpr std::size_t kBlock = 65535;
    for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
        const std::size_t count = std::min(kBlock, bytes.size() - at);
        stream += static_cast<char>(at + count == bytes.size() ? 1 : 0);
        for (const std::size_t word : {count, ~count}) {
            stream += static_cast<char>(word & 0xFFu);
            stream += static_cast<char>((word >> 8) & 0xFFu);
        }
        stream += bytes.substr(at, count);
    }
    append_big(stream, adler_of(bytes));
    return stream;
}

}  // namespace

std::string png_of(const Image& image) {
    std::string png("\x89PNG\r\n\x1a\n", 8);
    std::string header;
    append_big(header, static_cast<std::uint32_t>(image.width));
    append_big(header, static_cast<std::uint32_t>(image.height));
    header += std::string("\x08\x06\x00\x00\x00", 5);  // 8 bits, RGBA, no interlacing
    append_chunk(png, "IHDR", header);
    const std::size_t row_bytes = static_cast<std::size_t>(image.width) * 4;
    std::string rows;
    for (int y = 0; y < image.height; ++y) {
        rows += '\0';  // no filter
        rows.append(reinterpret_cast<const char*>(image.rgba.data()) + static_cast<std::size_t>(y) * row_bytes,
                    row_bytes);
    }
    append_chunk(png, "IDAT", stored(rows));
    append_chunk(png, "IEND", "");
    return png;
}

}  // namespace halfframe::content
