// Loads every glTF file below the folders it is given, under the sanitizers: a sound scene or an error that names the
// file, and at most 5 s of processor time. HALFFRAME_ASSETS takes the place of the folders. Exit code 77: there is none.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "tests/fuzz/gltf_target.h"

int main(int argc, char** argv) {
    namespace fs = std::filesystem;
    const char* assets = std::getenv("HALFFRAME_ASSETS");
    int loaded = 0, refused = 0, slow = 0;
    for (int i = 1; i < argc; ++i) {
        const fs::path folder(assets != nullptr ? assets : argv[i]);
        if (!fs::is_directory(folder)) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            const fs::path extension = entry.path().extension();
            if (extension != ".gltf" && extension != ".glb") continue;
            const std::clock_t start = std::clock();
            (halfframe::tests::load_file(entry.path()) ? loaded : refused) += 1;
            const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            if (seconds < 5.0) continue;
            std::fprintf(stderr, "%s took %.1f s\n", entry.path().c_str(), seconds);
            ++slow;
        }
    }
    std::printf("%d glTF files: %d loaded, %d refused\n", loaded + refused, loaded, refused);
    if (loaded + refused == 0) {
        std::printf("no folder of assets; set HALFFRAME_ASSETS to one\n");
        return 77;
    }
    return slow > 0 ? 1 : 0;
}
