// Replaces operator new so that NoAllocation counts it: one file of each test program includes
// this.
#pragma once

#include "support/no_allocation_guard.hpp"

// not inlined: the compiler would see malloc and delete as a mismatched pair
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++hurcules_test::allocations();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
