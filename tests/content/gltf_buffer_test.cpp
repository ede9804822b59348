// Parts of a buffer that lies in a file, against the same bytes in memory.
#include "content/gltf_buffer.h"

#include <filesystem>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::content {
namespace {

constexpr std::uint64_t kMost = 1u << 30;

std::string noise(std::size_t size) {
    std::mt19937 random(20131107);
    std::string bytes(size, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    return bytes;
}

GltfBuffer opened(const std::filesystem::path& file) { return GltfBuffer(RegularFile(file, kMost, file.string())); }

TEST(GltfBuffer, GivesEveryPartOfItsFile) {
    const harness::TemporaryFolder folder;
    for (const std::size_t size : {1u, 1000u, 65536u, 65537u, 1000000u}) {
        const std::string bytes = noise(size);
        const std::filesystem::path file = folder.write("bytes.bin", bytes);
        for (const bool cut : {false, true}) {
            if (cut && size < 1000) continue;
            GltfBuffer buffer = opened(file);
            std::string_view wanted = bytes;
            if (cut) {
                (void)buffer.part(0, 20);  // a window that must not outlive the cut
                buffer.keep(20, size - 30);
                wanted = wanted.substr(20, size - 30);
            }
            ASSERT_EQ(buffer.size(), wanted.size());
            std::mt19937 random(7);
            for (int i = 0; i < 200; ++i) {  // more than enough windows to have all of it read at last
                const std::size_t start = random() % wanted.size();
                const std::size_t most = std::min<std::size_t>(wanted.size() - start, i % 50 == 49 ? size : 300);
                const std::size_t count = random() % (most + 1);
                ASSERT_EQ(buffer.part(start, count), wanted.substr(start, count)) << size << " " << start;
                ASSERT_EQ(std::string_view(buffer.copy(start, count)), wanted.substr(start, count)) << size;
                std::string read(count, '\0');
                buffer.read(start, count, read.data());
                ASSERT_EQ(read, wanted.substr(start, count)) << size << " " << start;
            }
        }
    }
}

TEST(GltfBuffer, PiecesAreOfWholeElementsAndMakeTheRange) {
    const harness::TemporaryFolder folder;
    const std::string bytes = noise(400000);
    const std::filesystem::path file = folder.write("bytes.bin", bytes);
    for (const std::size_t element : {1u, 8u, 12u, 16u}) {
        for (const std::size_t count : {1u, 5461u, 5462u, 20000u}) {
            const GltfBuffer buffer = opened(file);
            std::string together;
            int pieces = 0;
            buffer.for_each_piece(4, count * element, element, [&](std::string_view piece) {
                EXPECT_EQ(piece.size() % element, 0u);
                together += piece;
                ++pieces;
            });
            EXPECT_EQ(together, bytes.substr(4, count * element)) << element << " " << count;
            EXPECT_EQ(pieces > 1, count * element > 65536) << element << " " << count;
        }
    }
}

TEST(GltfBuffer, AFileThatShrinksMeanwhileIsAFaultOfTheInput) {
    const harness::TemporaryFolder folder;
    const std::filesystem::path file = folder.write("bytes.bin", noise(200000));
    const GltfBuffer buffer = opened(file);
    std::filesystem::resize_file(file, 1000);
    try {
        buffer.for_each_piece(0, 200000, 4, [](std::string_view) {});
        ADD_FAILURE() << "bytes that are gone were read";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        EXPECT_NE(std::string(error.what()).find("cannot be read"), std::string::npos) << error.what();
    }
}

TEST(GltfBuffer, HasNothingWithoutData) {
    EXPECT_TRUE(GltfBuffer().empty());
    EXPECT_EQ(GltfBuffer().part(0, 0), "");
}

}  // namespace
}  // namespace halfframe::content
