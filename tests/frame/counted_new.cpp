// Counts what this thread takes from the heap through operator new, for the proof that a steady frame takes nothing.
// The driver's own C++ code counts too; a steady frame gives it nothing to do that allocates.
#include "tests/frame/counted_new.h"

#include <cstdlib>
#include <new>

// AddressSanitizer brings its own operator new and wants to see every pair: nothing is counted under it.
#if defined(__SANITIZE_ADDRESS__)
std::uint64_t halfframe::tests::heap_allocations() { return 0; }
bool halfframe::tests::heap_is_counted() { return false; }
#else

namespace {
thread_local std::uint64_t taken = 0;

void* take(std::size_t bytes) {
    ++taken;
    if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
    throw std::bad_alloc();
}
}  // namespace

std::uint64_t halfframe::tests::heap_allocations() { return taken; }
bool halfframe::tests::heap_is_counted() { return true; }

void* operator new(std::size_t bytes) { return take(bytes); }
void* operator new[](std::size_t bytes) { return take(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
#endif
