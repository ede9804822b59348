// What is fuzzed: one file's bytes in, a Scene that keeps its promises or an Error(input) out.
#pragma once

#include <string_view>

namespace halfframe::tests {

/// Loads `bytes` as a file, as .glb where they start so and as .gltf else. Anything but a sound scene or Error(input)
/// aborts with a sentence. True: it loaded.
bool load_bytes(std::string_view bytes);

}  // namespace halfframe::tests
