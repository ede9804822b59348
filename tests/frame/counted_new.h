// How often this thread has called operator new.
#pragma once

#include <cstdint>

namespace halfframe::tests {

[[nodiscard]] std::uint64_t heap_allocations();

}  // namespace halfframe::tests
