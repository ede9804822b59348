// The entry that libFuzzer calls.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/gltf_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    (void)halfframe::tests::load_bytes({reinterpret_cast<const char*>(data), size});
    return 0;
}
