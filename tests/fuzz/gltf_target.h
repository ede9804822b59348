// What is fuzzed: one file's bytes in, a Scene that keeps its promises or an Error(input) out.
#pragma once

#include <filesystem>
#include <string_view>

namespace halfframe::tests {

/// Loads `bytes` as a file, as .glb where they start so and as .gltf else. Anything but a sound scene or Error(input)
/// aborts with a sentence. True: it loaded.
bool load_bytes(std::string_view bytes);
/// The same with a file that exists, among those it refers to.
bool load_file(const std::filesystem::path& file);

}  // namespace halfframe::tests
