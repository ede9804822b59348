// Loads every glTF file below the folders it is given, under the sanitizers: a sound scene or an error that names the
// file, at most 5 s of processor time, and at most 1 GiB held at a time. HALFFRAME_ASSETS takes the place of the
// folders. Exit code 77: there is none.
#include <sanitizer/allocator_interface.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <vector>

#include "tests/fuzz/gltf_target.h"

namespace {

constexpr double kMost_s = 5.0;
constexpr std::size_t kMostBytes = 1ull << 30;

// What the program holds, counted by the sanitizer's own allocator: the resident set would count its shadow memory and
// what it keeps back of freed memory, twice as much as the loader asks for.
std::atomic<std::size_t> held_bytes, most_held_bytes;

void count_new(const volatile void*, std::size_t bytes) {
    const std::size_t held = held_bytes += bytes;
    std::size_t most = most_held_bytes;
    while (held > most && !most_held_bytes.compare_exchange_weak(most, held)) {}
}

void count_freed(const volatile void* at) {
    if (at != nullptr) held_bytes -= __sanitizer_get_allocated_size(at);
}

/// Does the count see what is taken and given back? Otherwise no file could exceed the limit.
bool counts() {
    const std::size_t before = held_bytes;
    std::size_t with = 0;
    {
        std::vector<char> block(kMostBytes + 1);
        block.back() = 1;
        with = held_bytes - static_cast<std::size_t>(block.front());
    }
    return with - before > kMostBytes && held_bytes == before && most_held_bytes > kMostBytes;
}

/// False: too slow or too large.
bool within_limits(const std::filesystem::path& file, bool& loaded) {
    const std::size_t before = held_bytes;
    most_held_bytes = before;
    const std::clock_t start = std::clock();
    loaded = halfframe::tests::load_file(file);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const std::size_t bytes = most_held_bytes - before;
    if (seconds >= kMost_s) std::fprintf(stderr, "%s took %.1f s\n", file.c_str(), seconds);
    if (bytes > kMostBytes) std::fprintf(stderr, "%s held %zu bytes\n", file.c_str(), bytes);
    static std::size_t most = 0;
    if (bytes > most) std::printf("%s held %.1f MiB\n", file.c_str(), static_cast<double>(bytes) / 1048576.0);
    most = std::max(most, bytes);
    return seconds < kMost_s && bytes <= kMostBytes;
}

}  // namespace

int main(int argc, char** argv) {
    namespace fs = std::filesystem;
    if (__sanitizer_install_malloc_and_free_hooks(&count_new, &count_freed) == 0 || !counts()) {
        std::fprintf(stderr, "the memory that is held is not counted\n");
        return 1;
    }
    const char* assets = std::getenv("HALFFRAME_ASSETS");
    int loaded = 0, refused = 0, beyond = 0;
    for (int i = 1; i < argc; ++i) {
        const fs::path folder(assets != nullptr ? assets : argv[i]);
        if (!fs::is_directory(folder)) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            const fs::path extension = entry.path().extension();
            if (extension != ".gltf" && extension != ".glb") continue;
            bool is_loaded = false;
            if (!within_limits(entry.path(), is_loaded)) ++beyond;
            (is_loaded ? loaded : refused) += 1;
        }
    }
    std::printf("%d glTF files: %d loaded, %d refused\n", loaded + refused, loaded, refused);
    if (loaded + refused == 0) {
        std::printf("no folder of assets; set HALFFRAME_ASSETS to one\n");
        return 77;
    }
    return beyond > 0 ? 1 : 0;
}
