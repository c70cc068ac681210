/// @file Counts what a test program takes from the heap. One file of the program may include this: it replaces the
/// program's operators new and delete.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

namespace cairn::test {

inline std::atomic<std::size_t> allocations{0};

}  // namespace cairn::test

[[gnu::noinline]] void* operator new(std::size_t size) {
    ++cairn::test::allocations;
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
