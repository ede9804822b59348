// How often this thread has called operator new.
#pragma once

#include <cstdint>

namespace halfframe::tests {

[[nodiscard]] std::uint64_t heap_allocations();
/// False under AddressSanitizer, which owns operator new.
[[nodiscard]] bool heap_is_counted();

}  // namespace halfframe::tests
